// Tables of inputs and what the model holds of them.
#include <catch2/catch.hpp>
#include <functional>

#include "tests/unit/scene/reading.h"

using namespace farol;
using namespace farol::scene;
using namespace farol::scene::test;

namespace {

struct ValueCase {
    std::string xml;
    std::function<double(const Scene&)> probe;
    double expected;
};

void check(const std::vector<ValueCase>& cases) {
    for (const ValueCase& one : cases) {
        const Outcome outcome = tryRead(one.xml);
        INFO("input: " << one.xml);
        INFO("outcome: " << outcome.text());
        REQUIRE(outcome.scene);
        CHECK(one.probe(*outcome.scene) == Approx(one.expected).margin(1e-12));
    }
}

const Group& first(const Scene& s) { return s.groups.at(0); }
const Model& firstModel(const Scene& s) { return first(s).models.at(0); }
const Material& material(const Scene& s) { return firstModel(s).material.value(); }
template <class T>
const T& transformAt(const Scene& s, std::size_t at = 0) {
    return std::get<T>(first(s).transforms.at(at));
}
double translateX(const Scene& s) { return transformAt<Translate>(s).offset.x; }
double diffuseR(const Scene& s) { return double{material(s).diffuse.rgb.r}; }

std::string number(const std::string& text) { return transform("<translate x=\"" + text + "\"/>"); }

}  // namespace

TEST_CASE("numbers are read as people write them") {
    check({
        {number("1"), translateX, 1},
        {number("000"), translateX, 0},
        {number("007"), translateX, 7},
        {number(".5"), translateX, 0.5},
        {number("-.5"), translateX, -0.5},
        {number("5."), translateX, 5},
        {number("1e3"), translateX, 1000},
        {number("1E+3"), translateX, 1000},
        {number("1e-3"), translateX, 0.001},
        {number("+1"), translateX, 1},
        {number(" 2 "), translateX, 2},
        {number("1.5f"), translateX, 1.5},
        {number("2F"), translateX, 2},
        {number("1e18"), translateX, 1e18},
        {number("-0"), translateX, 0},
        {number("1e-39"), translateX, 0},
        {number("1e-400"), translateX, 0},
        {number("0.1234567890123456789"), translateX, 0.12345678901234568},
        {number("&#49;"), translateX, 1},
        {transform("<translate x = '3' />"), translateX, 3},
        {transform("<translate x=4/>"), translateX, 4},
        {transform("<translate x = -4 />"), translateX, -4},
        {transform("<translate x=“6”/>"), translateX, 6},
        {transform("<translate x=\"1\" x=\"2\"/>"), translateX, 1},
        {transform("<TRANSLATE X=\"5\"/>"), translateX, 5},
    });
}

TEST_CASE("denormals become zero, whatever the locale") {
    const auto scene = tryRead(number("1e-39")).scene;
    CHECK(translateX(*scene) == 0.0);
    CHECK(translateX(*tryRead(number("1e-30")).scene) == 1e-30);
}

