// Medians of the stages of a warm frame:
//   bench_frame SCENE.xml [--runs N] [--json] [name=value ...]
#include <cstdio>
#include <ctime>

#include "bench/measure.h"

using namespace farol;

int main(int count, char** arguments) try {
    const bench::Arguments given = bench::Arguments::parse(count, arguments);
    const render::Job job = bench::jobOf(given);
    render::Renderer renderer;
    farol::Stopwatch first;
    render::Picture picture = renderer.render(job);  // warms shaders, meshes and textures
    const double firstMs = first.lapMs();
    std::vector<double> parse, geometry, draw, read, encode, total, cpu;
    for (int i = 0; i < given.runs; ++i) {
        farol::Stopwatch watch;
        const std::clock_t used = std::clock();  // of all threads: others' load shows less
        picture = renderer.render(job);
        cpu.push_back(1000.0 * static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC);
        total.push_back(watch.lapMs());
        parse.push_back(picture.times.parseMs);
        geometry.push_back(picture.times.geometryMs);
        draw.push_back(picture.times.drawMs);
        read.push_back(picture.times.readbackMs);
        encode.push_back(picture.times.encodeMs);
    }
    const char* text =
        given.json ? "{\"bench\": \"frame\", \"width\": %d, \"height\": %d, \"triangles\": %lld, "
                     "\"drawCalls\": %d, \"bytes\": %zu, \"firstMs\": %.3f, \"parseMs\": %.3f, "
                     "\"geometryMs\": %.3f, "
                     "\"drawMs\": %.3f, \"readbackMs\": %.3f, \"encodeMs\": %.3f, \"totalMs\": "
                     "%.3f, \"cpuMs\": %.3f, \"runs\": %d}\n"
                   : "%d x %d, %lld triangles, %d calls, %zu bytes: first %.2f, then parse %.2f "
                     "geometry %.2f draw "
                     "%.2f read %.2f encode %.2f total %.2f ms, CPU %.2f ms (medians of %d)\n";
    std::printf(text, picture.width, picture.height,
                static_cast<long long>(picture.stats.triangles), picture.stats.drawCalls,
                picture.bytes.size(), firstMs, bench::median(parse), bench::median(geometry),
                bench::median(draw), bench::median(read), bench::median(encode),
                bench::median(total), bench::median(cpu), given.runs);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_frame: %s\n", error.what());
    return 1;
}
