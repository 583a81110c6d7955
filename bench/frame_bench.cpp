// Medians of the stages of a warm frame: bench_frame SCENE.xml [RUNS [name=value ...]]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"

using namespace farol;

namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

int main(int count, char** arguments) try {
    if (count < 2) {
        std::fprintf(stderr, "usage: bench_frame SCENE.xml [RUNS [name=value ...]]\n");
        return 2;
    }
    const std::filesystem::path path(arguments[1]);
    std::ifstream in(path, std::ios::binary);
    render::Job job;
    job.name = path.filename().string();
    job.xml = {std::istreambuf_iterator<char>(in), {}};
    job.assets = std::make_shared<scene::FolderAssets>(path.parent_path().string());
    const int runs = count > 2 ? std::max(1, std::atoi(arguments[2])) : 51;
    for (int i = 3; i < count; ++i) {
        const std::string option(arguments[i]);
        const std::size_t equals = option.find('=');
        render::applyOption(job.options, option.substr(0, equals), option.substr(equals + 1));
    }
    render::Renderer renderer;
    render::Picture picture = renderer.render(job);  // warms shaders, meshes and textures
    std::vector<double> parse, geometry, draw, read, encode;
    for (int i = 0; i < runs; ++i) {
        picture = renderer.render(job);
        parse.push_back(picture.times.parseMs);
        geometry.push_back(picture.times.geometryMs);
        draw.push_back(picture.times.drawMs);
        read.push_back(picture.times.readbackMs);
        encode.push_back(picture.times.encodeMs);
    }
    std::printf(
        "%d x %d, %lld triangles, %d calls, %zu bytes: parse %.2f geometry %.2f draw %.2f "
        "read %.2f encode %.2f ms (medians of %d)\n",
        picture.width, picture.height, static_cast<long long>(picture.stats.triangles),
        picture.stats.drawCalls, picture.bytes.size(), median(parse), median(geometry),
        median(draw), median(read), median(encode), runs);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_frame: %s\n", error.what());
    return 1;
}
