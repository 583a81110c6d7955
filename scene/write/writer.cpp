#include "scene/write/writer.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>

#include "core/number.h"
#include "scene/write/xml_writer.h"

namespace farol::scene {
namespace {

std::string floatText(float value) {
    if (value == 0.0F) return "0";
    char digits[32];
    const auto [end, failed] = std::to_chars(digits, digits + sizeof digits, value);
    return failed == std::errc{} ? std::string(digits, end) : "0";
}

/// 0..255 with all digits: the reader's division gives the same float.
std::string byteText(float value) { return formatNumber(double{value} * 255.0); }

std::string tripleText(const glm::vec3& rgb) {
    return byteText(rgb.r) + "," + byteText(rgb.g) + "," + byteText(rgb.b);
}

std::string planeText(const glm::dvec4& plane) {
    return formatNumber(plane.x) + " " + formatNumber(plane.y) + " " + formatNumber(plane.z) + " " +
           formatNumber(plane.w);
}

class SceneWriter {
  public:
    SceneWriter(const Scene& scene, Form form) : scene_(scene), form_(form) {}

    std::string write() {
        const bool isWorld = form_ == Form::canonical || form_ == Form::course;
        const std::string_view root = isWorld ? "world" : "scene";
        out_.begin(root);
        if (form_ == Form::canonical) {
            static constexpr std::string_view kDialects[] = {"course", "engine2017", "engine2020"};
            out_.text("dialect", kDialects[static_cast<std::size_t>(scene_.dialect)]);
        } else if (!isWorld) {
            out_.text("dialect", kFormWords[form_]);
        }
        out_.content();
        if (form_ == Form::canonical && !scene_.title.empty()) out_.element("title", scene_.title);
        if (form_ == Form::canonical && !scene_.description.empty())
            out_.element("description", scene_.description);
        if (scene_.window) {
            out_.begin("window");
            out_.number("width", scene_.window->width);
            out_.number("height", scene_.window->height);
            out_.leaf();
        }
        if (scene_.camera) camera(*scene_.camera);
        surroundings();
        for (const auto& [file, words] : scene_.generatorComments) {
            std::string line = "generator";
            for (const std::string& word : words) line += " " + word;
            out_.comment(line + " " + file);
        }
        if (form_ == Form::engine2020) colors();
        lights(scene_.lights);
        for (const Group& one : scene_.groups) group(one);
        out_.close(root);
        return out_.take();
    }

  private:
    void surroundings() {
        if (form_ == Form::canonical) settings(scene_.settings);
        const bool hasColor = scene_.background.color && form_ == Form::canonical;
        if ((hasColor || !scene_.background.file.empty()) && isAny(Form::engine2017)) {
            out_.begin("background");
            out_.optionalText("texture", scene_.background.file);
            if (hasColor) out_.text("color", tripleText(*scene_.background.color));
            out_.leaf();
        }
        if (scene_.skybox && isAny(Form::engine2020)) {
            out_.begin("skybox");
            out_.text("texture", scene_.skybox->file);
            out_.number("width", scene_.skybox->width);
            out_.leaf();
        }
        if (!scene_.entityFile.empty() && isAny(Form::engine2017)) {
            out_.begin("entity");
            out_.text("file", scene_.entityFile);
            out_.leaf();
        }
    }

    /// Whether the form is canonical or `form`.
    bool isAny(Form form) const { return form_ == Form::canonical || form_ == form; }

    void camera(const Camera& camera) {
        out_.begin("camera");
        out_.content();
        out_.begin("position");
        out_.vector("", "xyz", camera.eye);
        out_.leaf();
        out_.begin("lookAt");
        out_.vector("", "xyz", camera.target);
        out_.leaf();
        out_.begin("up");
        out_.vector("", "xyz", camera.up);
        out_.leaf();
        out_.begin("projection");
        out_.number("fov", camera.fovDeg);
        out_.number("near", camera.near);
        out_.number("far", camera.far);
        out_.leaf();
        out_.close("camera");
    }

