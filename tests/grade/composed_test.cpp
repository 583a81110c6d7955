#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>

#include "classroom.h"
#include "scene/write/writer.h"
#include "sheet.h"

// Submissions with several mistakes at once: are the causes found, with their lines, and are marks
// in the order of what was planted? FAROL_COMPOSED is the number of submissions a scene, and
// FAROL_COMPOSED_TABLE a file for the table of docs/grading.md (scripts/grade-calibration).
using namespace farol;
using namespace farol::test;

namespace {

constexpr std::size_t kScenes = 12;

grade::Rubric smallRubric() {
    grade::Rubric out = grade::defaultRubric();
    out.width = 320;  // smaller than the default for time; costs are shares of the pictures
    out.height = 240;
    return out;
}

/// Whether two documents look different, by their own cameras and from the side.
class Watcher {
  public:
    explicit Watcher(render::Renderer& renderer) : renderer_(renderer) {}

    bool differs(const std::string& xmlA, const Files& filesA, const std::string& xmlB,
                 const Files& filesB) {
        for (const double azimuth : {0.0, 50.0})
            for (const double time : {0.0, 1.3}) {
                const image::Image a = draw(xmlA, filesA, azimuth, time),
                                   b = draw(xmlB, filesB, azimuth, time);
                if (a.pixels.size() != b.pixels.size()) return true;
                std::size_t count = 0;
                for (std::size_t i = 0; i < a.pixels.size(); ++i)
                    count += std::abs(a.pixels[i] - b.pixels[i]) > 12 ? 1 : 0;
                if (count > 90) return true;  // some 30 pixels of 19,200
            }
        return false;
    }

  private:
    image::Image draw(const std::string& xml, const Files& files, double azimuth, double time) {
        render::Job job = subjectOf(xml, files).job;
        job.options.width = 160;
        job.options.height = 120;
        job.options.samples = 1;
        job.options.timeS = time;
        if (azimuth != 0.0) job.options.orbit.azimuthDeg = azimuth;
        image::Image image;
        renderer_.draw(job, image);
        return image;
    }
    render::Renderer& renderer_;
};

struct Count {
    std::size_t planted = 0, found = 0, placed = 0, withLine = 0;
};

struct Point {
    double severity, loss;
};

/// Kendall's tau-b.
double tau(const std::vector<Point>& points) {
    double agree = 0, against = 0, tiesA = 0, tiesB = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            const double a = points[i].severity - points[j].severity,
                         b = points[i].loss - points[j].loss;
            if (a == 0.0 && b == 0.0) continue;
            if (a == 0.0)
                ++tiesA;
            else if (b == 0.0)
                ++tiesB;
            else
                (a * b > 0.0 ? agree : against) += 1.0;
        }
    const double all = std::sqrt((agree + against + tiesA) * (agree + against + tiesB));
    return all > 0.0 ? (agree - against) / all : 1.0;
}

bool names(const grade::GradedCause& cause, const Planted& planted) {
    return std::find(planted.codes.begin(), planted.codes.end(), cause.code) != planted.codes.end();
}

/// The number of the planted lines that the cause names.
std::size_t linesMet(const grade::GradedCause& cause, const Planted& planted) {
    std::size_t met = 0;
    for (const grade::CausePlace& place : cause.places)
        met += planted.lines.count(place.where.line) != 0 ? 1 : 0;
    return met;
}

}  // namespace

