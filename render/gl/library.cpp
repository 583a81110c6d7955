#include "render/gl/library.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

#include "core/build_id.h"

namespace farol::render::gl {
namespace {

void* open(const char* name) {
    // Of the program as it started: a library that is loaded later is not part of it.
    buildId();
    return dlopen(name, RTLD_NOW | RTLD_LOCAL);
}

/// Loads Mesa's part of EGL and its driver, as eglInitialize would, without a display. Either may
/// be absent; nothing is thrown.
void loadEglDriver() {
    void* const vendor = open("libEGL_mesa.so.0");
    if (vendor == nullptr) return;
    const void* const address = dlsym(vendor, "__egl_Main");
    Dl_info info{};
    if (address == nullptr || dladdr(address, &info) == 0 || info.dli_fname == nullptr) return;
    const auto driver = std::filesystem::path(info.dli_fname).parent_path() / "dri/swrast_dri.so";
    open(driver.c_str());
}

}  // namespace

Library::Library(const char* name) : handle_(open(name)), name_(name) {
    if (handle_ == nullptr)
        throw std::runtime_error(std::string("the library ") + name + " is not installed");
}

void* Library::address(const char* name) const {
    void* const found = dlsym(handle_, name);
    if (found == nullptr) throw std::runtime_error(name_ + " has no function " + name);
    return found;
}

GlSource resolveSource(GlSource source) {
    if (source != GlSource::automatic) return source;
    return open(kOsMesaLibrary) != nullptr ? GlSource::osmesa : GlSource::egl;
}

void loadLibraries(GlSource source) {
    if (resolveSource(source) == GlSource::osmesa)
        open(kOsMesaLibrary);
    else
        loadEglDriver();
}

std::string buildIdFor(GlSource source) {
    loadLibraries(source);
    return buildIdWith({"libOSMesa", "libEGL_mesa", "libgallium", "swrast_dri", "libLLVM"});
}

}  // namespace farol::render::gl
