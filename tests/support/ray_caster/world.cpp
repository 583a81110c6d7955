#include "tests/support/ray_caster/world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene/animation.h"

namespace farol::reference {
namespace {

/// Rows right, up, backward.
glm::dmat3 eyeAxes(const scene::Camera& camera) {
    const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
    const glm::dvec3 right = glm::cross(camera.up, back);
    if (!(glm::length(right) > 1e-9 * glm::length(camera.up)))
        throw std::invalid_argument("the reference wants an up that is not along the view");
    const glm::dvec3 unit = glm::normalize(right);
    return glm::transpose(glm::dmat3(unit, glm::cross(back, unit), back));
}

bool anyLights(const std::vector<scene::Group>& groups) {
    return std::any_of(groups.begin(), groups.end(), [](const scene::Group& group) {
        return !group.lights.empty() || anyLights(group.groups);
    });
}

bool anyDressed(const std::vector<scene::Group>& groups) {
    return std::any_of(groups.begin(), groups.end(), [](const scene::Group& group) {
        return anyDressed(group.groups) ||
               std::any_of(group.models.begin(), group.models.end(), [](const auto& model) {
                   return model.material.has_value() || model.texture.has_value();
               });
    });
}

class Maker {
  public:
    Maker(const scene::Scene& scene, const Files& files, const Options& options)
        : scene_(scene), files_(files), options_(options) {}

    World run() {
        if (!scene_.camera) throw std::invalid_argument("the reference wants a camera");
        if (scene_.skybox || scene_.entity)
            throw std::invalid_argument("the reference has no skybox and no entity");
        lit_ = !scene_.lights.empty() || anyLights(scene_.groups);
        if (!lit_ && !anyDressed(scene_.groups))
            throw std::invalid_argument("the reference has no wireframe");
        const scene::Camera& camera = *scene_.camera;
        axes_ = eyeAxes(camera);
        world_.width = options_.width;
        world_.height = options_.height;
        world_.tanHalf = std::tan(glm::radians(camera.fovDeg) / 2.0);
        world_.near = camera.near;
        world_.far = camera.far;
        world_.background = options_.background;
        world_.shadows = options_.shadows;
        world_.rules = {glm::dvec3(scene_.globalAmbient), options_.viewer, options_.specular};
        std::vector<EyeLight> lights;
        for (const scene::Light& light : scene_.lights)
            lights.push_back(place(light, glm::dmat4(1.0)));
        for (const scene::Group& group : scene_.groups) visit(group, glm::dmat4(1.0), lights);
        return std::move(world_);
    }

  private:
    glm::dvec3 toEye(const glm::dvec3& pointWorld) const {
        return axes_ * (pointWorld - scene_.camera->eye);
    }

    EyeLight place(const scene::Light& light, const glm::dmat4& worldFromGroup) const {
        EyeLight eye;
        glm::dvec3 position = light.position, direction = light.direction;
        if (light.space == scene::LightSpace::world) {
            position = toEye(glm::dvec3(worldFromGroup * glm::dvec4(position, 1.0)));
            direction = axes_ * (glm::dmat3(worldFromGroup) * direction);
        }
        const double length = glm::length(direction);
        if (length > 0.0) direction /= length;
        eye.positional = light.type != scene::LightType::directional;
        eye.position = position;
        eye.towards = direction;
        if (light.type == scene::LightType::spot) {
            eye.shining = direction;
            eye.cutoffDeg = light.cutoffDeg;
            eye.exponent = light.exponent;
        }
        if (eye.positional) eye.attenuation = {light.constant, light.linear, light.quadratic};
        eye.diffuse = glm::dvec3(scene::colorAt(light.diffuse, options_.timeS));
        eye.ambient = glm::dvec3(scene::colorAt(light.ambient, options_.timeS));
        eye.specular = glm::dvec3(scene::colorAt(light.specular, options_.timeS));
        return eye;
    }

    void visit(const scene::Group& group, const glm::dmat4& worldFromParent,
               const std::vector<EyeLight>& inherited) {
        const glm::dmat4 worldFromGroup =
            worldFromParent * scene::matrixAt(group.transforms, options_.timeS);
        if (!group.scatter) return fill(group, worldFromGroup, inherited);
        for (const glm::dmat4& copy : scene::scatterMatrices(*group.scatter, group.scatter->seed))
            fill(group, worldFromGroup * copy, inherited);
    }

    void fill(const scene::Group& group, const glm::dmat4& worldFromGroup,
              std::vector<EyeLight> lights) {
        for (const scene::Light& light : group.lights)
            lights.push_back(place(light, worldFromGroup));
        for (const scene::Model& model : group.models) add(model, worldFromGroup, lights);
        for (const scene::Group& child : group.groups) visit(child, worldFromGroup, lights);
    }

