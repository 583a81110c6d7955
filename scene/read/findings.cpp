#include "scene/read/findings.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/messages.h"

namespace farol::scene {
namespace {

/// Findings kept for the choice at the end; a hostile document could make half a million.
constexpr std::size_t kMaxKept = 1000;
/// Repairs of one kind that are shown one by one.
constexpr int kMaxRepeats = 5;

}  // namespace

void Findings::info(Message message, Location where) {
    keep(diagnosticOf(Severity::info, std::move(message), std::move(where)));
}

void Findings::warn(Message message, Location where) {
    warn(diagnosticOf(Severity::warning, std::move(message), std::move(where)));
}

void Findings::error(Message message, Location where) {
    keep(diagnosticOf(Severity::error, std::move(message), std::move(where)));
}

void Findings::warn(Diagnostic finding) {
    // Hand-written files leave out every quote: two hundred such findings would hide the others.
    if (finding.code.rfind("xml.", 0) == 0 && ++repeats_[finding.code] > kMaxRepeats) {
        failed_ = failed_ || strict_;
        return;
    }
    if (strict_) finding.severity = Severity::error;
    keep(std::move(finding));
}

void Findings::add(Diagnostics found) {
    for (Diagnostic& finding : found) {
        if (finding.severity == Severity::warning && strict_) finding.severity = Severity::error;
        keep(std::move(finding));
    }
}

void Findings::replaceBy(Message message, Location where) {
    all_.clear();
    repeats_.clear();
    dropped_ = 0;
    error(std::move(message), std::move(where));
}

void Findings::keep(Diagnostic finding) {
    failed_ = failed_ || finding.severity == Severity::error;
    torn_ = torn_ || (finding.severity == Severity::error &&
                      (finding.code == "xml.unclosed" || finding.code == "xml.mismatch"));
    warned_ = warned_ || finding.severity == Severity::warning;
    const bool hasRoom = all_.size() < kMaxKept ||
                         (finding.severity == Severity::error && all_.size() < 2 * kMaxKept);
    if (hasRoom)
        all_.push_back(std::move(finding));
    else
        ++dropped_;
}

void Findings::dropFollowUps() {
    if (!torn_) return;
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
        if (count > kMaxRepeats) {
            Diagnostic note =
                diagnosticOf(Severity::info,
                             coreMessage<"part.more-like-these">("count"_arg = count - kMaxRepeats,
                                                                 "shown"_arg = kMaxRepeats),
                             end);
            note.code = code;
            result.push_back(std::move(note));
        }
    const int hidden = dropped_ + static_cast<int>(all_.size() - chosen.size());
    if (hidden > 0)
        result.push_back(diagnosticOf(Severity::info,
                                      coreMessage<"limit.diagnostics">("count"_arg = hidden), end));
    return result;
}

}  // namespace farol::scene