TEST_CASE("windows and cameras") {
    const auto eyeX = [](const Scene& s) { return s.camera->eye.x; };
    check({
        {world(""), [](const Scene& s) { return s.camera ? 1 : 0; }, 0},
        {world(""), [](const Scene& s) { return s.window ? 1 : 0; }, 0},
        {world("<window/>"), [](const Scene& s) { return s.window->width; }, 512},
        {world("<window width=\"800\" height=\"600\"/>"),
         [](const Scene& s) { return s.window->height; }, 600},
        {camera("<position x=\"1\"/>"), eyeX, 1},
        {camera("<Position X=\"1\"/>"), eyeX, 1},
        {camera("<eye x=\"2\"/>"), eyeX, 2},
        {camera("<lookAt z=\"9\"/>"), [](const Scene& s) { return s.camera->target.z; }, 9},
        {camera("<lookat z=\"9\"/>"), [](const Scene& s) { return s.camera->target.z; }, 9},
        {camera("<position x=\"1\"/>"), [](const Scene& s) { return s.camera->up.y; }, 1},
        {camera("<position x=\"1\"/><up x=\"1\" y=\"0\"/>"),
         [](const Scene& s) { return s.camera->up.x; }, 1},
        {camera("<position x=\"1\"/>"), [](const Scene& s) { return s.camera->fovDeg; }, 60},
        {camera("<position x=\"1\"/>"), [](const Scene& s) { return s.camera->near; }, 1},
        {camera("<position x=\"1\"/>"), [](const Scene& s) { return s.camera->far; }, 1000},
        {camera("<position x=\"1\"/><projection fov=\"45\"/>"),
         [](const Scene& s) { return s.camera->fovDeg; }, 45},
        {camera("<position x=\"1\"/><projection near=\".1\" far=\"1e7\"/>"),
         [](const Scene& s) { return s.camera->far; }, 1e7},
        {std::string("<scene camera=\"engine\"/>"), [](const Scene& s) { return s.camera->fovDeg; },
         45},
        {std::string("<scene camera=\"engine\"/>"),
         [](const Scene& s) { return s.camera->target.z; }, 1},
        {"<scene camX=\"1\" camY=\"2\" camZ=\"3\" yaw=\"90\" pitch=\"0\"/>",
         [](const Scene& s) { return s.camera->target.x; }, 2},
        {"<scene camY=\"2\" pitch=\"30\"/>", [](const Scene& s) { return s.camera->target.y; },
         2.5},
        {"<scene yaw=\"0\"/>", [](const Scene& s) { return s.camera->target.z; }, 1},
    });
}

TEST_CASE("transforms keep their order and their defaults") {
    check({
        {transform("<translate y=\"2\"/>"), translateX, 0},
        {transform("<scale x=\"2\"/>"),
         [](const Scene& s) { return transformAt<Scale>(s).factors.y; }, 1},
        {transform("<scale x=\"0\" y=\"0\" z=\"0\"/>"),
         [](const Scene& s) { return transformAt<Scale>(s).factors.z; }, 0},
        {transform("<rotate angle=\"90\" y=\"1\"/>"),
         [](const Scene& s) { return transformAt<Rotate>(s).angleDeg; }, 90},
        {transform("<rotate angle=\"90\" y=\"1\"/>"),
         [](const Scene& s) { return transformAt<Rotate>(s).axis.x; }, 0},
        {transform("<rotate time=\"-4\" y=\"1\"/>"),
         [](const Scene& s) { return transformAt<Spin>(s).seconds; }, -4},
        {transform("<rotate angle=\"0\"/>"),
         [](const Scene& s) { return static_cast<double>(first(s).transforms.size()); }, 0},
        {transform("<scale x=\"2\"/><rotate angle=\"1\" x=\"1\"/><translate x=\"3\"/>"),
         [](const Scene& s) { return transformAt<Translate>(s, 2).offset.x; }, 3},
        {transform("<translate time=\"7\" align=\"True\"><point x=\"1\"/><point x=\"2\"/>"
                   "<point x=\"3\"/><point x=\"4\"/></translate>"),
         [](const Scene& s) { return transformAt<FollowCurve>(s).points.at(3).x; }, 4},
        {transform("<translate time=\"7\" align=\"True\"><point x=\"1\"/></translate>"),
         [](const Scene& s) { return transformAt<FollowCurve>(s).align ? 1 : 0; }, 1},
        {transform("<translate time=\"7\" align=\"0\"><point x=\"1\"/></translate>"),
         [](const Scene& s) { return transformAt<FollowCurve>(s).align ? 1 : 0; }, 0},
        {transform("<translate time=\"7\"><point x=\"1\"/></translate>"),
         [](const Scene& s) { return transformAt<FollowCurve>(s).seconds; }, 7},
        {transform(""),
         [](const Scene& s) { return static_cast<double>(first(s).transforms.size()); }, 0},
        {group("<transform><translate x=\"1\"/></transform><group/><group><group/></group>"),
         [](const Scene& s) { return static_cast<double>(first(s).groups.at(1).groups.size()); },
         1},
        {scene2017("<translate z=15/>"),
         [](const Scene& s) { return transformAt<Translate>(s).offset.z; }, 15},
        {scene2017("<group><rotate axisY=1 time=10/></group>"),
         [](const Scene& s) { return transformAt<Spin>(s).axis.y; }, 1},
        {scene2017("<group><rotate axisy=1 angle=10/></group>"),
         [](const Scene& s) { return transformAt<Rotate>(s).axis.y; }, 1},
        {scene2017("<group><scale X=3/></group>"),
         [](const Scene& s) { return transformAt<Scale>(s).factors.z; }, 1},
    });
}

