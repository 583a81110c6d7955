#include "tests/accuracy/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "render/renderer.h"
#include "scene/read/reader.h"

namespace farol::accuracy {
namespace {

class Sum {
  public:
    void add(const glm::dvec3& difference, int x, int y) {
        for (int c = 0; c < 3; ++c) {
            const double size = std::abs(difference[c]) * 255.0;
            if (size > result_.worst) {
                result_.worst = size;
                result_.worstX = x;
                result_.worstY = y;
            }
            squares_ += size * size;
            all_.push_back(size);
        }
        ++result_.pixels;
    }

    Difference take() {
        if (all_.empty()) return result_;
        result_.rms = std::sqrt(squares_ / static_cast<double>(all_.size()));
        const auto place = static_cast<std::ptrdiff_t>(std::min(
            all_.size() - 1,
            static_cast<std::size_t>(std::ceil(0.999 * static_cast<double>(all_.size())))));
        std::nth_element(all_.begin(), all_.begin() + place, all_.end());
        result_.percentile999 = all_[static_cast<std::size_t>(place)];
        return result_;
    }

  private:
    Difference result_;
    double squares_ = 0.0;
    std::vector<double> all_;
};

constexpr double kFlipped = 24.0 / 255.0;

double worstOf(const glm::dvec3& d) {
    return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
}

}  // namespace

Figures measure(const std::string& xml, const render::PictureOptions& options,
                const reference::Files& files, const std::shared_ptr<const scene::Assets>& assets) {
    render::Job job;
    job.xml = xml;
    job.assets = assets ? assets : std::make_shared<scene::BundleAssets>();
    job.options = options;
    image::Image image;
    render::Renderer renderer;
    renderer.draw(job, image);

    const scene::Scene scene = scene::read(xml, {}, *job.assets).scene;
    reference::Options taken;
    taken.width = image.width;
    taken.height = image.height;
    taken.timeS = options.timeS;
    taken.viewer = options.viewer.value_or(scene.settings.viewer.value_or(scene::Viewer::infinite));
    taken.specular =
        options.specular.value_or(scene.settings.specular.value_or(scene::Specular::single));
    taken.filter = options.filter;
    taken.transparency = options.transparency != scene::Transparency::off;
    const reference::Picture exact =
        reference::traceCenters(reference::makeWorld(scene, files, taken));

    Figures figures{image.width, image.height, {}, {}, {}, 0};
    Sum interior, silhouette, crease;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::size_t at = exact.at(x, y);
            const std::uint8_t* p = &image.pixels[4 * at];
            const glm::dvec3 drawn = glm::dvec3(p[0], p[1], p[2]) / 255.0;
            const glm::dvec3 difference = drawn - exact.color[at];
            if (exact.edge[at] & reference::kSilhouette)
                silhouette.add(difference, x, y);
            else if (exact.id[at] == 0)
                figures.stray += worstOf(difference) > 0.0 ? 1 : 0;
            else if (exact.edge[at] & reference::kCrease)
                crease.add(difference, x, y);
            else
                interior.add(difference, x, y);
            if ((exact.edge[at] & reference::kSilhouette) && worstOf(difference) > kFlipped)
                ++figures.flipped;
        }
    figures.interior = interior.take();
    figures.silhouette = silhouette.take();
    figures.crease = crease.take();
    return figures;
}

void print(const std::string& name, const Figures& f) {
    std::printf("%-28s interior %6d px: rms %.3f p99.9 %.2f max %.2f at %d,%d; ", name.c_str(),
                f.interior.pixels, f.interior.rms, f.interior.percentile999, f.interior.worst,
                f.interior.worstX, f.interior.worstY);
    std::printf("silhouette %5d px: rms %.2f, %d flipped; crease %4d px: rms %.2f; %d stray\n",
                f.silhouette.pixels, f.silhouette.rms, f.flipped, f.crease.pixels, f.crease.rms,
                f.stray);
}

}  // namespace farol::accuracy
