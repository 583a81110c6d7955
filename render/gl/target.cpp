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
    // Every GL 3.0 takes these formats, and sizes are bounded before: what is wanting is memory.
    throw std::bad_alloc();
}

}  // namespace

Target::Target(const Api& api, const Format& format, bool packInvert)
    : api_(api), format_(format), packInvert_(packInvert), drawn_(api) {
    const auto [width, height, samples, wide] = format;
    const GLenum channels = wide ? GL_RGBA16 : GL_RGBA8;
    color_ = storage(api, channels, width, height, 1);
    depth_ = storage(api, GL_DEPTH_COMPONENT32F, width, height, samples);
    api.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    attach(api, GL_DEPTH_ATTACHMENT, depth_);
    if (samples > 1) {
        samplesOf_ = Texture(api);
        api.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, samplesOf_.name());
        api.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, channels, width, height,
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

void Target::bind() const {
    api_.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    api_.Viewport(0, 0, format_.width, format_.height);
}

void Target::resolve(const Resolver& resolver) const {
    if (format_.samples <= 1) return;
    api_.BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    api_.UseProgram(resolver.program);
    api_.BindVertexArray(resolver.emptyArray);
    api_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, samplesOf_.name());
    api_.DrawArrays(GL_TRIANGLES, 0, 3);
}

template <typename Channel>
void Target::readAs(const Resolver& resolver, GLenum type, std::vector<Channel>& pixels) const {
    const std::size_t row = static_cast<std::size_t>(format_.width) * 4;
    const auto rows = static_cast<std::size_t>(format_.height);
    pixels.resize(row * rows);
    resolve(resolver);
    api_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    if (packInvert_) api_.PixelStorei(kPackInvert, GL_TRUE);  // top row first
    api_.ReadPixels(0, 0, format_.width, format_.height, GL_RGBA, type, pixels.data());
    if (packInvert_) return;
    Channel* const first = pixels.data();
    for (std::size_t i = 0; i < rows / 2; ++i)
        std::swap_ranges(first + i * row, first + (i + 1) * row, first + (rows - 1 - i) * row);
}

void Target::read(const Resolver& resolver, image::Image& image) const {
    image.width = format_.width;
    image.height = format_.height;
    readAs(resolver, GL_UNSIGNED_BYTE, image.pixels);
}

void Target::read(const Resolver& resolver, std::vector<std::uint16_t>& pixels) const {
    readAs(resolver, GL_UNSIGNED_SHORT, pixels);
}

}  // namespace farol::render::gl