TEST_CASE("lights of all dialects") {
    const auto at = [](const Scene& s) -> const Light& { return s.lights.at(0); };
    const auto type = [at](const Scene& s) { return static_cast<double>(at(s).type); };
    check({
        {light("type=\"point\" posX=\"1\""), [at](const Scene& s) { return at(s).position.x; }, 1},
        {light("type=\"point\" posx=\"1\""), [at](const Scene& s) { return at(s).position.x; }, 1},
        {light("type=\"POINT\" posX=\"1\""), type, 0},
        {light("type=\"directional\" dirX=\"1\""), type, 1},
        {light("dirX=\"1\""), type, 1},
        {light("dirX=\"1\" posX=\"1\""), type, 0},
        {light("dirX=\"1\" posX=\"1\" cutoff=\"20\""), type, 2},
        {light("alpha=\"10\""), type, 1},
        {light("type=\"spot\" dirX=\"1\""), type, 2},
        {light("type=\"spotlight\" dirX=\"1\""), type, 2},
        {light("type=\"SPOTLIGHT\" spotDirX=\"1\""),
         [at](const Scene& s) { return at(s).direction.x; }, 1},
        {light("type=\"directional\" dirY=\"2\""),
         [at](const Scene& s) { return at(s).direction.y; }, 2},
        {light("type=\"directional\" posY=\"2\""),
         [at](const Scene& s) { return at(s).direction.y; }, 2},
        {light("type=\"spot\" dirX=\"1\""), [at](const Scene& s) { return at(s).cutoffDeg; }, 180},
        {light("type=\"spot\" dirX=\"1\" cutoff=\"45\""),
         [at](const Scene& s) { return at(s).cutoffDeg; }, 45},
        {light("type=\"spot\" dirX=\"1\" cut=\"45\" exp=\"3\""),
         [at](const Scene& s) { return at(s).exponent; }, 3},
        {light("type=\"spot\" dirX=\"1\" cutoffAngle=\"45\" cutoffExponent=\"3\""),
         [at](const Scene& s) { return at(s).exponent; }, 3},
        {light("type=\"point\""), [at](const Scene& s) { return at(s).constant; }, 1},
        {light("type=\"point\""), [at](const Scene& s) { return at(s).quadratic; }, 0},
        {light("type=\"point\" attenuationLinear=\"0.5\""),
         [at](const Scene& s) { return at(s).linear; }, 0.5},
        {light("type=\"point\" quadratic=\"0.5\""),
         [at](const Scene& s) { return at(s).quadratic; }, 0.5},
        {light("type=\"point\" attenuation=\"0.5\""),
         [at](const Scene& s) { return at(s).quadratic; }, 0.5},
        {light("type=\"point\""), [at](const Scene& s) { return double{at(s).diffuse.rgb.g}; }, 1},
        {light("type=\"point\""), [at](const Scene& s) { return double{at(s).ambient.rgb.g}; }, 0},
        {light("type=\"point\""), [at](const Scene& s) { return double{at(s).specular.rgb.g}; }, 1},
        {light("type=\"point\" diffR=\"0.25\""),
         [at](const Scene& s) { return double{at(s).diffuse.rgb.r}; }, 0.25},
        {light("type=\"point\" ambtG=\"0.25\""),
         [at](const Scene& s) { return double{at(s).ambient.rgb.g}; }, 0.25},
        {light("type=\"point\" ambR=\"0.25\""),
         [at](const Scene& s) { return double{at(s).ambient.rgb.r}; }, 0.25},
        {light("type=\"point\" diffuse=\"#ff0080\""),
         [at](const Scene& s) { return double{at(s).diffuse.rgb.b}; }, double{128.0F / 255.0F}},
        {light("alpha=\"0\" beta=\"0\""), type, 1},
        {light("alpha=\"0\" beta=\"0\""), [at](const Scene& s) { return at(s).direction.z; }, 1},
        {light("alpha=\"90\" beta=\"0\""), [at](const Scene& s) { return at(s).direction.x; }, 1},
        {light("alpha=\"0\" beta=\"90\""), [at](const Scene& s) { return at(s).direction.y; }, 1},
        {light("alpha=\"450\" beta=\"0\""), [at](const Scene& s) { return at(s).direction.x; }, 1},
        {light("alpha=\"0\" space=\"camera\""),
         [at](const Scene& s) { return static_cast<double>(at(s).space); }, 1},
        {scene2020("<lights><light type=\"POINT\" attenuation=\"0\"/></lights>"),
         [at](const Scene& s) { return at(s).constant; }, 1},
        {scene2020("<lights><light type=\"POINT\" constant=\"0\" attenuation=\"0\"/></lights>"),
         [at](const Scene& s) { return at(s).constant; }, 1},
        {scene2020("<lights><light type=\"POINT\" diffuse=\"c\"/></lights>"),
         [at](const Scene& s) { return double{at(s).diffuse.rgb.g}; }, 0.25},
        {scene2017("<lights><light type=\"spot\"/></lights>"),
         [at](const Scene& s) { return at(s).direction.z; }, -1},
        {scene2017("<group><lights><light type=\"point\" posY=3/></lights></group>"),
         [](const Scene& s) { return first(s).lights.at(0).position.y; }, 3},
        {scene2017("<translate x=1/><lights><light type=\"point\" posY=3/></lights>"),
         [](const Scene& s) { return first(s).lights.at(0).position.y; }, 3},
        {world("<light type=\"point\" posY=\"4\"/>"),
         [at](const Scene& s) { return at(s).position.y; }, 4},
    });
}