    void settings(const RenderSettings& settings) {
        if (settings == RenderSettings{}) return;
        out_.begin("render");
        if (settings.shading) out_.text("shading", kShadingWords[*settings.shading]);
        if (settings.samples) out_.number("aa", *settings.samples);
        if (settings.axes) out_.text("axes", *settings.axes ? "true" : "false");
        if (settings.viewer) out_.text("viewer", kViewerWords[*settings.viewer]);
        if (settings.specular) out_.text("specular", kSpecularWords[*settings.specular]);
        if (settings.transparency)
            out_.text("transparency", kTransparencyWords[*settings.transparency]);
        if (settings.shadows) out_.text("shadows", kShadowsWords[*settings.shadows]);
        if (settings.timeRangeS)
            out_.text("time", formatNumber(settings.timeRangeS->x) + " " +
                                  formatNumber(settings.timeRangeS->y));
        out_.leaf();
    }

    // Lights.

    void lightColor(std::string_view prefix, std::string_view name, const Color& color,
                    const Color& fallback) {
        if (form_ == Form::course) return;
        if (form_ == Form::engine2020) {
            if (!(color == fallback)) out_.text(name, nameOf(color));
            return;
        }
        if (color.cycles) return out_.text(name, "rgb");
        for (int i = 0; i < 3; ++i)
            out_.text(std::string(prefix) + "RGB"[i], floatText(color.rgb[i]));
    }

    void lights(const std::vector<Light>& lights) {
        if (lights.empty()) return;
        out_.begin("lights");
        out_.content();
        for (const Light& one : lights) light(one);
        out_.close("lights");
    }

    void light(const Light& light) {
        const Light plain;
        out_.begin("light");
        out_.text("type", kLightTypeWords[light.type]);
        if (light.space == LightSpace::camera && form_ == Form::canonical)
            out_.text("space", "camera");
        const bool isSpot = light.type == LightType::spot;
        // A dialect has few attributes, written where they have an effect.
        const auto set = [&](std::string_view name, double value, double fallback, bool applies) {
            if (form_ == Form::canonical || (applies && value != fallback))
                out_.number(name, value);
        };
        const bool is2017 = form_ == Form::engine2017;
        if (light.type != LightType::directional) out_.vector("pos", "XYZ", light.position);
        if (light.type != LightType::point)
            out_.vector(!is2017 ? "dir" : isSpot ? "spotDir" : "pos", "XYZ", light.direction);
        if (isSpot || form_ == Form::canonical) out_.number("cutoff", light.cutoffDeg);
        set("exponent", light.exponent, plain.exponent, isSpot && form_ != Form::engine2020);
        const bool isPlaced = light.type != LightType::directional;
        const bool hasTerms = isPlaced && form_ != Form::engine2020;
        set("constant", light.constant, plain.constant, hasTerms);
        set("linear", light.linear, plain.linear, hasTerms);
        set(form_ == Form::engine2020 ? "attenuation" : "quadratic", light.quadratic,
            plain.quadratic, isPlaced);
        lightColor("diff", "diffuse", light.diffuse, plain.diffuse);
        lightColor("ambt", "ambient", light.ambient, plain.ambient);
        lightColor("spec", "specular", light.specular, plain.specular);
        out_.leaf();
    }

    // Named colours of the 2020 dialect.

    /// The name of a colour, given to it at its first use.
    std::string nameOf(const Color& color) {
        if (color.cycles) return "rgb";
        const std::string key =
            floatText(color.rgb.r) + ' ' + floatText(color.rgb.g) + ' ' + floatText(color.rgb.b);
        const auto [at, isNew] = names_.emplace(key, "");
        if (isNew) {
            at->second = "color" + std::to_string(names_.size());
            named_.push_back({at->second, color.rgb});
        }
        return at->second;
    }

    void nameColors(const Group& group) {
        for (const Model& one : group.models)
            if (one.material)
                for (const Color* color : {&one.material->diffuse, &one.material->ambient,
                                           &one.material->specular, &one.material->emissive})
                    nameOf(*color);
        for (const Group& child : group.groups) nameColors(child);
    }

