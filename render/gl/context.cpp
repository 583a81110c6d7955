#include "render/gl/context.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "render/gl/egl_context.h"
#include "render/gl/library.h"
#include "render/gl/llvmpipe.h"
#include "render/gl/objects.h"
#include "render/gl/osmesa_context.h"

namespace farol::render::gl {
namespace {

// Of ARB_texture_filter_anisotropic, core since 4.6; the value is the extension's too.
constexpr GLenum kMaxAnisotropy = 0x84FF;

std::string stringOf(const Api& api, GLenum name) {
    const GLubyte* value = api.GetString(name);
    return value ? reinterpret_cast<const char*>(value) : "?";
}

int integerOf(const Api& api, GLenum name) {
    GLint value = 0;
    api.GetIntegerv(name, &value);
    return value;
}

bool hasExtension(const Api& api, std::string_view name) {
    const int count = integerOf(api, GL_NUM_EXTENSIONS);
    for (int i = 0; i < count; ++i) {
        const GLubyte* text = api.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (text && name == reinterpret_cast<const char*>(text)) return true;
    }
    return false;
}

/// The pattern of a target that is asked for with `samples`; the GL may give it more.
SamplePattern patternOf(const Api& api, int samples) {
    const Framebuffer frame(api);
    const Texture color(api);
    api.BindFramebuffer(GL_FRAMEBUFFER, frame.name());
    api.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, color.name());
    api.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, GL_RGBA8, 1, 1, GL_TRUE);
    api.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                             color.name(), 0);
    SamplePattern pattern;
    const int count = integerOf(api, GL_SAMPLES);
    for (int i = 0; i < count; ++i) {
        std::array<GLfloat, 2> at{};
        api.GetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), at.data());
        pattern.emplace_back(at[0], at[1]);
    }
    return pattern;
}

}  // namespace

GlFacts askFacts(const Api& api) {
    clearErrors(api);
    GlFacts facts;
    facts.renderer = stringOf(api, GL_RENDERER);
    facts.version = stringOf(api, GL_VERSION);
    const int most = integerOf(api, GL_MAX_SAMPLES);
    constexpr std::array<int, 4> kCounts{2, 4, 8, 16};  // of images
    for (const int count : kCounts) {
        if (count > most) break;
        SamplePattern pattern = patternOf(api, count);
        const std::size_t known =
            facts.samplePatterns.empty() ? 1 : facts.samplePatterns.back().size();
        if (pattern.size() > known) facts.samplePatterns.push_back(std::move(pattern));
    }
    api.BindFramebuffer(GL_FRAMEBUFFER, 0);
    api.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
    facts.snapPx = 0.5 / std::exp2(std::clamp(integerOf(api, GL_SUBPIXEL_BITS), 4, 16));
    std::array<GLint, 2> viewport{};
    api.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    facts.maxTargetSide =
        std::min({viewport[0], viewport[1], integerOf(api, GL_MAX_RENDERBUFFER_SIZE)});
    facts.maxTextureSide = std::max(1, integerOf(api, GL_MAX_TEXTURE_SIZE));
    facts.maxFaceSide = std::max(1, integerOf(api, GL_MAX_CUBE_MAP_TEXTURE_SIZE));
    facts.vertexComponents = integerOf(api, GL_MAX_VERTEX_OUTPUT_COMPONENTS);
    facts.readsUniformsByPixel = facts.renderer.starts_with("llvmpipe");
    facts.packInvert = hasExtension(api, "GL_MESA_pack_invert");
    throwOnError(api, "asking for its limits");
    GLfloat anisotropy = 1.0F;
    api.GetFloatv(kMaxAnisotropy, &anisotropy);
    if (api.GetError() == GL_NO_ERROR) facts.maxAnisotropy = std::max(1.0F, anisotropy);
    return facts;
}

std::unique_ptr<Context> createContext(GlSource source) {
    setMesaVariables(source);
    switch (resolveSource(source)) {
        case GlSource::osmesa:
            return createOsMesaContext();
        case GlSource::egl:
            return createEglContext(false);
        case GlSource::eglGpu:
            return createEglContext(true);
        case GlSource::automatic:
            break;
    }
    throw std::logic_error("no such GL source");
}

}  // namespace farol::render::gl
