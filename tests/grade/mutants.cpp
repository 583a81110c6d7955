#include <algorithm>
#include <cmath>
#include <numbers>

#include "classroom.h"
#include "generator/registry.h"
#include "image/format.h"
#include "image/image_file.h"
#include "scene/animation.h"
#include "scene/write/writer.h"

namespace farol::test {
namespace {

using scene::LightType;
using Result = std::optional<std::string>;

Result written(const Work& work) { return scene::write(work.scene); }

/// The first transform of a kind that `change` takes, changed.
template <typename Kind, typename Change>
Result changeFirst(Work& work, Change change) {
    for (scene::Group* group : groupsOf(work.scene))
        for (scene::Transform& transform : group->transforms)
            if (auto* one = std::get_if<Kind>(&transform))
                if (change(*one)) return written(work);
    return {};
}

template <typename Change>
Result changeLight(Work& work, Change change) {
    for (scene::Light& light : work.scene.lights)
        if (change(light)) return written(work);
    return {};
}

template <typename Change>
Result changeModel(Work& work, Change change) {
    for (const Placed& one : modelsOf(work.scene))
        if (change(*one.model)) return written(work);
    return {};
}

template <typename Change>
Result changeMaterial(Work& work, Change change) {
    if (work.scene.lights.empty()) return {};
    return changeModel(
        work, [&](scene::Model& model) { return model.material && change(*model.material); });
}

Result order(Work& work) {
    for (scene::Group* group : groupsOf(work.scene)) {
        auto& list = group->transforms;
        for (std::size_t i = 0; i + 1 < list.size(); ++i) {
            const glm::dmat4 before = scene::matrixAt(list, 0.0);
            std::swap(list[i], list[i + 1]);
            if (scene::matrixAt(list, 0.0) != before) return written(work);
            std::swap(list[i], list[i + 1]);
        }
    }
    return {};
}

bool turns(const scene::Rotate& rotate) { return std::fmod(rotate.angleDeg, 180.0) != 0.0; }

Result angleSign(Work& work) {
    return changeFirst<scene::Rotate>(work, [](scene::Rotate& rotate) {
        if (!turns(rotate)) return false;
        rotate.angleDeg = -rotate.angleDeg;
        return true;
    });
}

Result radians(Work& work) {
    return changeFirst<scene::Rotate>(work, [](scene::Rotate& rotate) {
        if (!turns(rotate)) return false;
        rotate.angleDeg = std::round(rotate.angleDeg * std::numbers::pi / 180.0 * 1e4) / 1e4;
        return true;
    });
}

Result axis(Work& work) {
    return changeFirst<scene::Rotate>(work, [](scene::Rotate& rotate) {
        if (!turns(rotate)) return false;
        rotate.axis = {rotate.axis.y, rotate.axis.z, rotate.axis.x};
        return true;
    });
}

Result translateSign(Work& work) {
    return changeFirst<scene::Translate>(work, [](scene::Translate& translate) {
        for (int i = 0; i < 3; ++i)
            if (std::abs(translate.offset[i]) > 0.3) {
                translate.offset[i] = -translate.offset[i];
                return true;
            }
        return false;
    });
}

Result scaleMissing(Work& work) {
    for (scene::Group* group : groupsOf(work.scene)) {
        auto& list = group->transforms;
        for (std::size_t i = 0; i < list.size(); ++i)
            if (const auto* scale = std::get_if<scene::Scale>(&list[i]))
                if (glm::length(scale->factors - glm::dvec3(1.0)) > 0.2) {
                    list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
                    return written(work);
                }
    }
    return {};
}

Result translateValue(Work& work) {
    return changeFirst<scene::Translate>(work, [](scene::Translate& translate) {
        translate.offset += glm::dvec3(0.37, 0.21, 0.13);
        return true;
    });
}

Result lightMissing(Work& work) {
    if (work.scene.lights.size() < 2) return {};
    work.scene.lights.erase(work.scene.lights.begin());
    return written(work);
}

Result lightType(Work& work) {
    return changeLight(work, [](scene::Light& light) {
        if (light.type != LightType::directional) return false;
        light.type = LightType::point;
        light.position = light.direction;
        return true;
    });
}

Result lightNegated(Work& work) {
    return changeLight(work, [](scene::Light& light) {
        if (light.type == LightType::point) return false;
        light.direction = -light.direction;
        return true;
    });
}

Result lightMoved(Work& work) {
    return changeLight(work, [](scene::Light& light) {
        if (light.type == LightType::directional) return false;
        light.position.x = -light.position.x - 1.0;
        return true;
    });
}

Result spotCutoff(Work& work) {
    return changeLight(work, [](scene::Light& light) {
        if (light.type != LightType::spot || light.cutoffDeg >= 90.0) return false;
        light.cutoffDeg = std::max(3.0, light.cutoffDeg * 0.5);
        return true;
    });
}

Result normalMatrix(Work& work) {
    if (work.scene.lights.empty()) return {};
    for (const Placed& one : modelsOf(work.scene)) {
        auto& list = one.group->transforms;
        const auto* scale = list.empty() ? nullptr : std::get_if<scene::Scale>(&list.back());
        if (scale == nullptr || one.group->models.size() != 1 || !one.group->groups.empty())
            continue;
        const glm::dvec3 f = scale->factors;
        const double least = std::min({f.x, f.y, f.z}), most = std::max({f.x, f.y, f.z});
        const std::string shape = shapeNameOf(*one.model);
        // Boxes and planes keep their normals under a scale along their axes.
        if (least <= 0.0 || most < 1.3 * least || shape.empty() || shape == "box" ||
            shape == "plane")
            continue;
        static glm::vec3 factors;
        factors = glm::vec3(f);
        if (!replaceMesh(work, *one.model, "scaled.obj", [](generator::MeshArrays& mesh) {
                for (glm::vec3& position : mesh.positions) position *= factors;
                for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal * factors);
            }))
            continue;
        list.pop_back();
        return written(work);
    }
    return {};
}

bool isRound(const scene::Model& model) {
    const std::string shape = shapeNameOf(model);
    return shape == "sphere" || shape == "cone" || shape == "cylinder" || shape == "torus";
}

Result meshChanged(Work& work, const std::string& file, bool textured, bool round,
                   void (*change)(generator::MeshArrays&)) {
    return changeModel(work, [&](scene::Model& model) {
        if ((textured && (!model.texture || model.texture->mapping != scene::Mapping::mesh)) ||
            (round && !isRound(model)))
            return false;
        return replaceMesh(work, model, file, change);
    });
}

Result flat(Work& work) {
    if (work.scene.lights.empty()) return {};
    return meshChanged(work, "flat.obj", false, true, [](generator::MeshArrays& mesh) {
        generator::MeshArrays out;
        for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
            const glm::vec3 a = mesh.positions[mesh.indices[t]],
                            b = mesh.positions[mesh.indices[t + 1]],
                            c = mesh.positions[mesh.indices[t + 2]];
            const glm::vec3 across = glm::cross(b - a, c - a);
            if (glm::length(across) == 0.0F) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t from = mesh.indices[t + k];
                out.indices.push_back(static_cast<std::uint32_t>(out.positions.size()));
                out.positions.push_back(mesh.positions[from]);
                out.normals.push_back(glm::normalize(across));
                if (!mesh.uvs.empty()) out.uvs.push_back(mesh.uvs[from]);
            }
        }
        mesh = out;
    });
}

