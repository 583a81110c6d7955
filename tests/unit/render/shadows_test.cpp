#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "generator/registry.h"
#include "image/image_file.h"
#include "render/gl/painter.h"
#include "render/plan/cost.h"
#include "render/plan/quality.h"
#include "render/renderer.h"
#include "scene/read/reader.h"
#include "tests/support/plan_scene.h"

// Shadow maps: what casts, what receives, and what they leave as it was. Their places are compared
// with the ray caster by the tests of accuracy.
using namespace farol;
using render::Layer;
using scene::Shadows;

namespace {

constexpr int kSide = 96;

struct Drawn {
    image::Image image;
    render::Picture picture;

    bool has(const std::string& code) const {
        return std::any_of(picture.diagnostics.begin(), picture.diagnostics.end(),
                           [&](const Diagnostic& one) { return one.code == code; });
    }
    /// Of the pixel that shows a place on the floor; seen from above, 8 units across.
    int level(double x, double z) const {
        const auto at = [](double v) { return static_cast<std::size_t>((v / 8.0 + 0.5) * kSide); };
        return image.pixels[4 * (at(z) * kSide + at(x))];
    }
};

render::Job jobOf(const std::string& xml, const std::map<std::string, std::string>& files = {}) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>(files);
    job.options.width = job.options.height = kSide;
    job.options.samples = 1;
    return job;
}

Drawn draw(const render::Job& job) {
    Drawn drawn;
    drawn.picture = render::Renderer().draw(job, drawn.image);
    return drawn;
}

const std::string kHighSun = R"(<light type="directional" dirX="1" dirY="1"/>)";

/// A white floor from above: 8 x 8 units of it in view.
std::string floorWith(const std::string& models, const std::string& lights = kHighSun,
                      const std::string& render = R"(shadows="map")") {
    return "<world><render " + render +
           R"(/><camera><position y="40"/><lookAt/><up z="-1"/>
           <projection fov="11.421" near="1" far="100"/></camera><lights>)" +
           lights + R"(</lights><group><models><model command="plane 30"><color>
           <diffuse R="255" G="255" B="255"/><ambient R="0" G="0" B="0"/></color></model></models>
           </group>)" +
           models + "</world>";
}

std::string at(const std::string& place, const std::string& model) {
    return "<group><transform><translate " + place + "/></transform><models>" + model +
           "</models></group>";
}

const std::string kBall = R"(<model command="sphere 0.5"/>)";

}  // namespace

TEST_CASE("a scene without shadows has the same bytes, asked for or not, with the option off") {
    const std::string ball = at(R"(y="2")", kBall);
    const Drawn never = draw(jobOf(floorWith(ball, kHighSun, "")));
    CHECK(draw(jobOf(floorWith(ball, kHighSun, R"(shadows="off")"))).image == never.image);
    render::Job job = jobOf(floorWith(ball));
    const Drawn shadowed = draw(job);
    CHECK(shadowed.image != never.image);
    job.options.shadows = Shadows::off;  // the request wins
    const Drawn off = draw(job);
    CHECK(off.image == never.image);
    CHECK(off.picture.stats.shadowMaps == 0);
    CHECK(shadowed.picture.stats.shadowMaps == 1);
    CHECK(shadowed.picture.stats.shadowTriangles > 100);
    CHECK(shadowed.picture.stats.drawCalls == never.picture.stats.drawCalls);
}

TEST_CASE("a ball's shadow lies where the sun throws it, also from outside the view") {
    const Drawn inside = draw(jobOf(floorWith(at(R"(x="2" y="2")", kBall))));
    CHECK(inside.level(0, 0) == 0);
    CHECK(inside.level(0, 1.5) > 150);
    const Drawn outside = draw(jobOf(floorWith(at(R"(x="9" y="9")", kBall))));
    CHECK(outside.level(0, 0) == 0);
    CHECK(outside.level(1.5, 0) > 150);
}

TEST_CASE("ambient light and emission are not shadowed") {
    const std::string light =
        R"(<light type="directional" dirX="1" dirY="1" ambR="0.5" ambG="0.5" ambB="0.5"/>)";
    std::string xml = floorWith(at(R"(x="2" y="2")", kBall), light);
    const std::string black = R"(<ambient R="0" G="0" B="0"/>)";
    xml.replace(xml.find(black), black.size(), R"(<ambient R="0" G="0" B="0"/>
        <emissive R="40" G="40" B="40"/>)");
    CHECK(draw(jobOf(xml)).level(0, 0) == 40);
    xml.replace(xml.find(black), black.size(), R"(<ambient R="51" G="51" B="51"/>)");
    CHECK(draw(jobOf(xml)).level(0, 0) > 60);
}

