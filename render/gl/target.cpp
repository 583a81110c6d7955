#include "render/gl/target.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <new>

namespace farol::render::gl {
namespace {

constexpr GLenum kPackInvert = 0x8758;  // GL_MESA_pack_invert

/// Texels that are fetched one by one, of one level.
Texture storage(const Api& api, GLenum format, int width, int height, int samples) {
    Texture texture(api);
    const GLenum kind = samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    api.BindTexture(kind, texture.name());
    if (samples > 1) {
        api.TexImage2DMultisample(kind, samples, format, width, height, GL_TRUE);
        return texture;
    }
    api.TexStorage2D(kind, 1, format, width, height);
    api.TexParameteri(kind, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    api.TexParameteri(kind, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

void check(const Api& api) {
    if (api.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    // Every GL 3.0 supports these formats, and sizes are bounded before: the cause is memory.
    throw std::bad_alloc();
}

}  // namespace

Target::Target(const Api& api, const Format& format, bool packInvert)
    : api_(api), format_(format), packInvert_(packInvert), drawn_(api) {
    const auto [width, height, samples, isFloat, part] = format;
    const glm::ivec2 drawn = part.x > 0 ? part : glm::ivec2(width, height);
    color_ = storage(api, isFloat ? GL_RGBA16F : GL_RGBA8, drawn.x, drawn.y, samples);
    depth_ = storage(api, GL_DEPTH_COMPONENT32F, drawn.x, drawn.y, samples);
    const auto attach = [&](GLenum point, const Texture& texture, GLenum kind) {
        api.FramebufferTexture2D(GL_FRAMEBUFFER, point, kind, texture.name(), 0);
    };
    api.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    attach(GL_COLOR_ATTACHMENT0, color_, textureKind());
    attach(GL_DEPTH_ATTACHMENT, depth_, textureKind());
    check(api);
    if (samples <= 1 || isFloat) return;  // those are not read
    resolvedColor_ = storage(api, GL_RGBA8, width, height, 1);
    resolved_ = Framebuffer(api);
    api.BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    attach(GL_COLOR_ATTACHMENT0, resolvedColor_, GL_TEXTURE_2D);
    check(api);
}

bool Target::suits(const Format& format) const {
    Format same = format;
    same.drawn = format_.drawn;
    if (same != format_) return false;
    const glm::ivec2 whole(format.width, format.height);
    const glm::ivec2 has = format_.drawn.x > 0 ? format_.drawn : whole;
    const glm::ivec2 needs = format.drawn.x > 0 ? format.drawn : whole;
    constexpr std::int64_t kMostSpare = 4;  // a new target costs its pages
    return has.x >= needs.x && has.y >= needs.y &&
           std::int64_t{has.x} * has.y <= kMostSpare * needs.x * needs.y;
}

GLenum Target::textureKind() const {
    return format_.samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
}

void Target::bind(const glm::ivec4& viewport) const {
    api_.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    api_.Viewport(viewport.x, viewport.y, viewport.z, viewport.w);
}

void Target::resolve(const Resolver& resolver, const std::vector<glm::ivec4>& parts,
                     const glm::vec4& clearColor) const {
    if (format_.samples <= 1) return;
    api_.BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    api_.UseProgram(resolver.program);
    api_.BindVertexArray(resolver.emptyArray);
    api_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, color_.name());
    if (parts.empty()) return api_.DrawArrays(GL_TRIANGLES, 0, 3);
    api_.ClearBufferfv(GL_COLOR, 0, glm::value_ptr(clearColor));
    api_.Enable(GL_SCISSOR_TEST);
    for (const glm::ivec4& part : parts) {
        api_.Scissor(part.x, part.y, part.z, part.w);
        api_.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    api_.Disable(GL_SCISSOR_TEST);
}

void Target::read(int first, int rows, std::uint8_t* pixels) const {
    const std::size_t row = static_cast<std::size_t>(format_.width) * 4;
    const auto count = static_cast<std::size_t>(rows);
    api_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    if (packInvert_) api_.PixelStorei(kPackInvert, GL_TRUE);  // top row first
    api_.ReadPixels(0, first, format_.width, rows, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    if (packInvert_) return;
    for (std::size_t i = 0; i < count / 2; ++i)
        std::swap_ranges(pixels + i * row, pixels + (i + 1) * row, pixels + (count - 1 - i) * row);
}

}  // namespace farol::render::gl
