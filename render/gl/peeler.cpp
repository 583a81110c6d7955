#include "render/gl/peeler.h"

namespace farol::render::gl {
namespace {

constexpr std::array<float, 4> kNothing{};
constexpr float kFarthest = 0.0F, kNearest = 1.0F;  // reversed depth

/// In 8 bits each of many layers would be rounded.
Target::Format finer(Target::Format format) {
    format.isFloat = true;
    return format;
}

}  // namespace

Peeler::Peeler(const Api& api, const Target::Format& of, bool packInvert)
    : api_(api),
      layers_{Target(api, finer(of), packInvert), Target(api, finer(of), packInvert)},
      sum_(api, finer(of), packInvert),
      any_(api) {}

void Peeler::begin(const glm::ivec4& viewport) const {
    sum_.bind(viewport);
    api_.ClearBufferfv(GL_COLOR, 0, kNothing.data());
    // Before the first layer all is open.
    layer(1).bind(viewport);
    api_.ClearBufferfv(GL_DEPTH, 0, &kNearest);
}

void Peeler::beginLayer(int index, const Target& opaque, const glm::ivec4& viewport) const {
    const GLenum kind = opaque.textureKind();
    api_.ActiveTexture(GL_TEXTURE0 + kOpaqueDepthUnit);
    api_.BindTexture(kind, opaque.depth());
    api_.ActiveTexture(GL_TEXTURE0 + kLayerDepthUnit);
    api_.BindTexture(kind, layer(index + 1).depth());
    api_.ActiveTexture(GL_TEXTURE0 + kPictureUnit);
    layer(index).bind(viewport);
    api_.ClearBufferfv(GL_COLOR, 0, kNothing.data());
    api_.ClearBufferfv(GL_DEPTH, 0, &kFarthest);
    api_.BeginQuery(GL_ANY_SAMPLES_PASSED, any_.name());
}

bool Peeler::endLayer() const {
    api_.EndQuery(GL_ANY_SAMPLES_PASSED);
    GLuint any = GL_FALSE;
    api_.GetQueryObjectuiv(any_.name(), GL_QUERY_RESULT, &any);
    return any != GL_FALSE;
}

}  // namespace farol::render::gl
