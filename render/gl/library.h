#pragma once

#include <string>

#include "render/gl_source.h"

namespace farol::render::gl {

inline constexpr const char* kOsMesaLibrary = "libOSMesa.so.8";
inline constexpr const char* kEglLibrary = "libEGL.so.1";

/// A shared library that is loaded at run time and stays loaded: Mesa's cannot be unloaded safely.
class Library {
  public:
    /// Throws std::runtime_error, which names it, where the system's loader does not find it.
    explicit Library(const char* name);

    /// The address of a function. Throws std::runtime_error where the library lacks it.
    template <typename Function>
    Function* function(const char* name) const {
        return reinterpret_cast<Function*>(address(name));
    }

  private:
    void* address(const char* name) const;

    void* handle_ = nullptr;
    std::string name_;
};

/// Returns `source`, or for `automatic` the source that this machine has: OSMesa where its library
/// is found, else EGL.
GlSource resolveSource(GlSource source);

/// Loads the libraries that draw for `source`, where they are installed.
void loadLibraries(GlSource source);

/// 16 hexadecimal digits that change with the program (buildId) and with the libraries that draw
/// for `source`: Mesa's and LLVM. Loads them. Where there are none, those of the program alone.
std::string buildIdFor(GlSource source);

}  // namespace farol::render::gl