TEST_CASE("a lamp within a ball shines out of it, and sheets stop light from either side") {
    const std::string lamp = R"(<light type="point" posY="2"/>)";
    CHECK(draw(jobOf(floorWith(at(R"(y="2")", kBall), lamp))).level(1, 0) > 150);
    for (const char* turn : {"0", "180"}) {
        const std::string sheet = std::string(
                                      "<group><transform><translate x=\"2\" y=\"2\"/>"
                                      "<rotate angle=\"") +
                                  turn +
                                  "\" x=\"1\"/></transform><models><model command=\"plane 1\"/>"
                                  "</models></group>";
        CHECK(draw(jobOf(floorWith(sheet))).level(0, 0) == 0);
    }
}

TEST_CASE("a light at the eye casts no shadow that could be seen, and needs no map") {
    const std::string ball = at(R"(x="1" y="2")", kBall);
    const std::string torch = R"(<light type="point" space="camera"/>)";
    const Drawn drawn = draw(jobOf(floorWith(ball, torch)));
    CHECK(drawn.picture.stats.shadowMaps == 0);
    const std::string beside = R"(<light type="point" posX="30" space="camera"/>)";
    CHECK(draw(jobOf(floorWith(ball, beside))).picture.stats.shadowMaps > 0);
}

TEST_CASE("models cast by the holes of their textures, and not where they are seen through") {
    image::Image half{32, 32, {}};  // its left half is a hole
    for (int i = 0; i < 32 * 32; ++i)
        for (const int value : {255, 255, 255, i % 32 < 16 ? 0 : 255})
            half.pixels.push_back(static_cast<std::uint8_t>(value));
    const std::map<std::string, std::string> files{{"half.png", image::encodePng(half)}};
    const std::string card =
        at(R"(x="2" y="2")", R"(<model command="plane 2"><texture file="half.png"/></model>)");
    const Drawn cut = draw(jobOf(floorWith(card), files));
    const int left = cut.level(-0.5, 0), right = cut.level(0.5, 0);
    CHECK(std::min(left, right) == 0);
    CHECK(std::max(left, right) > 150);
    render::Job solid = jobOf(floorWith(card), files);
    solid.options.transparency = scene::Transparency::off;
    const Drawn whole = draw(solid);
    CHECK(whole.level(-0.5, 0) == 0);
    CHECK(whole.level(0.5, 0) == 0);
    const std::string glass =
        at(R"(x="2" y="2")", R"(<model command="sphere 0.5" opacity="0.5"/>)");
    CHECK(draw(jobOf(floorWith(glass))).level(0, 0) > 150);
}

TEST_CASE("a crowd of open shapes keeps within the triangles of its maps") {
    const std::string crowd =
        R"(<group><scatter count="3000" xzMin="0" xzMax="9" yMin="0" yMax="3"/>
        <models><model command="sphere 0.3"/></models></group>)";
    const Drawn drawn = draw(jobOf(floorWith(crowd, R"(<light type="point" posY="4"/>)")));
    CHECK(drawn.picture.stats.shadowTriangles > 100'000);
    CHECK(drawn.picture.stats.shadowTriangles <= 2'000'000);
}

TEST_CASE("a coarse ball with smooth normals has no teeth where light ends") {
    // Seen from above, with the sun from the side: light falls along each row.
    const std::string ball = at("", R"(<model command="sphere 3 16 16"/>)");
    const std::string sun = R"(<light type="directional" dirX="1" dirY="0.3"/>)";
    const Drawn on = draw(jobOf(floorWith(ball, sun)));
    const Drawn off = draw(jobOf(floorWith(ball, sun, "")));
    int different = 0;
    for (double z = -2.0; z <= 2.0; z += 0.1)
        for (double x = -1.5; x <= 1.5; x += 0.1)
            different += std::abs(on.level(x, z) - off.level(x, z)) > 3 ? 1 : 0;
    CHECK(different == 0);
}

TEST_CASE("layers are those of the scene without shadows") {
    for (const Layer layer : {Layer::depth, Layer::normal, Layer::id}) {
        render::Job job = jobOf(floorWith(at(R"(x="2" y="2")", kBall)));
        job.options.layer = layer;
        const Drawn on = draw(job);
        CHECK(on.picture.stats.shadowMaps == 0);
        job.options.shadows = Shadows::off;
        CHECK(on.image == draw(job).image);
    }
}