    void add(const scene::Model& model, const glm::dmat4& worldFromObject,
             const std::vector<EyeLight>& lights) {
        Instance one;
        const std::vector<std::string> words = wordsOf(model);
        one.shape = makeShape(words, model.uv, files_.texts);
        one.id = ++count_;
        one.viewFromObject = axes_ * glm::dmat3(worldFromObject);
        one.objectFromView = glm::inverse(one.viewFromObject);
        for (int i = 0; i < 3; ++i)
            if (!(glm::length(one.objectFromView[i]) < 1e30))
                throw std::invalid_argument("the reference has no flattened objects");
        one.originView = toEye(glm::dvec3(worldFromObject[3]));
        // The planes of the 2017 dialect have a second face.
        one.twoSided =
            model.twoSided || (scene_.dialect == scene::Dialect::engine2017 && words[0] == "plane");
        one.lights = lights;
        one.unlit = !lit_;
        const scene::Material material =
            model.material.value_or(scene::defaultMaterial(scene_.dialect));
        const auto color = [&](const scene::Color& c) {
            return glm::dvec3(scene::colorAt(c, options_.timeS));
        };
        one.dress = {color(material.diffuse), color(material.ambient), color(material.specular),
                     color(material.emissive), material.shininess};
        if (model.texture) dress(one, *model.texture);
        if (options_.transparency) {
            one.opacity = static_cast<double>(material.opacity) * double{model.opacity};
            if (one.texture) one.kind = one.texture->kind();
            if (one.opacity < 1.0) one.kind = Texture::Kind::blended;
        }
        // See-through bodies show their insides; sheets stay as they are.
        const Bounds box = one.shape->bounds();
        const glm::dvec3 size = box.max - box.min;
        one.isSheet = model.twoSided || std::min({size.x, size.y, size.z}) <= 1e-6;
        if (one.kind != Texture::Kind::opaque)
            one.twoSided |= std::min({size.x, size.y, size.z}) > 1e-6;
        frame(one);
        world_.reach =
            std::max(world_.reach, glm::length(one.originView) +
                                       std::max(glm::length(one.viewFromObject * box.min),
                                                glm::length(one.viewFromObject * box.max)) *
                                           2.0);
        world_.instances.push_back(std::move(one));
    }

    void dress(Instance& one, const scene::Texture& texture) {
        if (texture.chess) throw std::invalid_argument("the reference has no chess textures");
        one.mapping = texture;
        one.filter = options_.filter.value_or(texture.filter.value_or(scene::Filter::mipmap));
        const auto found = files_.pictures.find(texture.file);
        if (found == files_.pictures.end())
            throw std::invalid_argument("the texture " + texture.file + " was not given");
        std::shared_ptr<const Texture>& shared = textures_[texture.file];
        if (!shared) {
            Pixels pixels = found->second;
            if (!options_.transparency) pixels.alpha.clear();
            shared = std::make_shared<Texture>(pixels);
        }
        one.texture = shared;
        if (one.unlit) one.dress.diffuse = glm::dvec3(1.0);  // it is its texture alone
    }

    /// The rectangle of the picture that its bounds cover; all of it when they reach the eye.
    void frame(Instance& one) const {
        const Bounds box = one.shape->bounds();
        one.pixelMin = glm::dvec2(1e300);
        one.pixelMax = glm::dvec2(-1e300);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p =
                one.originView +
                one.viewFromObject * glm::dvec3(corner & 1 ? box.max.x : box.min.x,
                                                corner & 2 ? box.max.y : box.min.y,
                                                corner & 4 ? box.max.z : box.min.z);
            if (!(-p.z > 1e-6 * glm::length(p))) {
                one.pixelMin = glm::dvec2(-1e300);
                one.pixelMax = glm::dvec2(1e300);
                return;
            }
            const double scale = world_.height / (2.0 * world_.tanHalf * -p.z);
            const glm::dvec2 at =
                0.5 * glm::dvec2(world_.width, world_.height) + scale * glm::dvec2(p.x, -p.y);
            one.pixelMin = glm::min(one.pixelMin, at - 1e-3);  // room for rounding
            one.pixelMax = glm::max(one.pixelMax, at + 1e-3);
        }
    }

    const scene::Scene& scene_;
    const Files& files_;
    const Options& options_;
    World world_;
    glm::dmat3 axes_{1.0};
    bool lit_ = false;
    int count_ = 0;
    std::map<std::string, std::shared_ptr<const Texture>> textures_;
};

}  // namespace

glm::dvec3 World::direction(double x, double y) const {
    const double scale = 2.0 * tanHalf / height;
    return {scale * (x - 0.5 * width), scale * (0.5 * height - y), -1.0};
}

World makeWorld(const scene::Scene& scene, const Files& files, const Options& options) {
    return Maker(scene, files, options).run();
}

}  // namespace farol::reference
