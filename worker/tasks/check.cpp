#include "worker/tasks/check.h"

#include <cstdlib>
#include <stdexcept>

#include "image/format.h"
#include "image/image_file.h"
#include "worker/state.h"

namespace farol::worker {
namespace {

// A box in one plain colour before a background of another.
constexpr const char* kCanary = R"(<world>
  <window width="16" height="16"/>
  <camera><position x="0" y="0" z="5"/><lookAt x="0" y="0" z="0"/><up x="0" y="1" z="0"/>
    <projection fov="60" near="1" far="100"/></camera>
  <group><models><model file="box_2_1.3d">
    <color><diffuse R="255" G="128" B="0"/></color></model></models></group>
</world>)";

// A lit one and a lit and textured one.
constexpr const char* kLit = R"(<world>
  <window width="16" height="16"/>
  <camera><position x="0" y="2" z="5"/><lookAt x="0" y="0" z="0"/><up x="0" y="1" z="0"/>
    <projection fov="60" near="1" far="100"/></camera>
  <lights><light type="point" posX="3" posY="4" posZ="5"/></lights>
  <group><models>
    <model file="sphere_1_8_8.3d"><color><specular R="255" G="255" B="255"/>
      <shininess value="32"/></color></model>
    <model file="plane_4_1.3d"><texture file="texel.png"/></model>
  </models></group>
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

bool isColor(const image::Image& image, int x, int y, int r, int g, int b) {
    const std::uint8_t* pixel = &image.pixels[static_cast<std::size_t>(y * image.width + x) * 4];
    // One step for the rounding of colours in float.
    return std::abs(pixel[0] - r) <= 1 && std::abs(pixel[1] - g) <= 1 &&
           std::abs(pixel[2] - b) <= 1;
}

void drawCanary(render::Renderer& renderer) {
    const render::Picture picture = renderer.render(canaryJob());
    const image::Image image = image::decodeImage(picture.bytes, "canary.png");
    if (image.width != 16 || image.height != 16)
        throw std::runtime_error("the canary image has the wrong size");
    if (!isColor(image, 0, 0, 0x20, 0x40, 0x60) || !isColor(image, 8, 8, 255, 128, 0))
        throw std::runtime_error("the canary image has the wrong colours");
}

}  // namespace

CheckTask::Reply CheckTask::run(const Request& request, WorkerState& state) {
    drawCanary(state.renderer);
    for (const std::string& folder : request.folders) scene::FolderAssets(folder).checkReadable();
    return {};
}

void warmUp(render::Renderer& renderer) {
    drawCanary(renderer);
    render::Job job;
    job.xml = kLit;
    job.assets = std::make_shared<scene::BundleAssets>(std::map<std::string, std::string>{
        {"texel.png", image::encodePng({1, 1, {0x80, 0x80, 0x80, 0xFF}})}});
    renderer.render(job);
}

}  // namespace farol::worker
