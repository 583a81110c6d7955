// Time against error: a scene at many settings, turn by turn in one process, each measured against
// the ray caster of tests/support/ray_caster:
//   bench_quality SCENE.xml|mixed [--runs N] [--quick] [--front] [--cap N] [name=value ...]
// --front: only the settings that budget_ms chooses from.
// A line of JSON for the scene, then one a setting. "mixed": 1,000 spheres, cones, cylinders, tori
// and ellipsoids. Options width and height are the picture's; what a setting holds wins.
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "bench/measure.h"
#include "tests/support/exact.h"

using namespace farol;
using nlohmann::json;

namespace {

struct Setting {
    int divisions;  ///< 0: the plan's own
    double errorPx;
    scene::Shading shading;
    int samples;
    std::optional<scene::Filter> filter = {};

    json toJson() const {
        json out{{"divisions", divisions},
                 {"error", errorPx},
                 {"shading", scene::kShadingWords[shading]},
                 {"aa", samples}};
        if (filter) out["filter"] = scene::kFilterWords[*filter];
        return out;
    }
};

std::vector<Setting> settings(bool quick, bool front) {
    using enum scene::Shading;
    std::vector<Setting> all;
    const std::vector<double> errors =
        quick ? std::vector{0.25, 1.0} : std::vector{0.06, 0.12, 0.25, 0.5, 1.0, 2.0};
    const std::vector<int> fixed =
        quick ? std::vector{16, 64} : std::vector{8, 16, 32, 64, 128, 256};
    for (const double error : errors)
        for (const int samples : std::vector{1, 4, 8, 16})
            all.push_back({0, error, phong, samples});
    if (front) return all;
    all.push_back({0, 1.0, gouraud, 4});
    all.push_back({0, 0.25, phong, 4, scene::Filter::linear});
    if (!quick) all.push_back({0, 1.0, phong, 1, scene::Filter::nearest});
    for (const int n : fixed) {
        all.push_back({n, 0.25, phong, 1});
        all.push_back({n, 0.25, phong, 4});
        if (!quick && n <= 64) all.push_back({n, 0.25, gouraud, 4});
    }
    return all;
}

constexpr std::int64_t kMaxTriangles = 3'000'000;

std::string mixed() {
    const char* shapes[] = {"sphere 0.5 16 8", "cone 0.5 1 16 1", "cylinder 0.4 1 16 1",
                            "torus 0.4 0.15 16 8", "ellipsoid 0.6 0.3 0.4 16 8"};
    std::string models;
    for (int i = 0; i < 1000; ++i) {
        const int x = i % 10, y = i / 10 % 10, z = i / 100;
        models += "<group><transform><translate x=\"" + std::to_string(1.4 * (x - 4.5)) +
                  "\" y=\"" + std::to_string(1.4 * (y - 4.5)) + "\" z=\"" +
                  std::to_string(-2.0 * z) + "\"/><rotate angle=\"" + std::to_string(37 * i % 360) +
                  "\" x=\"1\" y=\"0.5\" z=\"0.2\"/></transform><models><model command=\"" +
                  shapes[i % 5] + "\"><color><diffuse R=\"" + std::to_string(80 + 16 * x) +
                  "\" G=\"" + std::to_string(80 + 16 * y) +
                  "\" B=\"160\"/><specular R=\"150\" G=\"150\" B=\"150\"/><shininess "
                  "value=\"20\"/></color></model></models></group>";
    }
    return "<world><window width=\"512\" height=\"512\"/><camera><position x=\"5\" y=\"4\" "
           "z=\"14\"/><lookAt x=\"0\" y=\"0\" z=\"-4\"/><projection fov=\"50\" near=\"1\" "
           "far=\"100\"/></camera><lights><light type=\"directional\" dirx=\"1\" diry=\"2\" "
           "dirz=\"1.5\"/></lights>" +
           models + "</world>";
}

struct Runner {
    Setting setting;
    render::Job job;
    std::vector<double> planMs, drawMs, frameMs, cpuMs;
    render::Stats stats;
};

}  // namespace