Result vFlipped(Work& work) {
    return meshChanged(work, "flipped.obj", true, false, [](generator::MeshArrays& mesh) {
        for (glm::vec2& uv : mesh.uvs) uv.y = 1.0F - uv.y;
    });
}

Result uMirrored(Work& work) {
    return meshChanged(work, "mirrored.obj", true, false, [](generator::MeshArrays& mesh) {
        for (glm::vec2& uv : mesh.uvs) uv.x = 1.0F - uv.x;
    });
}

Result normalsInward(Work& work) {
    if (work.scene.lights.empty()) return {};
    return meshChanged(work, "inward.obj", false, true, [](generator::MeshArrays& mesh) {
        for (glm::vec3& normal : mesh.normals) normal = -normal;
    });
}

Result winding(Work& work) {
    return changeModel(work, [&](scene::Model& model) {
        const std::string shape = shapeNameOf(model);
        return !shape.empty() && replaceMesh(work, model, "clockwise.obj", turnTriangles);
    });
}

Result culling(Work& work) {
    return changeModel(work, [](scene::Model& model) {
        const bool had = model.twoSided;
        model.twoSided = false;
        return had;
    });
}

Result pictureUpsideDown(Work& work) {
    return changeModel(work, [&](scene::Model& model) {
        if (!model.texture || model.texture->path.empty()) return false;
        image::Image image =
            image::decodeImage(work.files.at(model.texture->path), model.texture->path);
        const auto row = static_cast<std::ptrdiff_t>(image.width) * 4;
        for (std::ptrdiff_t y = 0; y < image.height / 2; ++y)
            std::swap_ranges(image.pixels.begin() + y * row, image.pixels.begin() + (y + 1) * row,
                             image.pixels.begin() + (image.height - 1 - y) * row);
        work.files["turned.png"] = image::encodePng(image);
        model.texture->file = "turned.png";
        return true;
    });
}

