#include "render/gl/api.h"

#include <new>
#include <stdexcept>
#include <string>

namespace farol::render::gl {

Api loadApi(GetProcAddress* loader) {
    Api api;
#define FAROL_GL_LOAD(name, type)                          \
    api.name = reinterpret_cast<type>(loader("gl" #name)); \
    if (!api.name) throw std::runtime_error("this GL has no gl" #name);
    FAROL_GL_FUNCTIONS(FAROL_GL_LOAD)
#undef FAROL_GL_LOAD
    return api;
}

void clearErrors(const Api& api) {
    // One flag an error; a lost context reports for ever.
    constexpr int kMaxFlags = 16;
    for (int i = 0; i < kMaxFlags && api.GetError() != GL_NO_ERROR; ++i) {
    }
}

void throwOnError(const Api& api, const char* step) {
    const GLenum error = api.GetError();
    if (error == GL_NO_ERROR) return;
    clearErrors(api);
    if (error == GL_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("GL error " + std::to_string(error) + " while " + step);
}

}  // namespace farol::render::gl
