#include "render/gl/llvmpipe.h"

#include <cstdlib>
#include <mutex>

namespace farol::render::gl {

void chooseExactFilters() {
    static std::once_flag once;
    std::call_once(once, [] { setenv("GALLIVM_PERF", "no_aos_sampling", 0); });
}

}  // namespace farol::render::gl
