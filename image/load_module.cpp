#include "image/load_module.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

#include "core/build_id.h"

namespace farol::image {

std::string findModule(const std::string& file) {
    namespace fs = std::filesystem;
    std::error_code failed;
    const fs::path folder = fs::read_symlink("/proc/self/exe", failed).parent_path();
    for (const char* place : {"", "../lib/farol", "..", "../.."}) {
        const fs::path path = folder / place / file;
        if (fs::exists(path, failed)) return path.lexically_normal().string();
    }
    return (folder / file).string();
}

void* loadFunction(const std::string& path, const char* name) {
    buildId();  // before dlopen: excludes the libraries that the module loads
    void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* function = module == nullptr ? nullptr : dlsym(module, name);
    if (function == nullptr) {
        const char* why = dlerror();
        throw std::runtime_error(why == nullptr ? "it has no such function" : why);
    }
    return function;
}

const std::vector<std::string>& moduleFiles() {
    static const std::vector<std::string> files{findModule(FAROL_OIIO_MODULE),
                                                findModule(FAROL_VIDEO_MODULE)};
    return files;
}

}  // namespace farol::image