TEST_CASE("shadows are the same at any samples, and with surfaces sorted in each pixel") {
    for (const int samples : {1, 2, 4, 8, 16})
        for (const auto mode : {scene::Transparency::on, scene::Transparency::exact}) {
            CAPTURE(samples);
            render::Job job = jobOf(floorWith(
                at(R"(x="2" y="2")", kBall) +
                at(R"(y="0.01" z="2")",
                   R"(<model command="plane 1" opacity="0.5"><color><diffuse R="255" G="255"
                      B="255"/></color></model>)") +
                at(R"(x="2" y="2" z="2")", kBall)));
            job.options.samples = samples;
            job.options.transparency = mode;
            const Drawn drawn = draw(job);
            CHECK(drawn.level(0, 0) == 0);
            CHECK(drawn.level(0, 1) > 150);
            CHECK(drawn.level(0, 2) < 60);  // on the pane, and on the floor behind it
        }
}

TEST_CASE("other shadings have no shadows, with a warning that names the fix") {
    const std::string ball = at(R"(x="2" y="2")", kBall);
    const Drawn gouraud =
        draw(jobOf(floorWith(ball, kHighSun, R"(shadows="map" shading="gouraud")")));
    CHECK(gouraud.has("scene.shadows"));
    CHECK(gouraud.picture.stats.shadowMaps == 0);
    CHECK(draw(jobOf(floorWith(ball, ""))).has("scene.shadows"));
    CHECK_FALSE(draw(jobOf(floorWith(ball))).has("scene.shadows"));
}

TEST_CASE("a view to the horizon has several maps of a sun, without seams, within the texels") {
    // Balls along the view, of which each has its shadow beside it.
    std::string balls;
    for (int i = 0; i < 12; ++i)
        balls += at("x=\"-1\" y=\"0.6\" z=\"" + std::to_string(-2 - i * i * 3) + '"', kBall);
    const std::string xml = R"(<world><render shadows="map"/><camera><position y="2" z="2"/>
        <lookAt y="1" z="-4"/><projection fov="50" near="0.1" far="2000"/></camera><lights>
        <light type="directional" dirX="-1" dirY="1"/></lights>
        <group><models><model command="plane 2000"/></models></group>)" +
                            balls + "</world>";
    render::Job job = jobOf(xml);
    job.options.width = job.options.height = 256;
    const Drawn on = draw(job);
    CHECK(on.picture.stats.shadowMaps > 1);
    CHECK(on.picture.stats.shadowMaps <= render::kMaxCascade);
    job.options.shadows = Shadows::off;
    const Drawn off = draw(job);
    const auto isDark = [&](int x, int y) {
        const auto i = static_cast<std::size_t>(4 * (y * 256 + x));
        return off.image.pixels[i] - on.image.pixels[i] > 20;
    };
    int seams = 0, dark = 0;
    for (int y = 4; y < 252; ++y)
        for (int x = 4; x < 252; ++x) {
            dark += isDark(x, y) ? 1 : 0;
            bool isBeside = false;
            for (int k = 0; k < 81; ++k) isBeside |= isDark(x + k % 9 - 4, y + k / 9 - 4);
            const auto i = static_cast<std::size_t>(4 * (y * 256 + x));
            if (!isBeside && std::abs(off.image.pixels[i] - on.image.pixels[i]) > 1) ++seams;
        }
    CHECK(seams == 0);
    CHECK(dark > 300);

    scene::Scene scene = scene::read(xml, {}, scene::BundleAssets()).scene;
    Diagnostics findings;
    generator::resolve(scene, scene::BundleAssets(), findings);
    render::MeshLibrary meshes(std::size_t{64} << 20);
    render::PictureOptions options;
    options.width = 1920;
    options.height = 1080;
    const render::FramePlan plan =
        support::planScene(scene, options, scene::BundleAssets(), meshes);
    CHECK(plan.shadowMaps.size() > 1);
    CHECK(plan.shadowMaps.size() * static_cast<std::size_t>(plan.shadowSide * plan.shadowSide) <=
          std::size_t{16} << 20);
}

