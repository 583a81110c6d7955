#include "render/gl/target.h"

#include <new>

namespace farol::render::gl {
namespace {

constexpr GLenum kPackInvert = 0x8758;  // GL_MESA_pack_invert

Renderbuffer storage(const Api& api, GLenum format, int width, int height, int samples) {
    Renderbuffer buffer(api);
    api.BindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    api.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width,
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

Target::Target(const Api& api, int width, int height, int samples, Channels channels)
    : api_(api),
      width_(width),
      height_(height),
      samples_(samples),
      channels_(channels),
      drawn_(api) {
    const GLenum format = channels == Channels::bits16 ? GL_RGBA16 : GL_RGBA8;
    color_ = storage(api, format, width, height, 1);
    depth_ = storage(api, GL_DEPTH_COMPONENT32F, width, height, samples);
    api.BindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    attach(api, GL_DEPTH_ATTACHMENT, depth_);
    if (samples > 1) {
        samplesOf_ = Texture(api);
        api.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, samplesOf_.name());
        api.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, format, width, height,
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
    api_.Viewport(0, 0, width_, height_);
}

void Target::resolve(const Resolver& resolver) const {
    if (samples_ <= 1) return;
    api_.BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    api_.UseProgram(resolver.program);
    api_.BindVertexArray(resolver.emptyArray);
    api_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, samplesOf_.name());
    api_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void Target::readAs(const Resolver& resolver, GLenum type, void* pixels) const {
    resolve(resolver);
    api_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    api_.PixelStorei(kPackInvert, GL_TRUE);  // top row first
    api_.ReadPixels(0, 0, width_, height_, GL_RGBA, type, pixels);
}

void Target::read(const Resolver& resolver, Image& image) const {
    image.width = width_;
    image.height = height_;
    image.pixels.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 4);
    readAs(resolver, GL_UNSIGNED_BYTE, image.pixels.data());
}

void Target::read(const Resolver& resolver, std::vector<std::uint16_t>& pixels) const {
    pixels.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 4);
    readAs(resolver, GL_UNSIGNED_SHORT, pixels.data());
}

}  // namespace farol::render::gl