    /// They stand before their uses.
    void colors() {
        for (const Light& one : scene_.lights)
            for (const Color* color : {&one.diffuse, &one.ambient, &one.specular}) nameOf(*color);
        for (const Group& one : scene_.groups) nameColors(one);
        if (named_.empty()) return;
        out_.begin("colors");
        out_.content();
        for (const NamedColor& one : named_) {
            out_.begin("color");
            out_.text("name", one.name);
            for (int i = 0; i < 3; ++i) out_.text(std::string(1, "rgb"[i]), floatText(one.rgb[i]));
            out_.text("a", "1");
            out_.leaf();
        }
        out_.close("colors");
    }

    // Groups.

    void operator()(const Translate& t) {
        out_.begin("translate");
        out_.vector("", "xyz", t.offset);
        out_.leaf();
    }
    void operator()(const FollowCurve& t) {
        out_.begin("translate");
        out_.number("time", t.seconds);
        out_.text("align", t.align ? "true" : "false");
        out_.content();
        for (const glm::dvec3& point : t.points) {
            out_.begin("point");
            out_.vector("", "xyz", point);
            out_.leaf();
        }
        out_.close("translate");
    }
    void operator()(const Rotate& t) {
        out_.begin("rotate");
        out_.number("angle", t.angleDeg);
        axis(t.axis);
    }
    void operator()(const Spin& t) {
        out_.begin("rotate");
        out_.number("time", t.seconds);
        axis(t.axis);
    }
    void operator()(const Scale& t) {
        out_.begin("scale");
        out_.vector("", "xyz", t.factors);
        out_.leaf();
    }
    void axis(const glm::dvec3& axis) {
        if (form_ == Form::engine2017)
            out_.vector("axis", "XYZ", axis);
        else
            out_.vector("", "xyz", axis);
        out_.leaf();
    }

    void group(const Group& group) {
        out_.begin("group");
        out_.optionalText("name", group.name);
        out_.content();
        const bool isListed = form_ == Form::canonical || form_ == Form::course;
        if (!group.transforms.empty()) {
            if (isListed) {
                out_.begin("transform");
                out_.content();
            }
            for (const Transform& transform : group.transforms)
                std::visit([this](const auto& one) { (*this)(one); }, transform);
            if (isListed) out_.close("transform");
        }
        if (group.scatter && form_ == Form::canonical) scatter(*group.scatter);
        if (isAny(Form::engine2017)) lights(group.lights);
        if (!group.models.empty()) {
            out_.begin("models");
            out_.content();
            for (const Model& one : group.models) model(one);
            out_.close("models");
        }
        for (const Group& child : group.groups) this->group(child);
        out_.close("group");
    }

    void scatter(const Scatter& scatter) {
        out_.begin("scatter");
        out_.number("count", scatter.count);
        out_.number("xzMin", scatter.radiusMin);
        out_.number("xzMax", scatter.radiusMax);
        out_.number("yMin", scatter.yMin);
        out_.number("yMax", scatter.yMax);
        out_.number("seed", static_cast<double>(scatter.seed));
        out_.leaf();
    }

    // Models.

    void model(const Model& model) {
        out_.begin("model");
        out_.optionalText("file", model.file);
        if (isAny(Form::engine2020)) out_.optionalText("command", model.command);
        if (form_ == Form::canonical) {
            if (model.revolve) out_.number("revolve", *model.revolve);
            if (model.uv != UvLayout::face)
                out_.text("uv", model.uv == UvLayout::atlas ? "atlas" : "layout2017");
            if (model.autoLod) out_.text("lod", "auto");
            if (model.twoSided) out_.text("twoSided", "true");
            if (model.opacity != 1.0F) out_.text("opacity", floatText(model.opacity));
        }
        out_.optionalText("id", model.id);
        out_.optionalText("name", model.name);
        if (form_ == Form::engine2017 || form_ == Form::engine2020) {
            if (model.texture) out_.optionalText("texture", model.texture->file);
            if (model.material) attributes(*model.material);
            return out_.leaf();
        }
        if (!model.texture && !model.material) return out_.leaf();
        out_.content();
        if (model.texture) texture(*model.texture);
        if (model.material) material(*model.material);
        out_.close("model");
    }

