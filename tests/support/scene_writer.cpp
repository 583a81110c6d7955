#include "tests/support/scene_writer.h"

#include <charconv>
#include <string_view>

#include "core/number.h"

namespace farol::scene {
namespace {

std::string floatText(float value) {
    if (value == 0.0F) return "0";
    char digits[32];
    const auto [end, failed] = std::to_chars(digits, digits + sizeof digits, value);
    return failed == std::errc{} ? std::string(digits, end) : "0";
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\n':
                result += "&#10;";
                break;
            case '\r':
                result += "&#13;";
                break;
            case '\t':
                result += "&#9;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

/// Builds indented XML. `open` and `leaf` begin a tag, attributes follow, `children` or `end`
/// close it.
class Writer {
  public:
    std::string take() { return std::move(out_); }

    void begin(std::string_view name) {
        indent();
        out_ += "<";
        out_ += name;
    }
    void text(std::string_view name, std::string_view value) {
        out_ += " ";
        out_ += name;
        out_ += "=\"" + escaped(value) + "\"";
    }
    void optionalText(std::string_view name, std::string_view value) {
        if (!value.empty()) text(name, value);
    }
    void number(std::string_view name, double value) { text(name, formatNumber(value)); }
    void vector(std::string_view prefix, std::string_view axes, const glm::dvec3& v) {
        for (int i = 0; i < 3; ++i)
            number(std::string(prefix) + axes[static_cast<std::size_t>(i)], v[i]);
    }
    void leaf() { out_ += "/>\n"; }
    void content() {
        out_ += ">\n";
        ++depth_;
    }
    void close(std::string_view name) {
        --depth_;
        indent();
        out_ += "</";
        out_ += name;
        out_ += ">\n";
    }
    void element(std::string_view name, std::string_view value) {
        begin(name);
        out_ += ">" + escaped(value) + "</";
        out_ += name;
        out_ += ">\n";
    }
    void comment(const std::string& words) {
        if (words.find("--") != std::string::npos) return;  // no comment can hold it
        indent();
        out_ += "<!-- " + words + " -->\n";
    }

  private:
    void indent() { out_.append(static_cast<std::size_t>(2 * depth_), ' '); }
    std::string out_;
    int depth_ = 0;
};

void writeTransform(Writer& out, const Translate& t) {
    out.begin("translate");
    out.vector("", "xyz", t.offset);
    out.leaf();
}

void writeTransform(Writer& out, const FollowCurve& t) {
    out.begin("translate");
    out.number("time", t.seconds);
    out.text("align", t.align ? "true" : "false");
    out.content();
    for (const glm::dvec3& point : t.points) {
        out.begin("point");
        out.vector("", "xyz", point);
        out.leaf();
    }
    out.close("translate");
}

void writeTransform(Writer& out, const Rotate& t) {
    out.begin("rotate");
    out.number("angle", t.angleDeg);
    out.vector("", "xyz", t.axis);
    out.leaf();
}

void writeTransform(Writer& out, const Spin& t) {
    out.begin("rotate");
    out.number("time", t.seconds);
    out.vector("", "xyz", t.axis);
    out.leaf();
}

void writeTransform(Writer& out, const Scale& t) {
    out.begin("scale");
    out.vector("", "xyz", t.factors);
    out.leaf();
}

void writeLightColor(Writer& out, std::string_view prefix, std::string_view name,
                     const Color& color) {
    if (color.cycles) return out.text(name, "rgb");
    for (int i = 0; i < 3; ++i) out.text(std::string(prefix) + "RGB"[i], floatText(color.rgb[i]));
}

void writeLights(Writer& out, const std::vector<Light>& lights) {
    if (lights.empty()) return;
    out.begin("lights");
    out.content();
    for (const Light& light : lights) {
        out.begin("light");
        out.text("type", kLightTypeWords[light.type]);
        if (light.space == LightSpace::camera) out.text("space", "camera");
        if (light.type != LightType::directional) out.vector("pos", "XYZ", light.position);
        if (light.type != LightType::point) out.vector("dir", "XYZ", light.direction);
        out.number("cutoff", light.cutoffDeg);
        out.number("exponent", light.exponent);
        out.number("constant", light.constant);
        out.number("linear", light.linear);
        out.number("quadratic", light.quadratic);
        writeLightColor(out, "diff", "diffuse", light.diffuse);
        writeLightColor(out, "ambt", "ambient", light.ambient);
        writeLightColor(out, "spec", "specular", light.specular);
        out.leaf();
    }
    out.close("lights");
}

void writeColor(Writer& out, std::string_view name, const Color& color) {
    out.begin(name);
    if (color.cycles) {
        out.text("cycles", "true");
    } else {
        out.text("R", floatText(color.rgb.r));
        out.text("G", floatText(color.rgb.g));
        out.text("B", floatText(color.rgb.b));
        out.text("max", "1");
    }
    out.leaf();
}

void writeMaterial(Writer& out, const Material& material) {
    out.begin("color");
    out.content();
    writeColor(out, "diffuse", material.diffuse);
    writeColor(out, "ambient", material.ambient);
    writeColor(out, "specular", material.specular);
    writeColor(out, "emissive", material.emissive);
    out.begin("shininess");
    out.text("value", floatText(material.shininess));
    out.leaf();
    out.close("color");
}

/// 0..255 with all digits: the reader's division gives the same float.
std::string tripleText(const glm::vec3& rgb) {
    return formatNumber(double{rgb.r} * 255.0) + "," + formatNumber(double{rgb.g} * 255.0) + "," +
           formatNumber(double{rgb.b} * 255.0);
}

std::string planeText(const glm::dvec4& plane) {
    return formatNumber(plane.x) + " " + formatNumber(plane.y) + " " + formatNumber(plane.z) + " " +
           formatNumber(plane.w);
}

void writeTexture(Writer& out, const Texture& texture) {
    out.begin("texture");
    if (texture.chess) {
        out.text("file", "chess:" + std::to_string(texture.chess->columns) + "x" +
                             std::to_string(texture.chess->rows));
        out.text("color1", tripleText(texture.chess->first));
        out.text("color2", tripleText(texture.chess->second));
    } else {
        out.text("file", texture.file);
    }
    if (texture.mapping == Mapping::sphere) out.text("mapping", "sphere");
    if (texture.filter) out.text("filter", kFilterWords[*texture.filter]);
    out.leaf();
    const Texture plain;
    const bool texgen =
        texture.mapping == Mapping::texgenObject || texture.mapping == Mapping::texgenEye;
    if (!texgen && texture.planeS == plain.planeS && texture.planeT == plain.planeT) return;
    out.begin("texgen");
    out.text("mode", texture.mapping == Mapping::texgenEye ? "eye" : "object");
    out.text("s", planeText(texture.planeS));
    out.text("t", planeText(texture.planeT));
    out.leaf();
}

void writeModel(Writer& out, const Model& model) {
    out.begin("model");
    out.optionalText("file", model.file);
    out.optionalText("command", model.command);
    if (model.revolve) out.number("revolve", *model.revolve);
    if (model.uv != UvLayout::face)
        out.text("uv", model.uv == UvLayout::atlas ? "atlas" : "layout2017");
    if (model.autoLod) out.text("lod", "auto");
    if (model.twoSided) out.text("twoSided", "true");
    out.optionalText("id", model.id);
    out.optionalText("name", model.name);
    if (!model.texture && !model.material) return out.leaf();
    out.content();
    if (model.texture) writeTexture(out, *model.texture);
    if (model.material) writeMaterial(out, *model.material);
    out.close("model");
}

void writeScatter(Writer& out, const Scatter& scatter) {
    out.begin("scatter");
    out.number("count", scatter.count);
    out.number("xzMin", scatter.radiusMin);
    out.number("xzMax", scatter.radiusMax);
    out.number("yMin", scatter.yMin);
    out.number("yMax", scatter.yMax);
    out.number("seed", static_cast<double>(scatter.seed));
    out.leaf();
}

void writeGroup(Writer& out, const Group& group) {
    out.begin("group");
    out.optionalText("name", group.name);
    out.content();
    if (!group.transforms.empty()) {
        out.begin("transform");
        out.content();
        for (const Transform& transform : group.transforms)
            std::visit([&out](const auto& t) { writeTransform(out, t); }, transform);
        out.close("transform");
    }
    if (group.scatter) writeScatter(out, *group.scatter);
    writeLights(out, group.lights);
    if (!group.models.empty()) {
        out.begin("models");
        out.content();
        for (const Model& model : group.models) writeModel(out, model);
        out.close("models");
    }
    for (const Group& child : group.groups) writeGroup(out, child);
    out.close("group");
}

void writeCamera(Writer& out, const Camera& camera) {
    out.begin("camera");
    out.content();
    out.begin("position");
    out.vector("", "xyz", camera.eye);
    out.leaf();
    out.begin("lookAt");
    out.vector("", "xyz", camera.target);
    out.leaf();
    out.begin("up");
    out.vector("", "xyz", camera.up);
    out.leaf();
    out.begin("projection");
    out.number("fov", camera.fovDeg);
    out.number("near", camera.near);
    out.number("far", camera.far);
    out.leaf();
    out.close("camera");
}

void writeSettings(Writer& out, const RenderSettings& settings) {
    if (settings == RenderSettings{}) return;
    out.begin("render");
    if (settings.shading) out.text("shading", kShadingWords[*settings.shading]);
    if (settings.samples) out.number("aa", *settings.samples);
    if (settings.axes) out.text("axes", *settings.axes ? "true" : "false");
    if (settings.viewer) out.text("viewer", kViewerWords[*settings.viewer]);
    if (settings.specular) out.text("specular", kSpecularWords[*settings.specular]);
    if (settings.timeRangeS)
        out.text("time",
                 formatNumber(settings.timeRangeS->x) + " " + formatNumber(settings.timeRangeS->y));
    out.leaf();
}

}  // namespace

std::string write(const Scene& scene) {
    Writer out;
    static constexpr std::string_view kDialects[] = {"course", "engine2017", "engine2020"};
    out.begin("world");
    out.text("dialect", kDialects[static_cast<std::size_t>(scene.dialect)]);
    out.content();
    if (!scene.title.empty()) out.element("title", scene.title);
    if (!scene.description.empty()) out.element("description", scene.description);
    if (scene.window) {
        out.begin("window");
        out.number("width", scene.window->width);
        out.number("height", scene.window->height);
        out.leaf();
    }
    if (scene.camera) writeCamera(out, *scene.camera);
    writeSettings(out, scene.settings);
    if (scene.background.color || !scene.background.file.empty()) {
        out.begin("background");
        out.optionalText("texture", scene.background.file);
        if (scene.background.color) out.text("color", tripleText(*scene.background.color));
        out.leaf();
    }
    if (scene.skybox) {
        out.begin("skybox");
        out.text("texture", scene.skybox->file);
        out.number("width", scene.skybox->width);
        out.leaf();
    }
    if (!scene.entityFile.empty()) {
        out.begin("entity");
        out.text("file", scene.entityFile);
        out.leaf();
    }
    for (const auto& [file, words] : scene.generatorComments) {
        std::string line = "generator";
        for (const std::string& word : words) line += " " + word;
        out.comment(line + " " + file);
    }
    writeLights(out, scene.lights);
    for (const Group& group : scene.groups) writeGroup(out, group);
    out.close("world");
    return out.take();
}

}  // namespace farol::scene