TEST_CASE("materials of all dialects") {
    const auto part = [](const std::string& text) { return model("<color>" + text + "</color>"); };
    const std::string of2017 = "<translate x=1/><models><model file=a ";
    check({
        {model(""), [](const Scene& s) { return firstModel(s).material ? 1 : 0; }, 0},
        {part(""), diffuseR, double{200.0F / 255.0F}},
        {part(""), [](const Scene& s) { return double{material(s).ambient.rgb.b}; },
         double{50.0F / 255.0F}},
        {part("<diffuse R=\"255\" G=\"0\" B=\"51\"/>"), diffuseR, 1},
        {part("<diffuse R=\"255\" G=\"0\" B=\"51\"/>"),
         [](const Scene& s) { return double{material(s).diffuse.rgb.b}; }, double{0.2F}},
        {part("<diffuse G=\"0\"/>"), diffuseR, double{200.0F / 255.0F}},
        {part("<diffuse R=\"000\" G=\"00\" B=\"0\"/>"), diffuseR, 0},
        {part("<diffuse r=\"255\" g=\"0\" b=\"0\"/>"), diffuseR, 1},
        {part("<diffuse R=\"0.5\" G=\"1\" B=\"0\"/>"), diffuseR, 0.5},
        {part("<diffuse R=\"1\" G=\"1\" B=\"1\"/>"), diffuseR, double{1.0F / 255.0F}},
        {part("<diffuse R=\"1\" G=\"1\" B=\"1\" max=\"1\"/>"), diffuseR, 1},
        {part("<diffuse R=\"300\" G=\"0\" B=\"0\"/>"), diffuseR, 1},
        {part("<ambient R=\"255\"/>"), diffuseR, double{200.0F / 255.0F}},
        {part("<specular R=\"255\"/>"),
         [](const Scene& s) { return double{material(s).specular.rgb.r}; }, 1},
        {part("<emissive G=\"255\"/>"),
         [](const Scene& s) { return double{material(s).emissive.rgb.g}; }, 1},
        {part("<emission G=\"255\"/>"),
         [](const Scene& s) { return double{material(s).emissive.rgb.g}; }, 1},
        {part("<shininess value=\"128\"/>"),
         [](const Scene& s) { return double{material(s).shininess}; }, 128},
        {part("<shininess value=\"500\"/>"),
         [](const Scene& s) { return double{material(s).shininess}; }, 500},
        {part("<diffuse cycles=\"true\"/>"),
         [](const Scene& s) { return material(s).diffuse.cycles ? 1 : 0; }, 1},
        {scene2017(of2017 + "diffR=0.25/></models>"), diffuseR, 0.25},
        {scene2017(of2017 + "R=0.25 G=0 B=0 /></models>"), diffuseR, 0.25},
        {scene2017(of2017 + "diffG=0.25/></models>"), diffuseR, double{0.8F}},
        {scene2017(of2017 + "diffR=128 /></models>"), diffuseR, double{128.0F / 255.0F}},
        {scene2017(of2017 + "ambtr=0.5/></models>"),
         [](const Scene& s) { return double{material(s).ambient.rgb.r}; }, 0.5},
        {scene2017(of2017 + "ambR=0.5/></models>"),
         [](const Scene& s) { return double{material(s).ambient.rgb.r}; }, 0.5},
        {scene2017(of2017 + "emisR=0.5/></models>"),
         [](const Scene& s) { return double{material(s).emissive.rgb.r}; }, 0.5},
        {scene2017(of2017 + "emissB=0.5/></models>"),
         [](const Scene& s) { return double{material(s).emissive.rgb.b}; }, 0.5},
        {scene2017(of2017 + "emissionY=0.5/></models>"),
         [](const Scene& s) { return double{material(s).emissive.rgb.g}; }, 0.5},
        {scene2017(of2017 + "shininess=9/></models>"),
         [](const Scene& s) { return double{material(s).shininess}; }, 9},
        {scene2020("<models><model command=\"box 1\" diffuse=\"c\"/></models>"), diffuseR, 0.5},
        {scene2020("<models><model command=\"box 1\" emission=\"rgb\"/></models>"),
         [](const Scene& s) { return material(s).emissive.cycles ? 1 : 0; }, 1},
        {scene2020("<models><model command=\"box 1\" diffuse=\"c\"/></models>"),
         [](const Scene& s) { return double{material(s).ambient.rgb.r}; }, double{0.2F}},
        {"<scene><models><model command=\"box 1\" diffuse=\"late\"/></models>"
         "<colors><color name=\"late\" r=\"0.125\"/></colors></scene>",
         diffuseR, 0.125},
        {"<scene><colors><color name=\"c\" r=\"255\"/></colors>"
         "<models><model command=\"box 1\" diffuse=\"c\"/></models></scene>",
         diffuseR, 1},
    });
}

