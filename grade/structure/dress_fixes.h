#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "grade/structure/fix.h"

namespace farol::grade {

inline Outline::Item& itemAt(Outline& outline, int item) {
    return outline.items[static_cast<std::size_t>(item)];
}
inline const Outline::Item& itemAt(const Outline& outline, int item) {
    return outline.items[static_cast<std::size_t>(item)];
}

/// Fixes of the appearance of matched items.
struct DressFixes {
    const Outline& mine;
    std::vector<Fix> fixes;

    /// Item `i` of the reference is item `j` of the submission.
    void add(int i, int j, const char* code, CauseWords words, const std::string& kind,
             const Location& where, std::function<void(Outline&)> apply) {
        Fix fix;
        fix.code = code;
        fix.who = nameOfItem(mine, j);
        fix.words = std::move(words);
        fix.kind = std::string(code) + " " + kind;
        fix.where = where;
        fix.apply = std::move(apply);
        fix.items = {i};
        fixes.push_back(std::move(fix));
    }
};

}  // namespace farol::grade
