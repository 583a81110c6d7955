#include "render/plan/texture_ref.h"

#include <cmath>

namespace farol::render {
namespace {

double lessTurns(double offset, bool clamp) {
    constexpr double kFarTurns = 32.0;
    return clamp || !(std::abs(offset) > kFarTurns) ? offset : offset - std::floor(offset);
}

}  // namespace

TextureRef refOf(const std::string& path, const scene::Assets& assets) {
    TextureRef ref;
    ref.path = path;
    ref.key = path + '\n' + assets.version(path);
    return ref;
}

TextureRef refOf(const scene::Texture& texture, const scene::Assets& assets) {
    TextureRef ref;
    if (texture.chess) {
        const scene::Chess& chess = *texture.chess;
        ref.chess = chess;
        ref.key = "chess " + std::to_string(chess.columns) + ' ' + std::to_string(chess.rows);
        for (const glm::vec3& color : {chess.first, chess.second})
            for (int i = 0; i < 3; ++i) ref.key += ' ' + std::to_string(color[i]);
    } else {
        ref = refOf(texture.path, assets);
    }
    ref.filter = texture.filter.value_or(scene::Filter::mipmap);
    ref.clamp = texture.clamp;
    ref.where = texture.where;
    return ref;
}

glm::vec4 texgenPlane(glm::dvec4 plane, const glm::dvec3& origin, bool clamp) {
    plane.w = lessTurns(plane.w + glm::dot(glm::dvec3(plane), origin), clamp);
    return glm::vec4(plane);
}

glm::vec4 uvPlacement(const scene::Texture& texture, const glm::dvec2& uvOrigin) {
    const glm::dvec2 offset = texture.offset + texture.scale * uvOrigin;
    return glm::vec4(texture.scale, lessTurns(offset.x, texture.clamp),
                     lessTurns(offset.y, texture.clamp));
}

}  // namespace farol::render