int main(int count, char** arguments) try {
    bool quick = false, front = false;
    int cap = 16;
    std::vector<char*> words;
    for (int i = 0; i < count; ++i) {
        const std::string word(arguments[i]);
        if (word == "--quick")
            quick = true;
        else if (word == "--front")
            front = true;
        else if (word == "--cap" && i + 1 < count)
            cap = std::max(1, std::atoi(arguments[++i]));
        else
            words.push_back(arguments[i]);
    }
    bench::Arguments given = bench::Arguments::parse(static_cast<int>(words.size()), words.data());
    render::Job job;
    if (given.scene == "mixed") {
        job.xml = mixed();
        job.assets = std::make_shared<scene::BundleAssets>();
    } else {
        job = bench::jobOf(given);
    }
    const bench::Subject subject = bench::readSubject(job.xml, job.assets);
    const int width = given.options.width.value_or(320),
              height = given.options.height.value_or(240);
    farol::Stopwatch watch;
    const bench::Exact exact = bench::exactOf(subject, width, height, cap);
    const auto foundObjects = std::count_if(exact.centers.id.begin(), exact.centers.id.end(),
                                            [](int id) { return id != 0; });
    std::printf("%s\n", json{{"bench", "quality"},
                             {"width", width},
                             {"height", height},
                             {"leftOut", subject.leftOut},
                             {"referenceMs", watch.lapMs()},
                             {"referenceSide", exact.areas.side},
                             {"referenceChange", 255.0 * exact.areas.change},
                             {"objectPixels", foundObjects}}
                            .dump()
                            .c_str());
    render::Renderer renderer;
    std::vector<Runner> runners;
    std::vector<json> rows;
    int coarse = 0;              // the last fixed number of divisions, and
    std::int64_t triangles = 0;  // what it made
    for (const Setting& setting : settings(quick, front)) {
        // Twice the divisions are four times the triangles: no figures of frames of seconds.
        if (setting.divisions > coarse && triangles > kMaxTriangles / 4) continue;
        Runner one{setting, {}, {}, {}, {}, {}, {}};
        one.job.xml = subject.xml(setting.divisions);
        one.job.assets = subject.assets;
        one.job.identity = "divisions " + std::to_string(setting.divisions);
        one.job.options = given.options;
        one.job.options.width = width;
        one.job.options.height = height;
        one.job.options.errorPx = setting.errorPx;
        one.job.options.shading = setting.shading;
        one.job.options.samples = setting.samples;
        one.job.options.filter = setting.filter;
        image::Image image;
        watch.lapMs();
        one.stats = renderer.draw(one.job, image).stats;
        if (setting.divisions > coarse) {
            coarse = setting.divisions;
            triangles = one.stats.triangles;
        }
        json row = setting.toJson();
        row["firstMs"] = watch.lapMs();
        const bench::Errors errors = bench::errorsOf(exact, image);
        row["triangles"] = one.stats.triangles;
        row["models"] = one.stats.instances;
        row["interiorRms"] = errors.interiorRms;
        row["interiorP999"] = errors.interiorP999;
        row["areasRms"] = errors.areasRms;
        row["flip"] = errors.flipMean;
        row["flipObjects"] = errors.flipObjects;
        rows.push_back(std::move(row));
        runners.push_back(std::move(one));
    }
    image::Image image;
    for (int run = 0; run < given.runs; ++run)
        for (Runner& one : runners) {
            watch.lapMs();
            const std::clock_t cpu = std::clock();  // of all threads: others' load shows less
            const render::StageTimes times = renderer.draw(one.job, image).times;
            one.cpuMs.push_back(1000.0 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
            one.frameMs.push_back(watch.lapMs());
            one.planMs.push_back(times.geometryMs);
            one.drawMs.push_back(times.drawMs);
        }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i]["planMs"] = bench::median(runners[i].planMs);
        rows[i]["drawMs"] = bench::median(runners[i].drawMs);
        rows[i]["cpuMs"] = bench::median(runners[i].cpuMs);
        rows[i]["frameMs"] = bench::median(runners[i].frameMs);
        std::printf("%s\n", rows[i].dump().c_str());
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_quality: %s\n", error.what());
    return 1;
}
