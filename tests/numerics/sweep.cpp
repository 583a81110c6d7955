#include "tests/numerics/sweep.h"

#include <cstdlib>
#include <iostream>

namespace farol::numerics {
namespace {

std::uint64_t settingOf(const char* name, std::uint64_t fallback) {
    const char* value = std::getenv(name);
    return value != nullptr ? std::strtoull(value, nullptr, 10) : fallback;
}

image::Image drawJob(const std::string& xml, int side, render::PictureOptions options,
                     const std::map<std::string, std::string>& files, bool marksNotFinite) {
    static render::Renderer renderer;
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>(files);
    if (!options.samples) options.samples = 1;
    options.width = options.height = side;
    job.options = std::move(options);
    job.markNotFinite = marksNotFinite;
    image::Image image;
    renderer.draw(job, image);
    return image;
}

}  // namespace

Sweep::Sweep(const char* name, int cases)
    : random_(settingOf("FAROL_SWEEP_SEED", 18)),
      cases_(cases * static_cast<int>(settingOf("FAROL_SWEEP_TIMES", 1))) {
    if (std::getenv("FAROL_SWEEP_SEED") != nullptr)
        std::cout << name << ": " << cases_
                  << " cases, FAROL_SWEEP_SEED=" << std::getenv("FAROL_SWEEP_SEED") << std::endl;
}

double Sweep::between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
}

double Sweep::power(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
}

std::string text(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.17g", value);
    return buffer;
}

std::string xyz(const glm::dvec3& value) {
    return "x=\"" + text(value.x) + "\" y=\"" + text(value.y) + "\" z=\"" + text(value.z) + "\"";
}

std::string Camera::xml() const {
    return "<camera><position " + xyz(eye) + "/><lookAt " + xyz(target) + "/><up " + xyz(up) +
           "/><projection fov=\"" + text(fovDeg) + "\" near=\"" + text(near) + "\" far=\"" +
           text(far) + "\"/></camera>";
}

glm::dvec3 Camera::ray(double x, double y, int side) const {
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    const double half = std::tan(glm::radians(fovDeg) / 2.0);
    return forward + right * (half * (2.0 * x / side - 1.0)) +
           glm::cross(right, forward) * (half * (1.0 - 2.0 * y / side));
}

image::Image draw(const std::string& xml, int side, render::PictureOptions options,
                  const std::map<std::string, std::string>& files) {
    return drawJob(xml, side, std::move(options), files, false);
}

image::Image drawMarked(const std::string& xml, int side, const render::PictureOptions& options) {
    return drawJob(xml, side, options, {}, true);
}

glm::ivec3 pixel(const image::Image& image, int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y * image.width + x) * 4;
    return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

}  // namespace farol::numerics