Result wrongTexture(Work& work) {
    const auto models = modelsOf(work.scene);
    for (const Placed& one : models)
        for (const Placed& other : models)
            if (one.model->texture && other.model->texture && !one.model->texture->path.empty() &&
                !other.model->texture->path.empty() &&
                one.model->texture->path != other.model->texture->path) {
                one.model->texture->file = other.model->texture->file;
                return written(work);
            }
    return {};
}

Result textureMissing(Work& work) {
    return changeModel(work, [](scene::Model& model) {
        const bool had = model.texture.has_value();
        model.texture.reset();
        return had;
    });
}

Result mipmapsOff(Work& work) {
    return changeModel(work, [](scene::Model& model) {
        if (!model.texture) return false;
        model.texture->filter = scene::Filter::nearest;
        return true;
    });
}

Result smallColors(Work& work) {
    return changeMaterial(work, [](scene::Material& material) {
        for (scene::Color* color : {&material.diffuse, &material.ambient, &material.specular})
            color->rgb /= 255.0F;
        return true;
    });
}

/// Of all materials: the first one's highlight may lie outside the picture.
Result noSpecular(Work& work) {
    bool had = false;
    changeMaterial(work, [&](scene::Material& material) {
        had = had || material.specular.rgb != glm::vec3(0.0F);
        material.specular.rgb = glm::vec3(0.0F);
        return false;
    });
    return had ? written(work) : Result();
}

Result shininess(Work& work) {
    return changeMaterial(work, [](scene::Material& material) {
        if (material.specular.rgb == glm::vec3(0.0F)) return false;
        material.shininess = material.shininess > 10.0F ? 2.0F : 90.0F;
        return true;
    });
}

Result wrongColor(Work& work) {
    return changeMaterial(work, [](scene::Material& material) {
        glm::vec3& rgb = material.diffuse.rgb;
        rgb = glm::vec3(rgb.z, rgb.x, 1.0F - rgb.y);
        return true;
    });
}

Result opacityMissing(Work& work) {
    return changeModel(work, [](scene::Model& model) {
        if (model.opacity == 1.0F) return false;
        model.opacity = 1.0F;
        return true;
    });
}

Result alphaLost(Work& work) {
    return changeModel(work, [&](scene::Model& model) {
        if (!model.texture || model.texture->path.empty()) return false;
        image::Image image =
            image::decodeImage(work.files.at(model.texture->path), model.texture->path);
        if (image::isOpaque(image)) return false;
        for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
        work.files["solid.png"] = image::encodePng(image);
        model.texture->file = "solid.png";
        return true;
    });
}

Result transparencyOff(Work& work) {
    const auto models = modelsOf(work.scene);
    if (std::none_of(models.begin(), models.end(),
                     [](const Placed& one) { return one.model->opacity < 1.0F; }))
        return {};
    work.scene.settings.transparency = scene::Transparency::off;
    return written(work);
}

