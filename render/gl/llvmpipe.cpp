#include "render/gl/llvmpipe.h"

#include <cstdlib>

namespace farol::render::gl {

void setMesaVariables(GlSource source) {
    setenv("GALLIVM_PERF", "no_aos_sampling", 0);
    if (source == GlSource::eglGpu)
        unsetenv("LIBGL_ALWAYS_SOFTWARE");
    else
        setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
}

}  // namespace farol::render::gl
