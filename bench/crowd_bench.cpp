// The cost of models outside the view: scenes of 100 spheres in view and up to 99,900 behind the
// viewer, turn by turn with a scene that holds only the 100:
//   bench_crowd [--runs N] [--json] [name=value ...]
#include <cstdio>

#include "bench/measure.h"

using namespace farol;

namespace {

constexpr int kSeen = 100;

/// Spheres on two rings, before and behind the viewer.
render::Job crowd(int behind, const render::PictureOptions& options) {
    const auto ring = [](int count, int z, int radius, int seed) {
        return "<group><translate X=\"0\" Y=\"0\" Z=\"" + std::to_string(z) +
               "\"/><scatter count=\"" + std::to_string(count) + "\" xzMin=\"0\" xzMax=\"" +
               std::to_string(radius) + "\" yMin=\"-8\" yMax=\"8\" seed=\"" + std::to_string(seed) +
               "\"/><models><model file=\"sphere_0.4_16_16.3d\"/></models></group>";
    };
    render::Job job;
    job.xml =
        "<world><camera><position x=\"0\" y=\"0\" z=\"0\"/><lookAt x=\"0\" y=\"0\" "
        "z=\"-1\"/></camera><lights><light type=\"directional\" dirx=\"1\" diry=\"1\" "
        "dirz=\"1\"/></lights>" +
        ring(kSeen, -25, 9, 1) + (behind > 0 ? ring(behind, 300, 250, 2) : "") + "</world>";
    job.identity = "crowd " + std::to_string(behind);
    job.options = options;
    return job;
}

}  // namespace

int main(int count, char** arguments) try {
    std::vector<char*> words(arguments, arguments + count);
    std::string none = "none";
    words.insert(words.begin() + 1, none.data());  // this bench makes its scenes itself
    const bench::Arguments given = bench::Arguments::parse(count + 1, words.data());
    render::Renderer renderer;
    const render::Job alone = crowd(0, given.options);
    image::Image want, have;
    const render::Stats few = renderer.draw(alone, want).stats;
    if (few.instances != kSeen || few.culled != 0) throw std::runtime_error("not all are in view");
    for (const int total : {100, 1'000, 10'000, 100'000}) {
        const render::Job job = crowd(total - kSeen, given.options);
        farol::Stopwatch watch;
        const render::Stats stats = renderer.draw(job, have).stats;
        const double firstMs = watch.lapMs();
        if (have.pixels != want.pixels) throw std::runtime_error("the pictures differ");
        std::vector<double> all, only, plans, differences;
        for (int i = 0; i < given.runs; ++i) {
            watch.lapMs();
            only.push_back((renderer.draw(alone, have), watch.lapMs()));
            const render::Picture picture = renderer.draw(job, have);
            all.push_back(watch.lapMs());
            plans.push_back(picture.times.geometryMs);
            differences.push_back(all.back() - only.back());
        }
        const char* text =
            given.json ? "{\"bench\": \"crowd\", \"objects\": %d, \"inView\": %d, \"firstMs\": "
                         "%.3f, \"frameMs\": %.3f, \"aloneMs\": %.3f, \"planMs\": %.3f, "
                         "\"differenceMs\": %.3f, \"runs\": %d}\n"
                       : "%6d objects, %d in view: first %.2f ms, warm %.2f ms, the %d alone "
                         "%.2f ms, plan %.3f ms, median difference %.3f ms (%d runs)\n";
        if (given.json)
            std::printf(text, stats.instances, kSeen, firstMs, bench::median(all),
                        bench::median(only), bench::median(plans), bench::median(differences),
                        given.runs);
        else
            std::printf(text, stats.instances, kSeen, firstMs, bench::median(all), kSeen,
                        bench::median(only), bench::median(plans), bench::median(differences),
                        given.runs);
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_crowd: %s\n", error.what());
    return 1;
}
