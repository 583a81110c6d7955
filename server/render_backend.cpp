#include "server/render_backend.h"

#include <cstdlib>

#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "render/image_file.h"

namespace farol::server {
namespace {

// A box in one plain colour before a background of another.
constexpr const char* kCanary = R"(<world>
  <window width="16" height="16"/>
  <camera><position x="0" y="0" z="5"/><lookAt x="0" y="0" z="0"/><up x="0" y="1" z="0"/>
    <projection fov="60" near="1" far="100"/></camera>
  <group><models><model file="box_2_1.3d">
    <color><diffuse R="255" G="128" B="0"/></color></model></models></group>
</world>)";

render::Job canaryJob() {
    render::Job job;
    job.name = "canary.xml";
    job.xml = kCanary;
    job.assets = std::make_shared<scene::BundleAssets>();
    job.options.shading = scene::Shading::solid;
    job.options.background = "#204060";
    job.options.samples = 1;
    job.options.axes = false;
    return job;
}

bool isColor(const render::Image& image, int x, int y, int r, int g, int b) {
    const std::uint8_t* pixel = &image.pixels[static_cast<std::size_t>(y * image.width + x) * 4];
    // One step for the rounding of colours on their way through float.
    return std::abs(pixel[0] - r) <= 1 && std::abs(pixel[1] - g) <= 1 &&
           std::abs(pixel[2] - b) <= 1;
}

std::string makeMesh(const MeshJob& job) {
    const scene::BundleAssets noFiles;
    const std::size_t triangles = generator::countTriangles(job.words, noFiles);
    if (triangles > kMaxMeshTriangles)
        throw Error("limit.triangles", "The mesh would have " + std::to_string(triangles) +
                                           " triangles; at most " +
                                           std::to_string(kMaxMeshTriangles) + " are sent.");
    const auto format = generator::io::formatOf("mesh." + job.format);
    if (!format) throw Error("option.range", "format must be 3d, obj or ply", {}, "format");
    return generator::io::encodeMesh(generator::generate(job.words, noFiles), *format);
}

}  // namespace

render::Renderer& RenderBackend::Worker::ready() {
    if (!renderer) renderer = std::make_unique<render::Renderer>();
    return *renderer;
}

RenderBackend::RenderBackend(int workers, QueueLimits limits) : queue_(limits), workers_(workers) {
    for (int i = 0; i < workers; ++i)
        threads_.emplace_back([this] {
            Worker worker;
            while (queue_.workOnce(worker)) {
            }
        });
}

RenderBackend::~RenderBackend() { stop(); }

void RenderBackend::stop() {
    queue_.close();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
}

// Jobs are copied: a caller that gives up at the deadline leaves its job to the worker.
Done<render::Picture> RenderBackend::render(const render::Job& job) {
    return queue_.run<render::Picture>(
        [job](Worker& worker) { return worker.ready().render(job); });
}

Done<render::SceneReport> RenderBackend::inspect(const render::Job& job) {
    return queue_.run<render::SceneReport>([job](Worker&) { return render::inspect(job); });
}

Done<std::string> RenderBackend::mesh(const MeshJob& job) {
    return queue_.run<std::string>([job](Worker&) { return makeMesh(job); });
}

void RenderBackend::check() {
    const render::Picture picture = render(canaryJob()).result;
    const render::Image image = render::decodeImage(picture.bytes, "canary.png");
    if (image.width != 16 || image.height != 16)
        throw std::runtime_error("the canary picture has the wrong size");
    if (!isColor(image, 0, 0, 0x20, 0x40, 0x60) || !isColor(image, 8, 8, 255, 128, 0))
        throw std::runtime_error("the canary picture has the wrong colours");
}

BackendState RenderBackend::state() const {
    BackendState state = queue_.state();
    state.workers = workers_;
    return state;
}

std::string RenderBackend::version() const { return render::version(); }

}  // namespace farol::server
