#include <dlfcn.h>
#include <malloc.h>

#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "core/build_id.h"
#include "image/load_module.h"
#include "image/module.h"

namespace farol::image {
namespace {

/// Silences libgcrypt, which a library of the module starts: in a sandbox it warns on standard
/// error, because it cannot lock memory. No secrets are here.
void silenceGcrypt() {
    constexpr int kDisableSecureMemoryWarning = 27;  // GCRYCTL_DISABLE_SECMEM_WARN
    void* library = dlopen("libgcrypt.so.20", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return;
    using Control = unsigned (*)(int command, ...);
    if (const auto control = reinterpret_cast<Control>(dlsym(library, "gcry_control")))
        control(kDisableSecureMemoryWarning);
}

ModuleRead load() {
    buildId();  // before dlopen: excludes the libraries that are loaded now
    silenceGcrypt();
    try {
        return reinterpret_cast<ModuleRead>(
            loadFunction(findModule(FAROL_OIIO_MODULE), kModuleRead));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(
            std::string("the module that reads this format cannot be loaded: ") + error.what() +
            "; fix: install it and OpenImageIO 2.4, or save the image as PNG or Radiance HDR");
    }
}

/// While it lives, malloc hands out zeroed memory: M_PERTURB writes the complement of its value.
/// It does not reach the cache that malloc keeps for a thread, so the work needs a new thread.
class ZeroedMemory {
  public:
    ZeroedMemory() { mallopt(M_PERTURB, 0xff); }
    ~ZeroedMemory() { mallopt(M_PERTURB, 0); }
    ZeroedMemory(const ZeroedMemory&) = delete;
    ZeroedMemory& operator=(const ZeroedMemory&) = delete;
};

}  // namespace

void readByModule(const ModuleRequest& request) {
    static std::mutex mutex;
    static ModuleRead read = nullptr;
    const std::lock_guard lock(mutex);
    if (read == nullptr) read = load();
    bool isDecoded = false;
    std::string reason;
    {
        const ZeroedMemory memory;
        std::thread thread([&] {
            const char* failure = read(request);
            isDecoded = failure == nullptr;
            if (!isDecoded) reason = failure;
        });
        thread.join();
    }
    if (reason == kModuleOutOfMemory) throw std::bad_alloc();
    if (!isDecoded) throw std::runtime_error(reason);
}

}  // namespace farol::image
