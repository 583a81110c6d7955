#include "render/plan/texture_ref.h"

namespace farol::render {

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

}  // namespace farol::render
