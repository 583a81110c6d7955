#include "tests/stress/draw.h"

#include <algorithm>

namespace farol::stress {

std::string world(const std::string& models, const std::string& camera) {
    const std::string head =
        camera.empty() ? std::string(kCamera)
                       : "<window width=\"64\" height=\"64\"/><camera>" + camera + "</camera>";
    return "<world>" + head + kSun + "<group><models>" + models + "</models></group></world>";
}

std::string still(double away) {
    const auto x = [&](double value) { return std::to_string(away + value); };
    const auto model = [&](double at, const char* command) {
        return "<group><transform><translate x=\"" + x(at) +
               "\" y=\"0\" z=\"0\"/></transform><models>"
               "<model command=\"" +
               command + "\"/></models></group>";
    };
    return "<world><window width=\"64\" height=\"64\"/><camera><position x=\"" + x(1) +
           "\" y=\"2\" z=\"4\"/><lookAt x=\"" + x(0) +
           "\" y=\"0\" z=\"0\"/><projection fov=\"50\" near=\"0.5\" far=\"100\"/></camera>" + kSun +
           model(0, "sphere 1") + model(1.5, "cone 0.5 1") + model(-1.5, "box 1") + "</world>";
}

image::Image draw(const std::string& xml, render::PictureOptions options) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>();
    if (!options.samples) options.samples = 1;
    if (xml.find("<window") == std::string::npos && !options.width)
        options.width = options.height = 64;
    job.options = options;
    render::Renderer renderer;
    image::Image image;
    renderer.draw(job, image);
    return image;
}

std::string codeOf(const std::string& xml) {
    try {
        draw(xml);
    } catch (const Error& error) {
        return error.code();
    }
    return "";
}

glm::ivec3 pixel(const image::Image& image, int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y * image.width + x) * 4;
    return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

bool lit(const image::Image& image, int x, int y) { return pixel(image, x, y) != glm::ivec3(0); }

int covered(const image::Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) count += lit(image, x, y) ? 1 : 0;
    return count;
}

double shareOff(const image::Image& a, const image::Image& b, int levels) {
    if (a.pixels.size() != b.pixels.size() || a.width != b.width) return 1.0;
    int off = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const glm::ivec3 d = glm::abs(pixel(a, x, y) - pixel(b, x, y));
            off += std::max({d.r, d.g, d.b}) > levels ? 1 : 0;
        }
    return static_cast<double>(off) / (static_cast<double>(a.width) * a.height);
}

}  // namespace farol::stress
