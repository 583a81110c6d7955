#include "sheet.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/number.h"

namespace farol::test {

std::size_t Dice::below(std::size_t count) {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return static_cast<std::size_t>((z ^ (z >> 31U)) % std::max<std::size_t>(1, count));
}

Sheet::Sheet(const std::string& xml) {
    std::istringstream in(xml);
    for (std::string line; std::getline(in, line);) lines_.push_back({line, 0});
}

std::string Sheet::text() const {
    std::string out;
    for (const Line& line : lines_) out += line.text + "\n";
    return out;
}

bool Sheet::is(std::size_t line, const std::string& tag) const {
    const std::string& text = lines_[line].text;
    const std::size_t at = text.find('<');
    return at != std::string::npos && text.compare(at + 1, tag.size(), tag) == 0 &&
           at + 1 + tag.size() < text.size() &&
           std::string(" >/").find(text[at + 1 + tag.size()]) != std::string::npos;
}

std::string Sheet::word(std::size_t line, const std::string& attribute) const {
    const std::string& text = lines_[line].text;
    const std::string key = " " + attribute + "=\"";
    const std::size_t at = text.find(key);
    if (at == std::string::npos) return {};
    const std::size_t from = at + key.size();
    return text.substr(from, text.find('"', from) - from);
}

std::optional<double> Sheet::number(std::size_t line, const std::string& attribute) const {
    const std::string text = word(line, attribute);
    if (text.empty()) return std::nullopt;
    return std::stod(text);
}

void Sheet::set(std::size_t line, const std::string& attribute, const std::string& value) {
    std::string& text = lines_[line].text;
    const std::string key = " " + attribute + "=\"";
    const std::size_t at = text.find(key);
    if (at == std::string::npos) {
        const std::size_t end = text.find_first_of("/>", text.find('<') + 1);
        text.insert(end, key + value + "\"");
        return;
    }
    const std::size_t from = at + key.size();
    text.replace(from, text.find('"', from) - from, value);
}

void Sheet::set(std::size_t line, const std::string& attribute, double value) {
    set(line, attribute, formatNumber(value));
}

std::size_t Sheet::endOf(std::size_t line) const {
    const std::string& text = lines_[line].text;
    if (text.size() >= 2 && text.compare(text.size() - 2, 2, "/>") == 0) return line;
    const std::size_t indent = text.find('<');
    for (std::size_t i = line + 1; i < lines_.size(); ++i)
        if (lines_[i].text.compare(0, indent, std::string(indent, ' ')) == 0 &&
            lines_[i].text.compare(indent, 2, "</") == 0)
            return i;
    return line;
}

std::size_t Sheet::groupOf(std::size_t line) const {
    const std::size_t indent = lines_[line].text.find('<');
    for (std::size_t i = line; i-- > 0;)
        if (is(i, "group") && lines_[i].text.find('<') < indent && endOf(i) >= line) return i;
    return lines_.size();
}

bool Sheet::isTouched(std::size_t line) const {
    for (std::size_t i = line; i <= endOf(line); ++i)
        if (lines_[i].plant != 0) return true;
    return false;
}

std::vector<std::size_t> Sheet::free(const std::string& tag) const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < lines_.size(); ++i)
        if (is(i, tag) && !isTouched(i)) out.push_back(i);
    return out;
}

std::size_t Sheet::models(std::size_t line) const {
    std::size_t count = 0;
    for (std::size_t i = line; i <= endOf(line); ++i) count += is(i, "model") ? 1 : 0;
    return count;
}

void Sheet::markAll(std::size_t from, std::size_t to, int plant) {
    for (std::size_t i = from; i <= to; ++i) lines_[i].plant = plant;
}

std::vector<std::string> Sheet::cut(std::size_t from, std::size_t to) {
    std::vector<std::string> out;
    for (std::size_t i = from; i <= to; ++i) out.push_back(lines_[i].text);
    lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(from),
                 lines_.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    return out;
}

void Sheet::paste(std::size_t before, const std::vector<std::string>& lines, int plant) {
    std::vector<Line> added;
    for (const std::string& text : lines) added.push_back({text, plant});
    lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(before), added.begin(), added.end());
}

std::set<int> Sheet::linesOf(int plant) const {
    std::set<int> out;
    for (std::size_t i = 0; i < lines_.size(); ++i)
        if (lines_[i].plant == plant) out.insert(static_cast<int>(i) + 1);
    return out;
}

Composed compose(const ReferenceScene& reference, const std::string& xml, std::size_t count,
                 std::uint64_t seed,
                 const std::function<bool(const Work&, const std::string&, const Work&,
                                          const std::string&)>& isSeen) {
    Dice dice(seed);
    Work work = open(reference);
    Sheet sheet(xml);
    struct Done {
        const Plant* plant;
        int number;
        double share;
    };
    std::vector<Done> done;
    std::set<const Plant*> used;
    for (const bool structural : {true, false})
        for (std::size_t tries = 0; tries < 40 && done.size() < (structural ? count / 2 : count);
             ++tries) {
            const Plant& plant = plants()[dice.below(plants().size())];
            if (plant.isStructural != structural || used.count(&plant) != 0) continue;
            Sheet changed = sheet;
            Work after = work;
            const int number = static_cast<int>(done.size()) + 1;
            const auto share = plant.apply(changed, after, dice, number);
            if (!share || !isSeen(work, sheet.text(), after, changed.text())) continue;
            sheet = std::move(changed);
            work = std::move(after);
            used.insert(&plant);
            done.push_back({&plant, number, *share});
        }
    Composed out;
    out.xml = sheet.text();
    out.files = work.files;
    for (const Done& one : done) {
        Planted planted;
        planted.kind = one.plant->name;
        planted.codes = one.plant->codes;
        if (one.plant->hasLine) planted.lines = sheet.linesOf(one.number);
        // A mistake in a small part still counts; what is missing costs what it is worth.
        const bool isMissing = one.plant->least == 0.0;
        const double share = std::clamp(one.share, 0.0, 1.0);
        planted.severity = one.plant->least + (one.plant->most - one.plant->least) *
                                                  (isMissing ? share : std::sqrt(share));
        out.planted.push_back(std::move(planted));
    }
    return out;
}

}  // namespace farol::test
