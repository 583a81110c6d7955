#include "interchange/adapt.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "core/text.h"
#include "generator/call.h"
#include "interchange/messages.h"
#include "scene/animation.h"

namespace farol::interchange {
namespace {

using scene::Dialect;
using scene::Form;
using scene::Group;
using scene::Material;
using scene::Model;

constexpr std::size_t kMaxGroups = 20'000;  ///< of a document, by the copies of scattered groups

Dialect dialectOf(Form form) {
    return form == Form::course       ? Dialect::course
           : form == Form::engine2017 ? Dialect::engine2017
                                      : Dialect::engine2020;
}

std::string_view nameOf(Form form) {
    return form == Form::course       ? "the course dialect"
           : form == Form::engine2017 ? "the 2017 dialect"
                                      : "the 2020 dialect";
}

float globalAmbientOf(Dialect dialect) { return dialect == Dialect::course ? 1.0F : 0.2F; }

bool anyModel(const std::vector<Group>& groups, bool (*test)(const Model&)) {
    return std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
        return std::any_of(group.models.begin(), group.models.end(), test) ||
               anyModel(group.groups, test);
    });
}

bool anyLight(const std::vector<Group>& groups, bool (*test)(const scene::Light&)) {
    return std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
        return std::any_of(group.lights.begin(), group.lights.end(), test) ||
               anyLight(group.groups, test);
    });
}

class Adapter {
  public:
    Adapter(const scene::Scene& from, Form form, Diagnostics& findings)
        : from_(from), form_(form), findings_(findings) {}

    scene::Scene run() {
        scene_ = from_;
        scene_.dialect = dialectOf(form_);
        isDressed_ = anyModel(from_.groups, [](const Model& model) {
            return model.material || model.texture || model.source.materials;
        });
        const auto any = [](const scene::Light&) { return true; };
        const auto ambient = [](const scene::Light& light) {
            return light.ambient.cycles || light.ambient.rgb != glm::vec3(0.0F);
        };
        isLit_ = !from_.lights.empty() || anyLight(from_.groups, any);
        hasAmbientLight_ = std::any_of(from_.lights.begin(), from_.lights.end(), ambient) ||
                           anyLight(from_.groups, ambient);
        surroundings();
        lights(scene_.lights);
        std::vector<Group> groups;
        for (const Group& group : from_.groups) groups.push_back(adapted(group));
        scene_.groups = std::move(groups);
        return std::move(scene_);
    }

  private:
    void leaveOut(std::string_view feature, Message text, const Location& where) {
        if (!noted_.insert(feature).second) return;
        findings_.push_back(diagnosticOf(
            Severity::warning,
            message<"convert.left-out">("format"_arg = nameOf(form_), "feature"_arg = text),
            where));
    }

    void surroundings() {
        if (!(from_.settings == scene::RenderSettings{}))
            leaveOut("settings", message<"part.feature-settings">(), from_.where);
        if (from_.background.color || (!from_.background.file.empty() && form_ != Form::engine2017))
            leaveOut("background", message<"part.feature-background">(), from_.background.where);
        if (from_.skybox && form_ != Form::engine2020)
            leaveOut("skybox", message<"part.feature-skybox">(), from_.skybox->where);
        if (from_.entity && form_ != Form::engine2017)
            leaveOut("entity", message<"part.feature-entity">(), from_.where);
        if (scene_.skybox && !scene_.skybox->path.empty())
            scene_.skybox->file = scene_.skybox->path;
    }