    /// A material as attributes of its model.
    void attributes(const Material& material) {
        const auto set = [&](std::string_view prefix, std::string_view name, const Color& color) {
            if (form_ == Form::engine2020) return out_.text(name, nameOf(color));
            for (int i = 0; i < 3; ++i)
                out_.text(std::string(prefix) + "RGB"[i], floatText(color.rgb[i]));
        };
        set("diff", "diffuse", material.diffuse);
        set("ambt", "ambient", material.ambient);
        set("spec", "specular", material.specular);
        set("emis", "emission", material.emissive);
        out_.text("shininess", floatText(material.shininess));
    }

    void color(std::string_view name, const Color& color, float opacity = 1.0F) {
        out_.begin(name);
        if (opacity != 1.0F && form_ == Form::canonical) out_.text("A", floatText(opacity));
        if (color.cycles) {
            out_.text("cycles", "true");
            return out_.leaf();
        }
        const bool isCanonical = form_ == Form::canonical;
        float largest = 0.0F;
        for (int i = 0; i < 3; ++i) {
            out_.text(std::string(1, "RGB"[i]),
                      isCanonical ? floatText(color.rgb[i]) : byteText(color.rgb[i]));
            largest = std::max(largest, color.rgb[i]);
        }
        // Numbers of which none is over 1 may be of either scale.
        if (isCanonical)
            out_.text("max", "1");
        else if (largest > 0.0F && largest * 255.0F <= 1.0F)
            out_.text("max", "255");
        out_.leaf();
    }

    void material(const Material& material) {
        out_.begin("color");
        out_.content();
        color("diffuse", material.diffuse, material.opacity);
        color("ambient", material.ambient);
        color("specular", material.specular);
        color("emissive", material.emissive);
        out_.begin("shininess");
        out_.text("value", floatText(material.shininess));
        out_.leaf();
        out_.close("color");
    }

    void texture(const Texture& texture) {
        out_.begin("texture");
        const bool isCanonical = form_ == Form::canonical;
        if (texture.chess && isCanonical) {
            out_.text("file", "chess:" + std::to_string(texture.chess->columns) + "x" +
                                  std::to_string(texture.chess->rows));
            out_.text("color1", tripleText(texture.chess->first));
            out_.text("color2", tripleText(texture.chess->second));
        } else {
            out_.text("file", texture.file);
        }
        if (isCanonical && texture.mapping == Mapping::sphere) out_.text("mapping", "sphere");
        if (isCanonical && texture.filter) out_.text("filter", kFilterWords[*texture.filter]);
        out_.leaf();
        if (isCanonical) texgen(texture);
    }

    void texgen(const Texture& texture) {
        const Texture plain;
        const bool isGenerated =
            texture.mapping == Mapping::texgenObject || texture.mapping == Mapping::texgenEye;
        if (!isGenerated && texture.planeS == plain.planeS && texture.planeT == plain.planeT)
            return;
        out_.begin("texgen");
        out_.text("mode", texture.mapping == Mapping::texgenEye ? "eye" : "object");
        out_.text("s", planeText(texture.planeS));
        out_.text("t", planeText(texture.planeT));
        out_.leaf();
    }

    struct NamedColor {
        std::string name;
        glm::vec3 rgb;
    };

    const Scene& scene_;
    const Form form_;
    XmlWriter out_;
    std::map<std::string, std::string> names_;  ///< of the 2020 dialect's colours
    std::vector<NamedColor> named_;
};

}  // namespace

std::string write(const Scene& scene, Form form) { return SceneWriter(scene, form).write(); }

}  // namespace farol::scene
