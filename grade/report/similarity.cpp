#include "grade/report/similarity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/bounded_json.h"
#include "grade/rubric/grader.h"

namespace farol::grade {
namespace {

struct TraitKind {
    const char* key;
    double weight;  ///< of one that two have
};
// A run of tags is little alone, and there are many.
constexpr TraitKind kTraitKinds[] = {
    {"causes", 3.0}, {"places", 2.0}, {"comments", 3.0}, {"runs", 0.25}};
constexpr double kMinScore = 6.0;

using Holders = std::map<std::string, std::vector<std::size_t>>;

}  // namespace

std::vector<SimilarPair> similarPairs(const ClassResult& all, std::size_t max) {
    std::vector<SimilarPair> pairs;
    for (std::size_t t = 0; t < all.tasks.size(); ++t) {
        std::array<Holders, std::size(kTraitKinds)> holders;
        for (std::size_t i = 0; i < all.count; ++i) {
            const SubmissionResult one = all.at(i);
            const TaskGrade* grade = t < one.tasks.size() ? one.tasks[t].grade() : nullptr;
            if (grade == nullptr) continue;
            const nlohmann::json traits =
                parseJson(grade->json, kGradeJson).value("traits", nlohmann::json::object());
            for (std::size_t k = 0; k < holders.size(); ++k)
                for (const auto& text : traits.value(kTraitKinds[k].key, nlohmann::json::array()))
                    holders[k][text.get<std::string>()].push_back(i);
        }
        const std::size_t most = std::clamp<std::size_t>(all.count / 4, 2, 50);
        std::map<std::pair<std::size_t, std::size_t>, SimilarPair> found;
        for (std::size_t k = 0; k < holders.size(); ++k)
            for (const auto& [text, who] : holders[k]) {
                if (who.size() < 2 || who.size() > most) continue;
                const double rarity = 2.0 / static_cast<double>(who.size());
                for (std::size_t a = 0; a < who.size(); ++a)
                    for (std::size_t b = a + 1; b < who.size(); ++b) {
                        SimilarPair& pair = found[{who[a], who[b]}];
                        pair.score += kTraitKinds[k].weight * rarity;
                        if (k == 0) pair.causes.push_back(text);
                        if (k == 1) pair.places.push_back(text);
                        if (k == 2) pair.comments.push_back(text);
                        if (k == 3) ++pair.runs;
                    }
            }
        for (auto& [who, pair] : found) {
            if (pair.score < kMinScore) continue;
            pair.first = who.first;
            pair.second = who.second;
            pair.task = t;
            pairs.push_back(std::move(pair));
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const SimilarPair& a, const SimilarPair& b) { return a.score > b.score; });
    if (pairs.size() > max) pairs.resize(max);
    return pairs;
}

}  // namespace farol::grade
