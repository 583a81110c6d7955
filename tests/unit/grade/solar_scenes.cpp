#include "tests/unit/grade/solar_scenes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "generator/call.h"
#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "generator/sources.h"
#include "image/format.h"
#include "image/image.h"

namespace farol::test {
namespace {

std::string number(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

/// A small image of one colour, another for each number.
std::string imageOf(int shade) {
    image::Image image;
    image.width = image.height = 4;
    for (int i = 0; i < 16; ++i)
        for (const int value : {255 - 9 * shade, 120 + 9 * shade, 200 - 5 * shade, 255})
            image.pixels.push_back(static_cast<std::uint8_t>(value));
    return image::encodePng(image);
}

scene::BundleAssets::Files images() {
    scene::BundleAssets::Files files{{"sun.png", imageOf(0)}, {"moon.png", imageOf(9)}};
    for (int i = 1; i <= 8; ++i) files["p" + std::to_string(i) + ".png"] = imageOf(i);
    return files;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("not in the scene: " + from);
    return text.replace(at, from.size(), to);
}

std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
    std::size_t count = 0;
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()), ++count)
        text.replace(at, from.size(), to);
    if (count == 0) throw std::logic_error("not in the scene: " + from);
    return text;
}

int lineOf(const std::string& text, const std::string& part) {
    const std::size_t at = text.find(part);
    if (at == std::string::npos) throw std::logic_error("not in the scene: " + part);
    return 1 + static_cast<int>(
                   std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

const std::string kHead =
    "<world>\n<window width=\"480\" height=\"320\"/>\n"
    "<camera>\n<position x=\"0\" y=\"40\" z=\"60\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/>\n"
    "<up x=\"0\" y=\"1\" z=\"0\"/><projection fov=\"50\" near=\"1\" far=\"1000\"/>\n</camera>\n";
const std::string kLights =
    "<lights>\n<light type=\"point\" posx=\"0\" posy=\"0\" posz=\"0\"/>\n</lights>\n";
const std::string kSun =
    "<group name=\"Sun\">\n<transform><scale x=\"4\" y=\"4\" z=\"4\"/></transform>\n<models>\n"
    "<model file=\"sphere_1_16_12.3d\"><texture file=\"sun.png\"/>\n"
    "<color><diffuse R=\"0\" G=\"0\" B=\"0\"/><emissive R=\"255\" G=\"255\" B=\"255\"/></color>\n"
    "</model>\n</models>\n</group>\n";

double orbitOf(int planet) { return 5.0 + 3.0 * planet; }
double yearOf(int planet) { return 6.0 + 4.0 * planet; }

std::string model(const std::string& image) {
    return "<models>\n<model file=\"sphere_1_16_12.3d\"><texture file=\"" + image +
           "\"/></model>\n</models>\n";
}

const std::string kMoon =
    "<group name=\"Moon\">\n<transform><rotate time=\"5\" x=\"0\" y=\"1\" z=\"0\"/>"
    "<translate x=\"2.2\" y=\"0\" z=\"0\"/><scale x=\"0.3\" y=\"0.3\" z=\"0.3\"/></transform>\n" +
    model("moon.png") + "</group>\n";

std::string spin(double seconds) {
    return "<rotate time=\"" + number(seconds) + "\" x=\"0\" y=\"1\" z=\"0\"/>";
}
std::string away(double distance) {
    return "<translate x=\"" + number(distance) + "\" y=\"0\" z=\"0\"/>";
}

std::string planet(int i) {
    const std::string name = std::to_string(i);
    return "<group name=\"Planet " + name + "\">\n<transform>" + spin(yearOf(i)) +
           away(orbitOf(i)) + "</transform>\n" + model("p" + name + ".png") +
           (i == 3 ? kMoon : "") + "</group>\n";
}

std::string planets() {
    std::string out;
    for (int i = 1; i <= 8; ++i) out += planet(i);
    return out;
}

std::string comet(const std::string& modelElement) {
    std::string points;
    for (const char* at :
         {"x=\"20\" y=\"4\" z=\"0\"", "x=\"10\" y=\"5\" z=\"-18\"", "x=\"-10\" y=\"4\" z=\"-18\"",
          "x=\"-20\" y=\"3\" z=\"0\"", "x=\"-10\" y=\"2\" z=\"18\"", "x=\"10\" y=\"3\" z=\"18\""})
        points += "<point " + std::string(at) + "/>\n";
    return "<group name=\"Comet\">\n<transform>\n<translate time=\"60\" align=\"true\">\n" +
           points + "</translate><scale x=\"0.4\" y=\"0.4\" z=\"0.4\"/></transform>\n<models>\n" +
           modelElement + "\n</models>\n</group>\n";
}
const std::string kComet = comet("<model file=\"teapot.patch\"/>");

std::string mesh(const std::vector<std::string>& words, const std::string& name) {
    const scene::BundleAssets none;
    return generator::io::encodeMesh(generator::generate(generator::parseCall(words), none),
                                     *generator::io::formatOf(name));
}

/// A circle of points about the middle.
std::string circle(double radius, double seconds) {
    std::string out = "<translate time=\"" + number(seconds) + "\" align=\"false\">";
    for (int k = 0; k < 8; ++k) {
        const double angle = k * 3.14159265358979 / 4.0;
        out += "<point x=\"" + number(radius * std::cos(angle)) + "\" y=\"0\" z=\"" +
               number(-radius * std::sin(angle)) + "\"/>";
    }
    return out + "</translate>";
}

SolarScene otherwise(const std::string& name, const std::string& body) {
    SolarScene out = solarScene();
    out.name = name;
    out.xml = body;
    return out;
}

}  // namespace

grade::Subject SolarScene::subject() const {
    grade::Subject subject;
    subject.job.name = "scene.xml";
    subject.job.xml = xml;
    subject.job.assets = std::make_shared<scene::BundleAssets>(files);
    subject.job.options.missing = render::Missing::placeholder;
    return subject;
}

SolarScene solarScene() {
    return {"all", kHead + kLights + kSun + planets() + kComet + "</world>\n", images(), "", 0};
}

std::vector<SolarScene> solarMisses() {
    const SolarScene all = solarScene();
    std::vector<SolarScene> out;
    const auto add = [&](const std::string& unmet, const std::string& xml,
                         const std::string& atPart) {
        SolarScene scene = all;
        scene.name = scene.unmet = unmet;
        scene.xml = xml;
        scene.line = atPart.empty() ? 0 : lineOf(xml, atPart);
        out.push_back(std::move(scene));
    };
    add("sun", replaced(all.xml, "<emissive R=\"255\" G=\"255\" B=\"255\"/>", ""),
        "<model file=\"sphere_1_16_12.3d\"><texture file=\"sun.png\"/>");
    // A planet that stands still; its model's line says so.
    add("planets", replaced(all.xml, spin(yearOf(7)), ""),
        "<model file=\"sphere_1_16_12.3d\"><texture file=\"p7.png\"/>");
    add("images", replaced(all.xml, "p5.png", "p2.png"), "<group name=\"Planet 5\">\n");
    out.back().line += 3;
    add("years", replaced(all.xml, spin(yearOf(6)), spin(3.0)), "<texture file=\"p6.png\"/>");
    // The moon stands beside the planets.
    add("moon",
        replaced(replaced(all.xml, kMoon, ""), kComet, replaced(kMoon, spin(5.0), "") + kComet),
        "<texture file=\"moon.png\"/>");
    add("comet", replaced(all.xml, "align=\"true\"", "align=\"false\""), "<translate time=\"60\"");
    add("light", replaced(all.xml, "posx=\"0\" posy=\"0\"", "posx=\"0\" posy=\"30\""), "<light ");
    std::string far = all.xml;
    for (const int i : {6, 7, 8}) {
        // Behind the camera's far plane, in the same order.
        far = replaced(far, away(orbitOf(i)), away(2000.0 + orbitOf(i)));
    }
    add("seen", far, "<texture file=\"p6.png\"/>");
    add("free", replaced(all.xml, away(orbitOf(1)), away(1.0)), "<texture file=\"p1.png\"/>");
    return out;
}

std::vector<SolarScene> otherSolarScenes() {
    std::vector<SolarScene> out;
    const std::string base = solarScene().xml;
    // 1. Everything below the sun's group, which is scaled inside.
    out.push_back(otherwise("below the sun", kHead + kLights + "<group name=\"System\">\n" + kSun +
                                                 planets() + kComet + "</group>\n</world>\n"));
    // 2. Orbits are curves.
    std::string curves = base;
    for (int i = 1; i <= 8; ++i)
        curves =
            replaced(curves, spin(yearOf(i)) + away(orbitOf(i)), circle(orbitOf(i), yearOf(i)));
    out.push_back(otherwise("orbits by curves", curves));
    // 3. Meshes of a student's own generator, with names that say nothing.
    SolarScene own = otherwise("own mesh files", base);
    own.xml = replacedAll(own.xml, "sphere_1_16_12.3d", "bola.3d");
    own.xml = replaced(own.xml, "teapot.patch", "cometa.3d");
    own.files["bola.3d"] = mesh({"sphere", "1", "18", "14"}, "bola.3d");
    own.files["cometa.3d"] = mesh({"patch", "teapot.patch", "5"}, "cometa.3d");
    {
        // The control points are handed in, as the course asks.
        const auto bytes = generator::builtinFile("teapot.patch");
        own.files["cometa.patch"] = std::string(bytes.value_or(""));
    }
    out.push_back(std::move(own));
    // 4. Wavefront files, a larger sphere that is scaled down.
    SolarScene obj = otherwise("OBJ meshes", base);
    obj.xml = replacedAll(obj.xml, "sphere_1_16_12.3d", "models/planet.obj");
    obj.files["models/planet.obj"] = mesh({"sphere", "1", "20", "12"}, "planet.obj");
    out.push_back(std::move(obj));
    // 5. The moon and its planet side by side in a group that carries both.
    const std::string third = planet(3);
    const std::string carried = "<group name=\"Planet 3\">\n<transform>" + spin(yearOf(3)) +
                                away(orbitOf(3)) + "</transform>\n<group>\n<transform>" +
                                spin(2.0) + "</transform>\n" + model("p3.png") + "</group>\n" +
                                kMoon + "</group>\n";
    out.push_back(otherwise("moon beside its planet", replaced(base, third, carried)));
    // 6. The moon's group goes to the planet's place by itself, below the turning group.
    const std::string turning =
        "<group>\n<transform>" + spin(yearOf(3)) + "</transform>\n<group>\n<transform>" +
        away(orbitOf(3)) + "</transform>\n" + model("p3.png") + "</group>\n<group>\n<transform>" +
        away(orbitOf(3)) + "</transform>\n" + kMoon + "</group>\n</group>\n";
    out.push_back(otherwise("places written twice", replaced(base, third, turning)));
    // 7. Other names, capitals, and no names at all.
    std::string names = replaced(base, "<group name=\"Sun\">", "<group name=\"SOL\">");
    names = replaced(names, "<group name=\"Comet\">", "<group>");
    for (int i = 1; i <= 8; ++i)
        names = replaced(names, "<group name=\"Planet " + std::to_string(i) + "\">",
                         i % 2 == 0 ? "<group>" : "<group name=\"Planeta\">");
    out.push_back(otherwise("other names", names));
    // 8. Planets before the sun, tilted orbits, spins, years the other way round.
    std::string order = kHead + kLights + kComet;
    for (int i = 8; i >= 1; --i)
        order += "<group>\n<transform><rotate angle=\"" + number(3.0 * i) +
                 "\" x=\"1\" y=\"0\" z=\"0\"/></transform>\n<group>\n<transform>" +
                 spin(-yearOf(i)) + away(orbitOf(i)) + "</transform>\n<group>\n<transform>" +
                 spin(1.5) + "</transform>\n" + model("p" + std::to_string(i) + ".png") +
                 "</group>\n" + (i == 5 ? kMoon : "") + "</group>\n</group>\n";
    out.push_back(otherwise("tilted, the other way round", order + kSun + "</world>\n"));
    // 9. The 2017 dialect: transforms in groups, floats for colours, a light in the sun's group.
    std::string old =
        "<scene>\n<camera><position x=\"0\" y=\"40\" z=\"60\"/>"
        "<lookAt x=\"0\" y=\"0\" z=\"0\"/></camera>\n<group>\n<lights>"
        "<light type=\"POINT\" posX=\"0\" posY=\"0\" posZ=\"0\"/></lights>\n<group>\n"
        "<scale X=\"4\" Y=\"4\" Z=\"4\"/>\n<models>"
        "<model file=\"sphere_1_16_12.3d\" texture=\"sun.png\" diffR=\"0\" diffG=\"0\" "
        "diffB=\"0\" emisR=\"1\" emisG=\"1\" emisB=\"0.9\"/></models>\n</group>\n";
    for (int i = 1; i <= 8; ++i)
        old += "<group>\n<rotate time=\"" + number(yearOf(i)) +
               "\" axisX=\"0\" axisY=\"1\" axisZ=\"0\"/>\n<translate X=\"" + number(orbitOf(i)) +
               "\"/>\n<models><model file=\"sphere_1_16_12.3d\" texture=\"p" + std::to_string(i) +
               ".png\"/></models>\n" +
               (i == 6 ? "<group><rotate time=\"4\" axisY=\"1\"/><translate X=\"2\"/>"
                         "<scale X=\"0.3\" Y=\"0.3\" Z=\"0.3\"/><models><model "
                         "file=\"sphere_1_16_12.3d\" texture=\"moon.png\"/></models></group>\n"
                       : "") +
               "</group>\n";
    old += "<group>\n<translate time=\"40\" align=\"true\">";
    for (int k = 0; k < 7; ++k)
        old += "<point X=\"" + number(18 * std::cos(0.9 * k)) + "\" Y=\"4\" Z=\"" +
               number(18 * std::sin(0.9 * k)) + "\"/>";
    old +=
        "</translate>\n<scale X=\"0.4\" Y=\"0.4\" Z=\"0.4\"/>\n<models>"
        "<model file=\"teapot.patch\"/></models>\n</group>\n</group>\n</scene>\n";
    out.push_back(otherwise("2017 dialect", old));
    // 10. Commands in place of files, named colours, divisions left open.
    std::string commands =
        replacedAll(base, "<model file=\"sphere_1_16_12.3d\">", "<model command=\"sphere 1\">");
    commands = replaced(commands, "<model file=\"teapot.patch\"/>",
                        "<model command=\"patch teapot.patch\"/>");
    out.push_back(otherwise("2020 commands", commands));
    return out;
}

}  // namespace farol::test