TEST_CASE("models, textures and scatter") {
    const auto texture = [](const Scene& s) -> const Texture& { return *firstModel(s).texture; };
    const auto mapping = [texture](const Scene& s) {
        return static_cast<double>(texture(s).mapping);
    };
    const auto filter = [texture](const Scene& s) {
        return static_cast<double>(texture(s).filter.value());
    };
    const std::string ring = "<models><model file=a rand=5 xzMinR=1 xzMaxR=2 yMaxR=3/></models>";
    const auto scattered = [](const Scene& s) -> const Scatter& {
        return s.groups.at(0).scatter.value();
    };
    check({
        {group("<models><model file=\"a\"/><model file=\"b\"/></models>"),
         [](const Scene& s) { return static_cast<double>(first(s).models.size()); }, 2},
        {group("<model file=\"a\"/>"),
         [](const Scene& s) { return static_cast<double>(first(s).models.size()); }, 1},
        {world("<models><model file=\"a\"/></models>"),
         [](const Scene& s) { return static_cast<double>(first(s).models.size()); }, 1},
        {group("<models><model file=\"p.ply\" revolve=\"32\"/></models>"),
         [](const Scene& s) { return firstModel(s).revolve.value(); }, 32},
        {group("<models><model file=\"a\" uv=\"atlas\"/></models>"),
         [](const Scene& s) { return static_cast<double>(firstModel(s).uv); }, 1},
        {group("<models><model file=\"a\" uv=\"2017\"/></models>"),
         [](const Scene& s) { return static_cast<double>(firstModel(s).uv); }, 2},
        {group("<models><model file=\"a\" lod=\"auto\"/></models>"),
         [](const Scene& s) { return firstModel(s).autoLod ? 1 : 0; }, 1},
        {group("<models><model file=\"a\" twoSided=\"yes\"/></models>"),
         [](const Scene& s) { return firstModel(s).twoSided ? 1 : 0; }, 1},
        {model("<texture file=\"a.jpg\"/>"), mapping, 0},
        {model("<texture file=\"a.jpg\" mapping=\"sphere\"/>"), mapping, 1},
        {model("<texture file=\"a.jpg\"/><texgen mode=\"object\" s=\"1 2 3 4\"/>"), mapping, 2},
        {model("<texgen mode=\"eye\" t=\"5 6 7 8\"/><texture file=\"a.jpg\"/>"), mapping, 3},
        {model("<texgen mode=\"eye\" t=\"5 6 7 8\"/><texture file=\"a.jpg\"/>"),
         [texture](const Scene& s) { return texture(s).planeT.w; }, 8},
        {model("<texture file=\"a.jpg\" filter=\"trilinear\"/>"), filter, 2},
        {model("<texture file=\"a.jpg\" filter=\"bilinear\"/>"), filter, 1},
        {model("<texture file=\"a.jpg\" filter=\"nearest\"/>"), filter, 0},
        {model("<texture file=\"a.jpg\" filter=\"anisotropic\"/>"), filter, 3},
        {model("<texture file=\"chess:8x4\"/>"),
         [texture](const Scene& s) { return texture(s).chess->rows; }, 4},
        {model("<texture file=\"chess:8x4\" color1=\"255,0,0\"/>"),
         [texture](const Scene& s) { return double{texture(s).chess->first.g}; }, 0},
        {model("<texture file=\"chess:8x4\" color2=\"white\"/>"),
         [texture](const Scene& s) { return double{texture(s).chess->second.g}; }, 1},
        {group("<models><model file=\"a\" texture=\"chess:2x2\" mapping=\"sphere\"/></models>"),
         mapping, 1},
        {scene2017(ring), [scattered](const Scene& s) { return scattered(s).count; }, 5},
        {scene2017(ring), [scattered](const Scene& s) { return scattered(s).radiusMin; }, 1},
        {scene2017(ring), [scattered](const Scene& s) { return scattered(s).radiusMax; }, 2},
        {scene2017(ring), [scattered](const Scene& s) { return scattered(s).yMin; }, 0},
        {scene2017(ring), [scattered](const Scene& s) { return scattered(s).yMax; }, 3},
        {scene2017(ring + "<group>" + ring + "</group>"),
         [](const Scene& s) {
             return static_cast<double>(s.groups.at(1).groups.at(0).scatter->seed);
         },
         2},
    });
}

