#include "render/gl/egl_context.h"
// The macro keeps the headers of window systems out.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "render/gl/library.h"
#include "render/gl/llvmpipe.h"

namespace farol::render::gl {
namespace {

constexpr const char* kSoftware = "EGL_MESA_device_software";

/// The functions of EGL 1.5 that are used, and those of its extensions.
class Egl {
  public:
    PFNEGLGETPLATFORMDISPLAYPROC getPlatformDisplay = nullptr;
    PFNEGLINITIALIZEPROC initialize = nullptr;
    PFNEGLBINDAPIPROC bindApi = nullptr;
    PFNEGLCREATECONTEXTPROC createContext = nullptr;
    PFNEGLDESTROYCONTEXTPROC destroyContext = nullptr;
    PFNEGLMAKECURRENTPROC makeCurrent = nullptr;
    PFNEGLGETCURRENTCONTEXTPROC getCurrentContext = nullptr;
    PFNEGLGETPROCADDRESSPROC getProcAddress = nullptr;

    Egl() : library_(kEglLibrary) {
        load(getPlatformDisplay, "eglGetPlatformDisplay");
        load(initialize, "eglInitialize");
        load(bindApi, "eglBindAPI");
        load(createContext, "eglCreateContext");
        load(destroyContext, "eglDestroyContext");
        load(makeCurrent, "eglMakeCurrent");
        load(getCurrentContext, "eglGetCurrentContext");
        load(getProcAddress, "eglGetProcAddress");
    }

    /// Null where the extension is absent.
    template <typename Function>
    Function extension(const char* name) const {
        return reinterpret_cast<Function>(getProcAddress(name));
    }

  private:
    template <typename Function>
    void load(Function*& to, const char* name) {
        to = library_.function<Function>(name);
    }

    Library library_;
};

bool initialized(const Egl& egl, EGLDisplay display) {
    return display != EGL_NO_DISPLAY && egl.initialize(display, nullptr, nullptr) == EGL_TRUE;
}

/// A device of the machine, by EGL_EXT_device_enumeration; a GPU where `onGpu`.
EGLDisplay deviceDisplay(const Egl& egl, bool onGpu) {
    const auto queryDevices = egl.extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto queryString =
        egl.extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (queryDevices == nullptr || queryString == nullptr) return EGL_NO_DISPLAY;
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE)
        return EGL_NO_DISPLAY;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const char* const extensions = queryString(devices[i], EGL_EXTENSIONS);
        const bool isSoftware =
            extensions != nullptr &&
            std::string_view(extensions).find(kSoftware) != std::string_view::npos;
        if (isSoftware == onGpu) continue;
        const EGLDisplay display =
            egl.getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
        if (initialized(egl, display)) return display;
    }
    return EGL_NO_DISPLAY;
}

EGLDisplay openDisplay(const Egl& egl, bool onGpu) {
    if (!onGpu) {
        const EGLDisplay display =
            egl.getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (initialized(egl, display)) return display;
    }
    const EGLDisplay display = deviceDisplay(egl, onGpu);
    if (display == EGL_NO_DISPLAY)
        throw std::runtime_error(onGpu ? "GL source \"egl:gpu\": EGL finds no GPU; use \"auto\""
                                       : "GL source \"egl\": EGL has no display without a window; "
                                         "install libgl1-mesa-dri, or libosmesa6 instead of EGL");
    return display;
}

class EglContext final : public Context {
  public:
    explicit EglContext(bool onGpu) {
        // Never terminated: other contexts of the process share it.
        display_ = openDisplay(egl_, onGpu);
        const std::string name = onGpu ? "egl:gpu" : "egl";
        if (egl_.bindApi(EGL_OPENGL_API) != EGL_TRUE)
            throw std::runtime_error("GL source \"" + name + "\" has no desktop OpenGL");
        const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               4,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               5,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_NONE};
        // All drawing goes to framebuffer objects: no configuration of a surface is needed.
        context_ =
            egl_.createContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        if (context_ == EGL_NO_CONTEXT)
            throw std::runtime_error("GL source \"" + name + "\" has no GL 4.5 core context");
        try {
            makeCurrent();
            api_ = loadApi(egl_.getProcAddress);
            facts_ = askFacts(api_);
            const bool isLlvmpipe = facts_.renderer.starts_with("llvmpipe");
            if (isLlvmpipe == onGpu)
                throw std::runtime_error("GL source \"" + name + "\" is drawn by " +
                                         facts_.renderer);
            if (isLlvmpipe) facts_.snapPx = kLlvmpipeSnapPx;
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~EglContext() override { destroy(); }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    void makeCurrent() override {
        if (egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            throw std::runtime_error("EGL cannot make its context current");
    }
    const Api& api() const override { return api_; }
    const GlFacts& facts() const override { return facts_; }

  private:
    void destroy() {
        if (egl_.getCurrentContext() == context_)
            egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        egl_.destroyContext(display_, context_);
    }

    Egl egl_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    Api api_;
    GlFacts facts_;
};

}  // namespace

std::unique_ptr<Context> createEglContext(bool onGpu) {
    return std::make_unique<EglContext>(onGpu);
}

}  // namespace farol::render::gl