TEST_CASE("lights over the limit of maps shine without shadows, with a warning") {
    std::string suns;
    for (int i = 0; i < render::kMaxShadowMaps + 2; ++i)
        suns += R"(<light type="directional" dirX="1" dirY="1" diffR="0.01"/>)";
    const Drawn drawn = draw(jobOf(floorWith(at(R"(x="2" y="2")", kBall), suns)));
    CHECK(drawn.picture.stats.shadowMaps == render::kMaxShadowMaps);
    CHECK(drawn.has("limit.shadows"));
}

TEST_CASE("maps are kept while nothing that they show changes, with the same image") {
    const auto read = [](const std::string& ball) {
        scene::Scene scene =
            scene::read(floorWith(at(ball, kBall)), {}, scene::BundleAssets()).scene;
        Diagnostics findings;
        generator::resolve(scene, scene::BundleAssets(), findings);
        return scene;
    };
    const scene::Scene still = read(R"(x="2" y="2")"), moved = read(R"(x="2" y="2.5")");
    render::MeshLibrary meshes(std::size_t{64} << 20);
    render::gl::Painter painter(render::gl::createContext(render::GlSource::automatic));
    const auto paint = [&](render::gl::Painter& by, const scene::Scene& scene, double height) {
        render::PictureOptions options;
        options.width = options.height = kSide;
        options.eye = glm::dvec3(0.0, height, 0.5);
        render::FramePlan plan = support::planScene(scene, options, scene::BundleAssets(), meshes);
        image::Image image;
        render::gl::Painter::Timings timings;
        Diagnostics findings;
        by.draw(
            plan, [](const render::TextureRef&) { return render::UndecodedTexture(); }, image,
            timings, findings);
        return image;
    };
    paint(painter, still, 40.0);
    CHECK(painter.shadowMapsDrawn() == 1);
    const image::Image kept = paint(painter, still, 30.0);
    CHECK(painter.shadowMapsDrawn() == 1);
    render::gl::Painter fresh(render::gl::createContext(render::GlSource::automatic));
    CHECK(paint(fresh, still, 30.0) == kept);
    paint(painter, moved, 30.0);
    CHECK(painter.shadowMapsDrawn() == 2);
}

TEST_CASE("maps that the GL refuses are reported, and the next image has its maps") {
    scene::Scene scene =
        scene::read(floorWith(at(R"(x="2" y="2")", kBall)), {}, scene::BundleAssets()).scene;
    Diagnostics findings;
    generator::resolve(scene, scene::BundleAssets(), findings);
    render::MeshLibrary meshes(std::size_t{64} << 20);
    render::gl::Painter painter(render::gl::createContext(render::GlSource::automatic));
    const auto paint = [&](render::gl::Painter& by, int side) {
        render::PictureOptions options;
        options.width = options.height = kSide;
        render::FramePlan plan = support::planScene(scene, options, scene::BundleAssets(), meshes);
        if (side > 0) plan.shadowSide = side;
        image::Image image;
        render::gl::Painter::Timings timings;
        Diagnostics notes;
        by.draw(
            plan, [](const render::TextureRef&) { return render::UndecodedTexture(); }, image,
            timings, notes);
        return image;
    };
    const int tooLarge = 4 * painter.facts().maxTargetSide;
    for (int i = 0; i < 2; ++i)  // a failed one leaves no map
        CHECK_THROWS_WITH(paint(painter, tooLarge), Catch::Contains("shadow maps"));
    render::gl::Painter fresh(render::gl::createContext(render::GlSource::automatic));
    CHECK(paint(painter, 0) == paint(fresh, 0));
}

TEST_CASE("the estimates of cost and time count shadows") {
    const scene::Scene scene = [] {
        scene::Scene read =
            scene::read(floorWith(at(R"(x="2" y="2")", kBall)), {}, scene::BundleAssets()).scene;
        Diagnostics findings;
        generator::resolve(read, scene::BundleAssets(), findings);
        return read;
    }();
    render::MeshLibrary meshes(std::size_t{64} << 20);
    const auto cost = [&](Shadows shadows) {
        render::PictureOptions options;
        options.width = options.height = kSide;
        options.shadows = shadows;
        return render::estimateCost(
                   support::planScene(scene, options, scene::BundleAssets(), meshes))
            .total();
    };
    CHECK(cost(Shadows::map) > 1.2 * cost(Shadows::off));
    render::FrameLoad load;
    load.pixels = 1e6;
    load.lights = 1.0;
    const double without = render::expectedMs(load, 4, 0.25);
    load.shadowLights = load.shadowMaps = 1.0;
    CHECK(render::expectedMs(load, 4, 0.25) > without);
}
