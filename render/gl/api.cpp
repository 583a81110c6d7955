#include "render/gl/api.h"

#include <stdexcept>
#include <string>

namespace farol::render::gl {

Api loadApi(ProcLoader loader) {
    Api api;
#define FAROL_GL_LOAD(name, type)                          \
    api.name = reinterpret_cast<type>(loader("gl" #name)); \
    if (!api.name) throw std::runtime_error("this GL has no gl" #name);
    FAROL_GL_FUNCTIONS(FAROL_GL_LOAD)
#undef FAROL_GL_LOAD
    return api;
}

}  // namespace farol::render::gl