TEST_CASE("planted causes are found with their lines, and marks follow their severity") {
    render::Renderer renderer;
    grade::Grader grader(renderer);
    Watcher watcher(renderer);
    const char* wanted = std::getenv("FAROL_COMPOSED");
    // Fewer than twelve a scene are too few to measure shares of 5 %: six gave a precision of 93.0
    // %.
    const std::size_t each = wanted != nullptr ? std::stoul(wanted) : 12;
    const char* wordy = std::getenv("FAROL_COMPOSED_LOG");
    std::map<std::string, Count> kinds;
    std::size_t reported = 0, right = 0, submissions = 0;
    double tauSum = 0.0, rewriteMost = 0.0, skeletonMost = 0.0;
    std::size_t scenes = 0;
    std::vector<Point> clear;
    std::size_t pairs = 0, inverted = 0;
    for (const ReferenceScene& reference : referenceScenes()) {
        if (scenes == kScenes) break;
        ++scenes;
        Work plain = open(reference);
        const std::string canonical = scene::write(plain.scene);
        const grade::Subject subject = subjectOf(reference.xml, reference.files);
        std::vector<Point> points;
        const std::vector<Variant> rewrites = harmless();
        for (std::size_t n = 0; n < each; ++n) {
            Dice dice(1000 * scenes + n);
            // Every third is written in another way, too.
            std::string xml = canonical;
            ReferenceScene from = reference;
            if (n % 3 == 2)
                for (int tries = 0; tries < 5; ++tries) {
                    Work work = open(reference);
                    const Variant& way = rewrites[dice.below(rewrites.size())];
                    const auto other = way.apply(work);
                    if (!other || way.name == "antialiasing" || way.name == "names in capitals" ||
                        way.name == "order of attributes")
                        continue;
                    from.files = work.files;
                    from.xml = *other;
                    xml = *other;
                    break;
                }
            const std::size_t count = n % 6;
            const Composed composed =
                compose(from, xml, count, 77 * scenes + 13 * n,
                        [&](const Work& before, const std::string& a, const Work& after,
                            const std::string& b) {
                            return watcher.differs(a, before.files, b, after.files);
                        });
            const grade::Grade grade =
                grader.grade(subject, subjectOf(composed.xml, composed.files), smallRubric());
            ++submissions;
            INFO(reference.name << " " << n);
            REQUIRE_FALSE(grade.notGraded);
            const double loss = grade.most - grade.points;
            double severity = 0.0;
            for (const Planted& one : composed.planted) severity += one.severity;
            points.push_back({severity, loss});
            if (composed.planted.empty()) rewriteMost = std::max(rewriteMost, loss);
            std::vector<bool> isUsed(grade.causes.size(), false);
            std::string log;
            // Those with a line first: the others may have several names.
            std::vector<Planted> ordered = composed.planted;
            std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) {
                return a.lines.empty() < b.lines.empty();
            });
            for (const Planted& planted : ordered) {
                Count& kind = kinds[planted.kind];
                ++kind.planted;
                std::size_t best = grade.causes.size(), most = 0;
                for (std::size_t c = 0; c < grade.causes.size(); ++c) {
                    if (isUsed[c] || !names(grade.causes[c], planted)) continue;
                    const std::size_t met = linesMet(grade.causes[c], planted);
                    if (best == grade.causes.size() || met > most) {
                        best = c;
                        most = met;
                    }
                }
                const bool found = best < grade.causes.size();
                if (found) {
                    isUsed[best] = true;
                    ++kind.found;
                    if (!planted.lines.empty()) {
                        ++kind.withLine;
                        kind.placed += most > 0 ? 1 : 0;
                    }
                }
                if (!found || (!planted.lines.empty() && most == 0)) {
                    log += (found ? "  wrong line: " : "  not found: ") + planted.kind + " (line " +
                           (planted.lines.empty() ? "-" : std::to_string(*planted.lines.begin())) +
                           ")\n";
                }
            }
            for (std::size_t c = 0; c < grade.causes.size(); ++c) {
                if (!grade.causes[c].isSeen && !isUsed[c]) continue;  // reported, and costs nothing
                ++reported;
                right += isUsed[c] ? 1 : 0;
                if (!isUsed[c]) log += "  not planted: " + grade.causes[c].message.text + "\n";
            }
            if (wordy != nullptr && (!log.empty() || grade.unexplained > 0.0)) {
                std::cout << reference.name << " " << n << ": loss " << loss << ", severity "
                          << severity << ", unexplained " << grade.unexplained << "\n"
                          << log;
                for (const auto& one : grade.causes)
                    std::cout << "      " << one.message.text << " -" << one.points << "\n";
                std::ofstream(std::string(wordy) + "/" + std::to_string(scenes) + "-" +
                              std::to_string(n) + ".xml")
                    << composed.xml;
            }
        }
        tauSum += tau(points);
        for (const Point& a : points)
            for (const Point& b : points) {
                constexpr double kClear = 5.0;
                if (a.severity <= b.severity + kClear) continue;
                ++pairs;
                inverted += a.loss <= b.loss ? 1 : 0;
            }
        // The files that were handed out: everything but the objects.
        Work skeleton = open(reference);
        skeleton.scene.groups.clear();
        skeleton.scene.groups.emplace_back();
        const grade::Grade nothing =
            grader.grade(subject, subjectOf(scene::write(skeleton.scene), {}), smallRubric());
        skeletonMost = std::max(skeletonMost, nothing.points);
    }
    std::string table = "| planted | times | found | right line |\n| --- | --- | --- | --- |\n";
    std::size_t planted = 0, found = 0, placed = 0, withLine = 0;
    for (const auto& [name, kind] : kinds) {
        char row[200];
        std::snprintf(row, sizeof row, "| %s | %zu | %zu | %zu of %zu |\n", name.c_str(),
                      kind.planted, kind.found, kind.placed, kind.withLine);
        table += row;
        planted += kind.planted;
        found += kind.found;
        placed += kind.placed;
        withLine += kind.withLine;
    }
    const double recall = static_cast<double>(found) / static_cast<double>(planted),
                 precision = static_cast<double>(right) /
                             static_cast<double>(std::max<std::size_t>(1, reported)),
                 lines = static_cast<double>(placed) /
                         static_cast<double>(std::max<std::size_t>(1, withLine)),
                 order = tauSum / static_cast<double>(scenes);
    char text[600];
    std::snprintf(text, sizeof text,
                  "\n%zu submissions of %zu scenes, %zu mistakes of %zu kinds: recall %.1f %%, "
                  "precision %.1f %%, right line %.1f %%, Kendall's tau %.3f (mean over the "
                  "scenes), %zu of %zu clear pairs inverted; equivalent rewrites lose at most %.2f "
                  "points, without objects at most %.2f are given.\n",
                  submissions, scenes, planted, kinds.size(), 100 * recall, 100 * precision,
                  100 * lines, order, inverted, pairs, rewriteMost, skeletonMost);
    table += text;
    std::cout << table;
    if (const char* path = std::getenv("FAROL_COMPOSED_TABLE")) std::ofstream(path) << table;
    CHECK(recall >= 0.95);
    CHECK(precision >= 0.95);
    CHECK(lines >= 0.95);
    CHECK(order >= 0.9);
    CHECK(rewriteMost <= 1.0);
    CHECK(skeletonMost <= 5.0);
}
