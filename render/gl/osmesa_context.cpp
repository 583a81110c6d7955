#include "render/gl/osmesa_context.h"
// osmesa.h brings the old gl.h, which must come after glcorearb.h.
#include <GL/osmesa.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <stdexcept>

namespace farol::render::gl {
namespace {

/// llvmpipe filters 8-bit textures in 8-bit arithmetic unless a variable says otherwise: 0.41 to
/// 0.53 levels rms against the exact filter instead of 0.32 to 0.40, for 6 to 12 % of a textured
/// frame (measured; docs/benchmarks/accuracy.md). It reads the variable once, when the first
/// context is made; what the environment says already stays.
void chooseExactFilters() {
    static std::once_flag once;
    std::call_once(once, [] { setenv("GALLIVM_PERF", "no_aos_sampling", 0); });
}

class OsMesaContext final : public Context {
  public:
    OsMesaContext() {
        chooseExactFilters();
        const std::array<int, 13> attributes{OSMESA_FORMAT,
                                             OSMESA_RGBA,
                                             OSMESA_DEPTH_BITS,
                                             0,
                                             OSMESA_PROFILE,
                                             OSMESA_CORE_PROFILE,
                                             OSMESA_CONTEXT_MAJOR_VERSION,
                                             4,
                                             OSMESA_CONTEXT_MINOR_VERSION,
                                             5,
                                             0,
                                             0,
                                             0};
        context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
        if (!context_) throw std::runtime_error("GL backend \"osmesa\" has no GL 4.5 core context");
        try {
            makeCurrent();
            api_ = loadApi(OSMesaGetProcAddress);
            facts_ = askFacts(api_);
        } catch (...) {
            OSMesaDestroyContext(context_);
            throw;
        }
        // Mesa reports GL's least of 4 bits; llvmpipe has 8 (its FIXED_ORDER).
        facts_.snapPx = 1.0 / 512.0;
    }
    ~OsMesaContext() override { OSMesaDestroyContext(context_); }
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;

    void makeCurrent() override {
        // All drawing goes to framebuffer objects: the window buffer is one pixel.
        if (!OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1))
            throw std::runtime_error("OSMesa cannot make its context current");
    }
    const Api& api() const override { return api_; }
    const GlFacts& facts() const override { return facts_; }

  private:
    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4> pixel_{};
    Api api_;
    GlFacts facts_;
};

}  // namespace

std::unique_ptr<Context> createOsMesaContext() { return std::make_unique<OsMesaContext>(); }

}  // namespace farol::render::gl
