#include "render/gl/osmesa_context.h"

#include <array>
#include <stdexcept>

#include "render/gl/library.h"
#include "render/gl/llvmpipe.h"

namespace farol::render::gl {
namespace {

// The interface of libOSMesa 8 (Mesa 11.2 to 25.0); its header left Mesa with it.
constexpr int kFormat = 0x22, kDepthBits = 0x30, kProfile = 0x33, kCoreProfile = 0x34,
              kMajorVersion = 0x36, kMinorVersion = 0x37;
using OsMesa = struct osmesa_context*;
using CreateContextAttribs = OsMesa(const int* attributes, OsMesa shared);
using DestroyContext = void(OsMesa context);
using MakeCurrent = GLboolean(OsMesa context, void* pixels, GLenum type, GLsizei width,
                              GLsizei height);

class OsMesaContext final : public Context {
  public:
    OsMesaContext()
        : library_(kOsMesaLibrary),
          makeCurrent_(library_.function<MakeCurrent>("OSMesaMakeCurrent")),
          destroy_(library_.function<DestroyContext>("OSMesaDestroyContext")) {
        const std::array<int, 11> attributes{
            kFormat,       GL_RGBA, kDepthBits,    0, kProfile, kCoreProfile,
            kMajorVersion, 4,       kMinorVersion, 5, 0};
        context_ = library_.function<CreateContextAttribs>("OSMesaCreateContextAttribs")(
            attributes.data(), nullptr);
        if (!context_) throw std::runtime_error("GL source \"osmesa\" has no GL 4.5 core context");
        try {
            makeCurrent();
            api_ = loadApi(library_.function<GetProcAddress>("OSMesaGetProcAddress"));
            facts_ = askFacts(api_);
        } catch (...) {
            destroy_(context_);
            throw;
        }
        facts_.snapPx = kLlvmpipeSnapPx;
    }
    ~OsMesaContext() override { destroy_(context_); }
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;

    void makeCurrent() override {
        // All drawing goes to framebuffer objects: the window buffer is one pixel.
        if (!makeCurrent_(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1))
            throw std::runtime_error("OSMesa cannot make its context current");
    }
    const Api& api() const override { return api_; }
    const GlFacts& facts() const override { return facts_; }

  private:
    Library library_;
    MakeCurrent* makeCurrent_;
    DestroyContext* destroy_;
    OsMesa context_ = nullptr;
    std::array<unsigned char, 4> pixel_{};
    Api api_;
    GlFacts facts_;
};

}  // namespace

std::unique_ptr<Context> createOsMesaContext() { return std::make_unique<OsMesaContext>(); }

}  // namespace farol::render::gl