TEST_CASE("settings of the picture") {
    const auto settings = [](const Scene& s) -> const RenderSettings& { return s.settings; };
    check({
        {world("<render shading=\"flat\"/>"),
         [settings](const Scene& s) { return static_cast<double>(*settings(s).shading); }, 4},
        {world("<render shading=\"lines\"/>"),
         [settings](const Scene& s) { return static_cast<double>(*settings(s).shading); }, 1},
        {world("<render aa=\"8\"/>"), [settings](const Scene& s) { return *settings(s).samples; },
         8},
        {world("<render axes=\"off\"/>"),
         [settings](const Scene& s) { return *settings(s).axes ? 1 : 0; }, 0},
        {world("<render viewer=\"local\"/>"),
         [settings](const Scene& s) { return static_cast<double>(*settings(s).viewer); }, 1},
        {world("<render specular=\"separate\"/>"),
         [settings](const Scene& s) { return static_cast<double>(*settings(s).specular); }, 1},
        {world("<render time=\"2..10\"/>"),
         [settings](const Scene& s) { return settings(s).timeRangeS->y; }, 10},
        {world("<render time=\"2 10\"/>"),
         [settings](const Scene& s) { return settings(s).timeRangeS->x; }, 2},
        {world("<render background=\"#000080\"/>"),
         [](const Scene& s) { return double{s.background.color->b}; }, double{128.0F / 255.0F}},
        {world("<background color=\"#fff\"/>"),
         [](const Scene& s) { return double{s.background.color->r}; }, 1},
        {world("<skybox texture=\"sky.jpg\"/>"), [](const Scene& s) { return s.skybox->width; },
         500},
        {world(""), [](const Scene& s) { return double{s.globalAmbient.r}; }, 1},
        {scene2017(""), [](const Scene& s) { return double{s.globalAmbient.r}; }, double{0.2F}},
        {scene2020(""), [](const Scene& s) { return double{s.globalAmbient.r}; }, double{0.2F}},
    });
}