    void lights(std::vector<scene::Light>& lights) {
        constexpr std::size_t kMaxOf2020 = 8;
        const scene::Light plain;
        for (const scene::Light& light : lights) {
            if (light.space == scene::LightSpace::camera)
                leaveOut("camera-light", message<"part.feature-camera-light">(), light.where);
            const bool isColored = !(light.diffuse == plain.diffuse) ||
                                   !(light.specular == plain.specular) ||
                                   !(light.ambient == plain.ambient);
            if (isColored && form_ == Form::course)
                leaveOut("light-color", message<"part.feature-light-color">(), light.where);
            if (form_ == Form::engine2017 &&
                (light.diffuse.cycles || light.specular.cycles || light.ambient.cycles))
                leaveOut("cycles", message<"part.feature-cycles">(), light.where);
            const bool isPlaced = light.type != scene::LightType::directional;
            if (form_ == Form::engine2020 && isPlaced &&
                (light.constant != 1.0 || light.linear != 0.0))
                leaveOut("attenuation", message<"part.feature-attenuation">(), light.where);
            if (form_ == Form::engine2020 && light.type == scene::LightType::spot &&
                light.exponent != 0.0)
                leaveOut("exponent", message<"part.feature-exponent">(), light.where);
        }
        if (form_ != Form::engine2020 || lights.size() <= kMaxOf2020) return;
        leaveOut("ninth-light", message<"part.feature-ninth-light">(), lights[kMaxOf2020].where);
        lights.resize(kMaxOf2020);
    }

    /// Kinds of transforms of which a group of the dialects has one each.
    static int kindOf(const scene::Transform& transform) {
        if (std::holds_alternative<scene::Translate>(transform) ||
            std::holds_alternative<scene::FollowCurve>(transform))
            return 1;
        return std::holds_alternative<scene::Scale>(transform) ? 4 : 2;
    }

    void countGroup(const Location& where) {
        if (++groups_ > kMaxGroups)
            throw Error(message<"limit.instances/document">("max"_arg = kMaxGroups), where);
    }

    Group adapted(const Group& from) {
        countGroup(from.where);
        Group content;
        content.lights = from.lights;
        if (!from.lights.empty() && form_ != Form::engine2017) {
            leaveOut("group-light", message<"part.feature-group-light">(), from.lights[0].where);
            content.lights.clear();
        }
        lights(content.lights);
        for (const Model& model : from.models) content.models.push_back(adapted(model));
        for (const Group& child : from.groups) content.groups.push_back(adapted(child));
        Group inner = std::move(content);
        if (from.scatter) {
            Group ring;
            for (const glm::dmat4& place :
                 scene::scatterMatrices(*from.scatter, from.scatter->seed)) {
                countGroup(from.where);
                ring.groups.push_back(inner);
                ring.groups.back().transforms = {scene::Translate{glm::dvec3(place[3])}};
            }
            inner = std::move(ring);
        }
        // From the innermost group outwards.
        std::vector<std::vector<scene::Transform>> chain(1);
        int kinds = 0;
        for (const scene::Transform& transform : from.transforms) {
            const int kind = kindOf(transform);
            if ((kinds & kind) != 0) {
                chain.emplace_back();
                kinds = 0;
            }
            kinds |= kind;
            chain.back().push_back(transform);
        }
        inner.transforms = chain.back();
        for (std::size_t i = chain.size() - 1; i-- > 0;) {
            countGroup(from.where);
            Group outer;
            outer.transforms = chain[i];
            outer.groups.push_back(std::move(inner));
            inner = std::move(outer);
        }
        inner.name = from.name;
        return inner;
    }

    Model adapted(const Model& from) {
        Model model = from;
        source(model);
        if (model.uv != scene::UvLayout::face)
            leaveOut("uv", message<"part.feature-uv">(), model.where);
        if (model.autoLod) leaveOut("lod", message<"part.feature-lod">(), model.where);
        // The resolver makes planes of the 2017 dialect two-sided.
        const bool isSheet =
            model.source.isSheet ||
            (model.source.kind == scene::ModelSource::Kind::shape &&
             lowerCase(generator::textOf(model.source.shape)).starts_with("plane"));
        const bool becomesTwoSided = form_ == Form::engine2017 && isSheet;
        if (model.twoSided != becomesTwoSided)
            leaveOut("two-sided", message<"part.feature-two-sided">(), model.where);
        if (model.texture) texture(*model.texture);
        material(model);
        return model;
    }

