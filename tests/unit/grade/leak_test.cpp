// How much of a hidden reference a student's checks reveal: adaptive queries against the real
// grader. The table in docs/benchmarks/service.md has the figures that this prints.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "core/number.h"
#include "grade/report/student_answer.h"
#include "grade/rubric/grader.h"

using namespace farol;

namespace {

constexpr std::size_t kNumbers = 8;
using Numbers = std::array<double, kNumbers>;
struct Range {
    double least, most;
    double width() const { return most - least; }
};
/// Of two offsets, two angles, two scales, a radius and a distance of a light.
constexpr std::array<Range, kNumbers> kRanges{
    {{-3, 3}, {-3, 3}, {0, 180}, {0, 180}, {0.4, 2}, {0.4, 2}, {0.3, 1.5}, {1, 9}}};

/// A scene whose author has hidden eight numbers; all else is known.
std::string sceneOf(const Numbers& n) {
    const auto text = [&](std::size_t i) { return formatNumber(n[i]); };
    const auto group = [](const std::string& transforms, const std::string& model) {
        return "<group><transform>" + transforms + "</transform><models><model file=\"" + model +
               "\"/></models></group>";
    };
    const auto at = [](const std::string& x, const std::string& y, const std::string& z) {
        return "<translate x=\"" + x + "\" y=\"" + y + "\" z=\"" + z + "\"/>";
    };
    const auto turn = [](const std::string& angle) {
        return "<rotate angle=\"" + angle + "\" x=\"0\" y=\"1\" z=\"0\"/>";
    };
    const auto scale = [](const std::string& factor) {
        return "<scale x=\"" + factor + "\" y=\"1\" z=\"1\"/>";
    };
    return "<world><window width=\"96\" height=\"96\"/><camera><position x=\"0\" y=\"6\" "
           "z=\"14\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/></camera><lights><light type=\"point\" "
           "posx=\"2\" posy=\"" +
           text(7) + "\" posz=\"4\"/></lights>" + group(at(text(0), "0", "3"), "box_1_2.3d") +
           group(at(text(1), "0", "-3"), "cone_1_2_16_4.3d") +
           group(at("-4", "0", "0") + turn(text(2)), "box_2_2.3d") +
           group(at("4", "0", "0") + turn(text(3)), "box_2_2.3d") +
           group(at("-2", "3", "0") + scale(text(4)), "sphere_1_16_12.3d") +
           group(at("2", "3", "0") + scale(text(5)), "sphere_1_16_12.3d") +
           group(at("0", "-2.5", "0"), "sphere_" + text(6) + "_16_12.3d") + "</world>";
}

grade::Subject subjectOf(const Numbers& numbers) {
    grade::Subject subject;
    subject.job.name = "scene.xml";
    subject.job.xml = sceneOf(numbers);
    subject.job.assets = std::make_shared<scene::BundleAssets>(scene::BundleAssets::Files{});
    subject.job.options.missing = render::Missing::placeholder;
    return subject;
}

Numbers random(std::mt19937& engine) {
    Numbers out{};
    for (std::size_t i = 0; i < kNumbers; ++i)
        out[i] = std::round(1000.0 * std::uniform_real_distribution<>(kRanges[i].least,
                                                                      kRanges[i].most)(engine)) /
                 1000.0;
    return out;
}

Numbers middle() {
    Numbers out{};
    for (std::size_t i = 0; i < kNumbers; ++i) out[i] = (kRanges[i].least + kRanges[i].most) / 2;
    return out;
}

/// What an assignment answers to a student who sends numbers; counts the tries.
class Oracle {
  public:
    Oracle(Numbers secret, grade::StudentView view) : reference_(subjectOf(secret)), view_(view) {
        rubric_.lend = false;
        rubric_.width = rubric_.height = 96;
    }
    int bandOf(const Numbers& numbers) {
        static render::Renderer renderer;
        static grade::Grader grader(renderer);
        const grade::Grade grade = grader.grade(reference_, subjectOf(numbers), rubric_);
        REQUIRE_FALSE(grade.notGraded);
        const std::string answer = grade::studentAnswer(grade, view_, Language::en);
        const int band = nlohmann::json::parse(answer)["points"]["band"];
        ++tries;
        answers[band].insert(answer);
        return band;
    }
    int tries = 0;
    std::map<int, std::set<std::string>> answers;  ///< by band