TEST_CASE("texts") {
    using Probe = std::function<std::string(const Scene&)>;
    struct TextCase {
        std::string xml;
        Probe probe;
        std::string expected;
    };
    const Probe file = [](const Scene& s) { return firstModel(s).file; };
    const Probe command = [](const Scene& s) { return firstModel(s).command; };
    const Probe title = [](const Scene& s) { return s.title; };
    const Probe textureFile = [](const Scene& s) { return firstModel(s).texture->file; };
    const Probe words = [](const Scene& s) {
        std::string all;
        for (const auto& [name, list] : s.generatorComments) {
            all += name + ":";
            for (const std::string& word : list) all += " " + word;
        }
        return all;
    };
    const TextCase cases[] = {
        {group("<models><model file=\" a b.3d \"/></models>"), file, "a b.3d"},
        {group("<models><model file='a\"b'/></models>"), file, "a\"b"},
        {group("<models><model file=\"a&amp;b&lt;\"/></models>"), file, "a&b<"},
        {group("<models><model file=\"a&b\"/></models>"), file, "a&b"},
        {group("<models><model file=demos/x.3d/></models>"), file, "demos/x.3d"},
        {group("<models><model file=\"caf\xE9\"/></models>"), file, "caf\xC3\xA9"},
        {group("<models><model command=\"box 1 2\"/></models>"), command, "box 1 2"},
        {group("<models><model><generator argv=\"box 1 2\"/></model></models>"), command,
         "box 1 2"},
        {group("<models><model><generator argv=\"box 1 2 b.3d\"/></model></models>"), file, "b.3d"},
        {group("<models><model file=\"c.3d\"><generator argv=\"box 1 2\"/></model></models>"),
         words, "c.3d: box 1 2"},
        {model("<texture file=\"t.jpg\"/>"), textureFile, "t.jpg"},
        {group("<models><model file=\"a\" texture=\"t.jpg\"/></models>"), textureFile, "t.jpg"},
        {world("<title> A &lt; B </title>"), title, "A < B"},
        {world("<title><![CDATA[A < B & C]]></title>"), title, "A < B & C"},
        {"<world title=\"T\"/>", title, "T"},
        {world("<description>d</description>"), [](const Scene& s) { return s.description; }, "d"},
        {world("<background texture=\"b.jpg\"/>"), [](const Scene& s) { return s.background.file; },
         "b.jpg"},
        {world("<render background=\"b.jpg\"/>"), [](const Scene& s) { return s.background.file; },
         "b.jpg"},
        {world("<skybox texture=\"s.jpg\"/>"), [](const Scene& s) { return s.skybox->file; },
         "s.jpg"},
        {world("<group name=\"moon\"/>"), [](const Scene& s) { return s.groups.at(0).name; },
         "moon"},
        {world("<!-- generator cone 1 2 4 3 cone_1_2_4_3.3d -->"), words,
         "cone_1_2_4_3.3d: cone 1 2 4 3"},
        {world("<!-- generator.exe cone 1 2 4 3 c.3d -->"), words, "c.3d: cone 1 2 4 3"},
        {world("<!-- ./generator cone 1 2 4 3 ../models/c.3d -->"), words, "c.3d: cone 1 2 4 3"},
        {world("<!-- generator 2 3 box.3d -->"), words, "box.3d: 2 3"},
        {world("<!-- generator patch teapot.patch 10 b.3d -->"), words,
         "b.3d: patch teapot.patch 10"},
        {world("<!-- generators are nice -->"), words, ""},
        {world("<!-- generator box 1 b.3d --->"), words, "b.3d: box 1"},
        {world("<!-- generator box 1 b.3d -- or a cone -->"), words, ""},
        {world("<!-- generator box 1 <b.3d> -->"), words, ""},
        {world("<!-- generator box 1 caf\xE9.3d -->"), words, "caf\xC3\xA9.3d: box 1"},
        {world("<!-- generator -->"), words, ""},
        {world("<!--\n generator box 1 b.3d\r\n generator cone 1 2 c.3d\n-->"), words,
         "b.3d: box 1c.3d: cone 1 2"},
        {world("<!-- generator box 1 b.3d; generator box 2 c.3d -->"), words,
         "b.3d: box 1c.3d: box 2"},
        {world("<!-- the hat\n $ ./generator cone 1 2 h.3d -->"), words, "h.3d: cone 1 2"},
        {world("<!-- made by: generator cone 1 2 \"h.3d\" -->"), words, "h.3d: cone 1 2"},
        {world("<!-- the generator makes b.3d -->"), words, ""},
        {world("<!-- see generator 2 for more -->"), words, ""},
        {"<!-- generator box 1 b.3d --><world/>", words, "b.3d: box 1"},
    };
    for (const TextCase& one : cases) {
        const Outcome outcome = tryRead(one.xml);
        INFO("input: " << one.xml);
        INFO("outcome: " << outcome.text());
        REQUIRE(outcome.scene);
        CHECK(one.probe(*outcome.scene) == one.expected);
    }
}

TEST_CASE("which dialect a document is written in") {
    const auto dialect = [](const std::string& xml) { return tryRead(xml).scene->dialect; };
    CHECK(dialect("<world/>") == Dialect::course);
    CHECK(dialect("<World/>") == Dialect::course);
    CHECK(dialect("<scene/>") == Dialect::engine2017);
    CHECK(dialect("<scene><group><translate x=\"1\"/></group></scene>") == Dialect::engine2017);
    CHECK(dialect("<scene><skybox texture=\"a\"/></scene>") == Dialect::engine2020);
    CHECK(dialect("<scene><models><model command=\"box 1\"/></models></scene>") ==
          Dialect::engine2020);
    CHECK(dialect("<scene><window/><camera/></scene>") == Dialect::engine2017);
    CHECK(dialect("<scene><group><transform/></group></scene>") == Dialect::course);
    CHECK(dialect("<world dialect=\"2017\"/>") == Dialect::engine2017);
    CHECK(dialect("<scene dialect=\"2020\"/>") == Dialect::engine2020);
    CHECK(dialect("<world><models><model command=\"box 1\"/></models></world>") == Dialect::course);
}
