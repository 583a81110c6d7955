#include <dlfcn.h>

#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>

#include "render/build_id.h"
#include "render/decoder.h"

namespace farol::render {
namespace {

namespace fs = std::filesystem;

std::string findModule() {
    std::error_code failed;
    const fs::path folder = fs::read_symlink("/proc/self/exe", failed).parent_path();
    // Beside the program, as built or copied; installed; the tests lie one or two folders deeper.
    for (const char* place : {"", "../lib/farol", "..", "../.."}) {
        const fs::path file = folder / place / FAROL_OIIO_MODULE;
        if (fs::exists(file, failed)) return file.lexically_normal().string();
    }
    return (folder / FAROL_OIIO_MODULE).string();
}

}  // namespace

const char* moduleFile() {
    static const std::string file = findModule();
    return file.c_str();
}

void readByModule(const char* format, std::string_view bytes, bool wantsPixels, Decoded& out) {
    static std::mutex mutex;
    static ModuleRead read = nullptr;
    {
        const std::lock_guard lock(mutex);
        if (read == nullptr) {
            buildId();  // of the program as it started, whatever it loads later
            void* module = dlopen(moduleFile(), RTLD_NOW | RTLD_LOCAL);
            void* found = module == nullptr ? nullptr : dlsym(module, kModuleRead);
            if (found == nullptr) {
                const char* why = dlerror();
                throw std::runtime_error(
                    std::string("the module that reads ") + format + " files cannot be loaded: " +
                    (why == nullptr ? "it has no reader" : why) + "; PNG, JPEG and WebP need none");
            }
            read = reinterpret_cast<ModuleRead>(found);
        }
    }
    const char* fault = "";
    if (!read(format, bytes, wantsPixels, out, fault)) throw std::runtime_error(fault);
}

}  // namespace farol::render
