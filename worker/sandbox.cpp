#include "worker/sandbox.h"

#include <pwd.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "image/load_module.h"

namespace farol::worker {
namespace {

// A sanitizer's shadow counts as memory of the process: no cap is possible there.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

std::string missing() { return std::string("missing: ") + std::strerror(errno); }

bool limit(__rlimit_resource resource, rlim_t value) {
    const rlimit both{value, value};
    return setrlimit(resource, &both) == 0;
}

/// Lowers a limit to `value`; one that is lower already stays.
bool lower(__rlimit_resource resource, rlim_t value) {
    rlimit both{};
    if (getrlimit(resource, &both) != 0) return false;
    both = {std::min(value, both.rlim_cur), std::min(value, both.rlim_max)};
    return setrlimit(resource, &both) == 0;
}

// Threads, of all processes of the user: half of the ids that Linux has by default.
constexpr rlim_t kMaxThreads = 16'384;
constexpr rlim_t kMaxStackBytes = rlim_t{64} << 20U;
// Address space beyond the private memory: libraries, stacks, heaps that are only reserved. It
// bounds page tables, which RLIMIT_DATA does not count, to 1/512 of it.
constexpr rlim_t kReservedBytes = rlim_t{64} << 30U;

std::string limitResources(std::size_t memoryBytes) {
    if (!limit(RLIMIT_CORE, 0) || !lower(RLIMIT_NOFILE, 64) || !lower(RLIMIT_NPROC, kMaxThreads) ||
        !lower(RLIMIT_STACK, kMaxStackBytes))
        return missing();
    if (kSanitized) return "on, without a memory cap: a sanitizer's build";
    if (memoryBytes == 0) return "on, without a memory cap";
    if (!lower(RLIMIT_DATA, memoryBytes) || !lower(RLIMIT_AS, memoryBytes + kReservedBytes))
        return missing();
    return "on";
}

/// Where Mesa keeps compiled shaders (its documentation, "Environment Variables").
std::string shaderCache() {
    namespace fs = std::filesystem;
    fs::path folder;
    const char* single = std::getenv("MESA_DISK_CACHE_SINGLE_FILE");
    const bool isSingle = single != nullptr && std::strcmp(single, "1") == 0;
    const auto from = [&](const char* variable, std::string below) {
        const char* value = std::getenv(variable);
        if (isSingle) below += "_sf";
        if (folder.empty() && value != nullptr && *value != '\0') folder = fs::path(value) / below;
    };
    from("MESA_SHADER_CACHE_DIR", "mesa_shader_cache");
    from("MESA_GLSL_CACHE_DIR", "mesa_shader_cache");
    from("XDG_CACHE_HOME", "mesa_shader_cache");
    from("HOME", ".cache/mesa_shader_cache");
    if (folder.empty()) {
        const passwd* user = getpwuid(getuid());
        if (user != nullptr && user->pw_dir != nullptr)
            folder = fs::path(user->pw_dir) /
                     (isSingle ? ".cache/mesa_shader_cache_sf" : ".cache/mesa_shader_cache");
    }
    // Mesa asks the password file for the home folder, never HOME, and that file is closed here.
    if (!folder.empty()) setenv("MESA_SHADER_CACHE_DIR", folder.parent_path().c_str(), 0);
    std::error_code ignored;  // without a cache Mesa compiles every time
    if (!folder.empty()) fs::create_directories(folder, ignored);
    return folder.string();
}

/// Adds the folders in which the loader looks first: of a program that brings its own libraries.
void addLibraryFolders(std::vector<std::string>& readable) {
    const char* folders = std::getenv("LD_LIBRARY_PATH");
    std::istringstream list(folders != nullptr ? folders : "");
    for (std::string folder; std::getline(list, folder, ':');) readable.push_back(folder);
}

/// Files that the program and its libraries load.
std::vector<std::string> programFiles() {
    std::vector<std::string> files{"/usr", "/lib", "/lib64", "/sys/devices/system/cpu",
                                   "/etc/ld.so.cache"};
    const std::vector<std::string>& modules = image::moduleFiles();
    files.insert(files.end(), modules.begin(), modules.end());
    addLibraryFolders(files);
    return files;
}

}  // namespace

void enterSandbox(const SandboxOptions& options, Layers& layers) {
    layers.emplace_back("deathSignal", prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 ? "on" : missing());
    layers.emplace_back("noNewPrivileges",
                        prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 ? "on" : missing());
    layers.emplace_back("limits", limitResources(options.memoryBytes));
    std::vector<std::string> readable = programFiles();
    readable.insert(readable.end(), options.readable.begin(), options.readable.end());
    layers.emplace_back("landlock", restrictFiles(readable, {shaderCache()}));
}

void closeSandbox(const SandboxOptions& options, Layers& layers) {
    signal(SIGXFSZ, SIG_IGN);
    if (!kSanitized && !limit(RLIMIT_FSIZE, 0)) layers.emplace_back("fileSize", missing());
    // From here on only reading: scenes, the libraries that Mesa loads at its first draw call,
    // those of the modules, and Mesa's shader cache. A worker that could write to the cache could
    // leave code for later workers.
    std::vector<std::string> readable = options.readable;
    for (const char* path : {"/usr/lib", "/lib", "/lib64", "/etc/ld.so.cache"})
        readable.emplace_back(path);
    const std::vector<std::string>& modules = image::moduleFiles();
    readable.insert(readable.end(), modules.begin(), modules.end());
    addLibraryFolders(readable);
    readable.push_back(shaderCache());
    restrictFiles(readable, {});
    layers.emplace_back("seccomp", restrictCalls(kSocket));
}

Layers closeCommandLine(const SandboxOptions& options) {
    Layers layers;
    layers.emplace_back("noNewPrivileges",
                        prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 ? "on" : missing());
    layers.emplace_back("limits", limitResources(options.memoryBytes));
    std::vector<std::string> readable = programFiles();
    readable.insert(readable.end(), options.readable.begin(), options.readable.end());
    const std::string landlock = restrictFiles(readable, {shaderCache()});
    layers.emplace_back("landlock", landlock);
    const bool isConfined = landlock.rfind("abi", 0) == 0;
    layers.emplace_back("seccomp", restrictCalls(kSocket, isConfined));
    return layers;
}

}  // namespace farol::worker