Result cameraMoved(Work& work) {
    if (!work.scene.camera) return {};
    scene::Camera& camera = *work.scene.camera;
    camera.eye += 0.25 * (camera.target - camera.eye) + glm::dvec3(0.3, 0.2, 0.0);
    return written(work);
}

Result fieldOfView(Work& work) {
    if (!work.scene.camera) return {};
    work.scene.camera->fovDeg = std::min(120.0, work.scene.camera->fovDeg * 1.35);
    return written(work);
}

Result slicesAndStacks(Work& work) {
    return changeModel(work, [](scene::Model& model) {
        const std::string shape = shapeNameOf(model);
        if (model.autoLod || (shape != "sphere" && shape != "cone" && shape != "cylinder"))
            return false;
        scene::ShapeCall swapped = model.source.shape;
        const std::size_t stacks = swapped.arguments.size() - 1;
        if (!swapped.isWritten(stacks)) return false;
        std::swap(swapped.arguments[stacks], swapped.arguments[stacks - 1]);
        if (swapped == model.source.shape || swapped.count(stacks - 1) <= 2) return false;
        model.file.clear();
        model.command = generator::textOf(swapped);
        return true;
    });
}

Result childMissing(Work& work) {
    for (scene::Group* group : groupsOf(work.scene))
        for (std::size_t i = 0; i < group->groups.size(); ++i)
            if (!group->groups[i].models.empty()) {
                group->groups.erase(group->groups.begin() + static_cast<std::ptrdiff_t>(i));
                return written(work);
            }
    return {};
}

Result modelMissing(Work& work) {
    for (scene::Group* group : groupsOf(work.scene))
        if (group->models.size() > 1) {
            group->models.pop_back();
            return written(work);
        }
    return {};
}

}  // namespace

std::vector<Variant> mutants() {
    return {
        {"order of transforms", {"transform.order"}, order},
        {"sign of an angle", {"transform.angle-sign"}, angleSign},
        {"radians for degrees", {"transform.radians"}, radians},
        {"wrong axis", {"transform.axis"}, axis},
        {"sign of a translation", {"transform.sign"}, translateSign},
        {"another translation", {"transform.value"}, translateValue},
        {"scale left out", {"transform.missing"}, scaleMissing},
        {"light left out", {"light.missing"}, lightMissing},
        {"point for directional light", {"light.type"}, lightType},
        {"direction negated", {"light.direction-negated"}, lightNegated},
        {"light moved", {"light.position"}, lightMoved},
        {"spot cutoff", {"light.cutoff"}, spotCutoff},
        {"no normal matrix under a scale", {"model.normal-matrix"}, normalMatrix},
        {"flat for smooth", {"model.flat-normals"}, flat},
        {"normals inward", {"model.normals-inward"}, normalsInward},
        {"triangles clockwise", {"model.winding"}, winding},
        {"culling of what has two sides", {"model.culling"}, culling},
        {"V flipped", {"texture.upside-down"}, vFlipped},
        {"U mirrored", {"texture.mirrored"}, uMirrored},
        {"picture upside down", {"texture.upside-down"}, pictureUpsideDown},
        {"wrong texture", {"texture.wrong"}, wrongTexture},
        {"texture left out", {"texture.missing"}, textureMissing},
        {"mipmaps off", {"texture.filter"}, mipmapsOff},
        {"colours 0..1 for 0..255", {"material.scale"}, smallColors},
        {"specular left out", {"material.missing"}, noSpecular},
        {"wrong shininess", {"material.shininess"}, shininess},
        {"wrong colour", {"material.color"}, wrongColor},
        {"opacity left out", {"material.opacity"}, opacityMissing},
        {"alpha of a texture lost", {"texture.alpha"}, alphaLost},
        {"transparency off", {"transparency.mode"}, transparencyOff},
        {"camera moved", {"camera.position"}, cameraMoved},
        {"field of view", {"camera.fov"}, fieldOfView},
        {"slices and stacks swapped", {"model.swapped-arguments"}, slicesAndStacks},
        {"child group left out", {"group.missing"}, childMissing},
        {"model left out", {"model.missing"}, modelMissing},
    };
}

}  // namespace farol::test