  private:
    const grade::Subject reference_;
    const grade::StudentView view_;
    grade::Rubric rubric_ = grade::defaultRubric();
};

/// What an attacker believes of the numbers: an interval each.
struct Belief {
    std::array<Range, kNumbers> ranges = kRanges;
    /// Numbers whose interval is a tenth of the range or less, and right.
    int known(const Numbers& secret) const {
        int count = 0;
        for (std::size_t i = 0; i < kNumbers; ++i)
            count += ranges[i].width() <= 0.1 * kRanges[i].width() + 1e-9 &&
                             secret[i] >= ranges[i].least - 1e-9 &&
                             secret[i] <= ranges[i].most + 1e-9
                         ? 1
                         : 0;
        return count;
    }
};

/// Bisects one number after the other: of two values inside its interval, the one with the higher
/// band keeps its half. Equal bands say nothing: the next number's turn.
Belief bisect(Oracle& oracle, int tries, std::mt19937& engine) {
    Belief belief;
    Numbers best = middle();
    int top = oracle.bandOf(best);
    for (std::size_t turn = 0; oracle.tries + 1 < tries; ++turn) {
        const std::size_t i = turn % kNumbers;
        Range& range = belief.ranges[i];
        if (range.width() <= 0.1 * kRanges[i].width()) {
            if (std::all_of(belief.ranges.begin(), belief.ranges.end(), [&](const Range& one) {
                    return one.width() <=
                           0.1 * kRanges[static_cast<std::size_t>(&one - belief.ranges.data())]
                                     .width();
                }))
                break;
            continue;
        }
        const double at = std::uniform_real_distribution<>(0.2, 0.5)(engine);
        Numbers low = best, high = best;
        low[i] = range.least + at * range.width();
        high[i] = range.most - at * range.width();
        const int lower = oracle.bandOf(low), upper = oracle.bandOf(high);
        if (lower > upper) range.most = range.least + 0.5 * range.width();
        if (lower < upper) range.least = range.most - 0.5 * range.width();
        if (std::max(lower, upper) > top) {
            top = std::max(lower, upper);
            best = lower > upper ? low : high;
        } else if (lower != upper && std::max(lower, upper) == top) {
            best = lower > upper ? low : high;
        }
    }
    return belief;
}

/// Tries ten values of one number: where a single one has a higher band, it is that.
Belief scan(Oracle& oracle, int tries, std::size_t number, const Numbers& others) {
    Belief belief;
    constexpr int kSteps = 10;
    std::vector<int> bands;
    const double step = kRanges[number].width() / kSteps;
    for (int k = 0; k < kSteps && oracle.tries < tries; ++k) {
        Numbers numbers = others;
        numbers[number] = kRanges[number].least + (k + 0.5) * step;
        bands.push_back(oracle.bandOf(numbers));
    }
    const auto top = std::max_element(bands.begin(), bands.end());
    if (top != bands.end() && std::count(bands.begin(), bands.end(), *top) == 1) {
        const double least =
            kRanges[number].least + step * static_cast<double>(top - bands.begin());
        belief.ranges[number] = {least, least + step};
    }
    return belief;
}

}  // namespace

TEST_CASE("a thousand adaptive checks reveal a band each and nothing else") {
    std::mt19937 engine(20'261'130);
    const Numbers secret = random(engine);
    Oracle oracle(secret, {});
    const Belief belief = bisect(oracle, 1'000, engine);
    const int needed = oracle.tries;
    while (oracle.tries < 999) oracle.bandOf(random(engine));
    oracle.bandOf(secret);
    for (const auto& [band, answers] : oracle.answers) {
        INFO(band);
        CHECK(answers.size() == 1);
    }
    CHECK(oracle.answers.size() <= 4);
    CHECK(oracle.answers.count(3) == 1);  // the right scene is in the highest band
    std::cout << "leak: " << oracle.tries << " checks, " << oracle.answers.size()
              << " different answers: at most "
              << std::log2(static_cast<double>(oracle.answers.size())) << " bits a check; after "
              << needed << " the bisection knows " << belief.known(secret) << " of 8 numbers\n";
}

TEST_CASE(
    "with the default tries a search knows no hidden number, and a scan no more than a guess") {
    std::mt19937 engine(7);
    constexpr int kRounds = 8;
    int bisected = 0, right = 0, claims = 0;
    for (int round = 0; round < kRounds; ++round) {
        const Numbers secret = random(engine);
        {
            Oracle oracle(secret, {});
            bisected += bisect(oracle, grade::kDefaultTries, engine).known(secret);
            CHECK(oracle.tries <= grade::kDefaultTries);
        }
        for (std::size_t number = 0; number < kNumbers; ++number) {
            Oracle oracle(secret, {});
            const Belief belief = scan(oracle, grade::kDefaultTries, number, middle());
            claims += belief.ranges[number].width() < kRanges[number].width() ? 1 : 0;
            right += belief.known(secret);
        }
    }
    constexpr int kScans = kRounds * static_cast<int>(kNumbers);
    std::cout << "leak: with " << grade::kDefaultTries << " checks a bisection knows " << bisected
              << " of " << kScans << " numbers; a scan of one number claims " << claims << " of "
              << kScans << ", and " << right << " are right\n";
    CHECK(bisected == 0);
    // One in ten is a guess without any check; the allowance is the sampling error of 64 scans.
    CHECK(right <= 2 * kScans / 10);
}
