#include "render/gl/target.h"

#include <algorithm>
#include <new>

namespace farol::render::gl {
namespace {

constexpr GLenum kPackInvert = 0x8758;  // GL_MESA_pack_invert

Renderbuffer storage(const Api& api, GLenum kind, int width, int height, int samples) {
    Renderbuffer buffer(api);
    api.BindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    api.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, kind, width,
                                       height);
    return buffer;
}

void attach(const Api& api, GLenum point, const Renderbuffer& buffer) {
    api.FramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffer.name());
}

void check(const Api& api) {
    if (api.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    // Every GL 3.0 supports these formats, and sizes are bounded before: the cause is memory.
    throw std::bad_alloc();
}

}  // namespace

Target::Target(const Api& api, const Format& format, bool packInvert)
    : api_(api), format_(format), packInvert_(packInvert), drawn_(api) {
    const auto [width, height, samples] = format;
    color_ = storage(api, GL_RGBA8, width, height, 1);
    depth_ = storage(api, GL_DEPTH_COMPONENT32F, width, height, samples);
    api.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    attach(api, GL_DEPTH_ATTACHMENT, depth_);
    if (samples > 1) {
        samplesOf_ = Texture(api);
        api.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, samplesOf_.name());
        api.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, GL_RGBA8, width, height,
                                  GL_TRUE);
        api.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                                 samplesOf_.name(), 0);
        check(api);
        resolved_ = Framebuffer(api);
        api.BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    }
    attach(api, GL_COLOR_ATTACHMENT0, color_);
    check(api);
}

void Target::bind(const glm::ivec4& viewport) const {
    api_.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    api_.Viewport(viewport.x, viewport.y, viewport.z, viewport.w);
}

void Target::resolve(const Resolver& resolver) const {
    if (format_.samples <= 1) return;
    api_.BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    api_.UseProgram(resolver.program);
    api_.BindVertexArray(resolver.emptyArray);
    api_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, samplesOf_.name());
    api_.DrawArrays(GL_TRIANGLES, 0, 3);
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
