#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "tests/support/ray_caster/shading.h"
#include "tests/support/ray_caster/shape.h"
#include "tests/support/ray_caster/texture.h"

namespace farol::reference {

/// The files of a scene, by the names that it uses.
struct Files {
    std::map<std::string, Pixels> pictures;    ///< textures, decoded
    std::map<std::string, std::string> texts;  ///< patch files and ascii profiles
};

/// The settings of the image, which override those of the scene.
struct Options {
    int width = 300, height = 300;  ///< px, at least 1
    double timeS = 0.0;
    scene::Viewer viewer = scene::Viewer::infinite;
    scene::Specular specular = scene::Specular::single;
    std::optional<scene::Filter> filter;  ///< unset: the texture's own, else mipmap
    bool transparency = true;             ///< false: all is opaque
    bool shadows = false;                 ///< hard ones, of what is not blended
    glm::dvec3 background{0.0};
    int threads = 2;
};

/// A model in its place.
struct Instance {
    std::shared_ptr<const Shape> shape;
    int id = 0;  ///< from 1, in document order, a group's models before its groups
    glm::dmat3 viewFromObject{1.0}, objectFromView{1.0};  ///< without translation
    glm::dvec3 originView{0.0};                           ///< the object's origin in eye space
    bool twoSided = false, unlit = false;
    bool isSheet = false;  ///< stops light that meets either side
    Dress dress;
    std::vector<EyeLight> lights;
    std::shared_ptr<const Texture> texture;  ///< null: none
    scene::Texture mapping;
    scene::Filter filter = scene::Filter::mipmap;
    double opacity = 1.0;
    Texture::Kind kind = Texture::Kind::opaque;  ///< of its texture's alpha and its opacity
    glm::dvec2 pixelMin{0.0}, pixelMax{0.0};     ///< covers its picture, px
};

/// A scene made ready to be seen: everything relative to the eye.
struct World {
    int width = 0, height = 0;
    double tanHalf = 0.0;          ///< of the vertical field of view
    double near = 0.0, far = 0.0;  ///< eye depths
    glm::dvec3 background{0.0};
    Rules rules;
    bool shadows = false;
    double reach = 0.0;  ///< of all bounds, from the eye
    std::vector<Instance> instances;

    /// The ray through a place of the picture, px from the top left; t is the eye's depth.
    glm::dvec3 direction(double x, double y) const;
};

/// Throws std::invalid_argument for what the reference does not cover: a scene without a camera,
/// shapes of files, flattened objects, skyboxes, entities, a scene shown as wireframe, textures
/// that were not given.
World makeWorld(const scene::Scene& scene, const Files& files, const Options& options);

}  // namespace farol::reference