    /// Names the file or shape in the dialect's way. Other paths than those of the document itself
    /// are written in full.
    void source(Model& model) {
        using Kind = scene::ModelSource::Kind;
        if (model.source.kind == Kind::file) {
            if (model.where.file != from_.document.name && !model.source.path.empty())
                model.file = model.source.path;
            return;
        }
        if (model.source.kind != Kind::shape) return;
        const std::string call = generator::textOf(model.source.shape);
        if (form_ == Form::engine2020) {
            model.command = call;
            model.file.clear();
            model.revolve.reset();
            return;
        }
        std::vector<std::string> words;
        for (const std::string_view word : split(call)) words.emplace_back(word);
        const bool isNamed = !model.file.empty() && model.command.empty() && !model.revolve;
        if (isNamed && scene_.generatorComments.count(model.file) == 0 &&
            model.source.path.empty() && model.where.file == from_.document.name)
            return;  // its name is the call
        std::string name = joined(words, "_") + ".3d";
        std::replace(name.begin(), name.end(), '/', '_');
        model.file = isNamed ? model.file : name;
        model.command.clear();
        model.revolve.reset();
        scene_.generatorComments[model.file] = std::move(words);
    }

    void texture(scene::Texture& texture) {
        if (texture.chess)
            leaveOut("chess", message<"part.feature-chess-texture">(), texture.where);
        if (texture.mapping != scene::Mapping::mesh)
            leaveOut("mapping", message<"part.feature-mapping">(), texture.where);
        if (texture.filter) leaveOut("filter", message<"part.feature-filter">(), texture.where);
        if (!texture.path.empty() && texture.where.file != from_.document.name)
            texture.file = texture.path;
    }

    /// Writes the material that the model has, or had by its dialect's defaults.
    void material(Model& model) {
        const Dialect target = dialectOf(form_);
        const float before = from_.globalAmbient.r, after = globalAmbientOf(target);
        const Material fallback = defaultMaterial(from_.dialect);
        if (!model.material) {
            const bool isSame = fallback == defaultMaterial(target) && before == after;
            // An explicit colour would end the automatic wireframe.
            if (isSame || (!isLit_ && !isDressed_)) return;
            const bool mayHaveColors = model.source.kind == scene::ModelSource::Kind::file &&
                                       !model.texture && !model.file.ends_with(".3d");
            if (mayHaveColors) {
                leaveOut("default-color", message<"part.feature-default-color">(), model.where);
                return;
            }
            model.material = fallback;
        }
        Material& material = *model.material;
        if (form_ != Form::engine2020 && form_ != Form::course &&
            (material.diffuse.cycles || material.ambient.cycles || material.specular.cycles ||
             material.emissive.cycles))
            leaveOut("cycles", message<"part.feature-cycles">(), model.where);
        if (before == after || !isLit_) return;
        if (material.ambient.cycles || material.emissive.cycles || hasAmbientLight_) {
            leaveOut("ambient", message<"part.feature-ambient">(), model.where);
            return;
        }
        // The sum of the terms is the same to the bit; beyond 1 it is clamped in any case.
        material.emissive.rgb = glm::min(
            material.emissive.rgb + material.ambient.rgb * from_.globalAmbient, glm::vec3(1.0F));
        material.ambient.rgb = glm::vec3(0.0F);
    }

    const scene::Scene& from_;
    const Form form_;
    Diagnostics& findings_;
    scene::Scene scene_;
    std::set<std::string_view> noted_;
    std::size_t groups_ = 0;
    bool isDressed_ = false, isLit_ = false, hasAmbientLight_ = false;
};

}  // namespace

scene::Scene adapt(const scene::Scene& scene, Form form, Diagnostics& findings) {
    if (form == Form::canonical) return scene;
    return Adapter(scene, form, findings).run();
}

}  // namespace farol::interchange
