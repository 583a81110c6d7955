#include "scene/findings.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace farol::scene {
namespace {

/// What is kept for the choice at the end; a hostile document could make half a million.
constexpr std::size_t kMaxKept = 1000;
/// Repairs of one kind that are shown one by one.
constexpr int kMaxRepeats = 5;

}  // namespace

void Findings::info(std::string code, Location where, std::string message) {
    keep(Severity::info, std::move(code), std::move(where), std::move(message));
}

void Findings::warn(std::string code, Location where, std::string message) {
    // Hand-written files leave out every quote: two hundred such findings would hide the others.
    if (code.rfind("xml.", 0) == 0 && ++repeats_[code] > kMaxRepeats) {
        failed_ = failed_ || strict_;
        return;
    }
    keep(strict_ ? Severity::error : Severity::warning, std::move(code), std::move(where),
         std::move(message));
}

void Findings::error(std::string code, Location where, std::string message) {
    keep(Severity::error, std::move(code), std::move(where), std::move(message));
}

void Findings::add(Diagnostics found) {
    for (Diagnostic& one : found) {
        if (one.severity == Severity::warning && strict_) one.severity = Severity::error;
        keep(one.severity, std::move(one.code), std::move(one.where), std::move(one.message));
    }
}

void Findings::keep(Severity severity, std::string code, Location where, std::string message) {
    failed_ = failed_ || severity == Severity::error;
    warned_ = warned_ || severity == Severity::warning;
    const bool room =
        all_.size() < kMaxKept || (severity == Severity::error && all_.size() < 2 * kMaxKept);
    if (room)
        all_.push_back({severity, std::move(code), std::move(where), std::move(message), ""});
    else
        ++dropped_;
}

void Findings::dropFollowUps() {
    const bool torn = std::any_of(all_.begin(), all_.end(), [](const Diagnostic& one) {
        return one.severity == Severity::error &&
               (one.code == "xml.unclosed" || one.code == "xml.mismatch");
    });
    if (!torn) return;
    std::erase_if(all_, [](const Diagnostic& one) {
        return one.code == "scene.misplaced" || one.code == "scene.order" ||
               one.code == "scene.missing-element";
    });
}

Diagnostics Findings::take() const {
    std::map<std::string, int> files;
    for (const Diagnostic& one : all_)
        files.emplace(one.where.file, static_cast<int>(files.size()));
    std::vector<std::size_t> order(all_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto place = [&](std::size_t i) {
        const Location& where = all_[i].where;
        return std::make_tuple(files.at(where.file), where.line, where.column);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    const auto notes = static_cast<std::size_t>(
        std::count_if(repeats_.begin(), repeats_.end(),
                      [](const auto& entry) { return entry.second > kMaxRepeats; }));
    std::vector<std::size_t> chosen;
    auto limit = static_cast<std::size_t>(std::max(limit_, 1));
    if (dropped_ > 0 || all_.size() + notes > limit)  // the notes count too
        limit = limit > notes + 1 ? limit - notes - 1 : 1;
    for (const bool errors : {true, false})
        for (const std::size_t i : order)
            if ((all_[i].severity == Severity::error) == errors && chosen.size() < limit)
                chosen.push_back(i);
    std::stable_sort(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) {
        return std::make_pair(place(a), a) < std::make_pair(place(b), b);
    });
    Diagnostics result;
    for (const std::size_t i : chosen) result.push_back(all_[i]);
    const Location end = all_.empty() ? Location{} : Location{all_.front().where.file, 0, 0};
    for (const auto& [code, count] : repeats_)
        if (count > kMaxRepeats)
            result.push_back({Severity::info, code, end,
                              std::to_string(count - kMaxRepeats) + " more like the " +
                                  std::to_string(kMaxRepeats) + " shown",
                              ""});
    const int hidden = dropped_ + static_cast<int>(all_.size() - chosen.size());
    if (hidden > 0)
        result.push_back({Severity::info, "limit.diagnostics", end,
                          std::to_string(hidden) + " more findings are not shown", ""});
    return result;
}

}  // namespace farol::scene
