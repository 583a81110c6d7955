// Decodes a set of crafted images with every decoder in one process:
//   crafted_images [--count N] [--first I] [--once] [--save INDEX FILE] SEEDS
// Each image is decoded twice unless --once, in processes whose fresh memory holds different bytes:
// a result that differs shows memory that was never written. Exit code 1: an image ended the
// process, took longer than ten seconds of CPU time, or gave two results.
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "core/number.h"
#include "image/image_file.h"
#include "tests/fuzz/crafted.h"

namespace {

constexpr std::uint64_t kNoResult = 0;
constexpr int kMaxSeconds = 10;  // of CPU time, for one image

struct Settings {
    std::uint64_t count = 20000, first = 0;
    std::vector<std::string> seeds;
    std::string saveTo;
    bool once = false;
};

/// FNV-1a.
std::uint64_t digest(std::uint64_t hash, const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 0x100000001B3ULL;
    return hash;
}

std::uint64_t decode(const farol::fuzz::CraftedImage& input) {
    std::uint64_t hash = 0xCBF29CE484222325ULL;
    try {
        const farol::image::Image image = farol::image::decodeImage(input.bytes, input.name);
        hash = digest(hash, &image.width, sizeof image.width);
        hash = digest(hash, image.pixels.data(), image.pixels.size());
    } catch (const farol::Error& error) {
        hash = digest(hash, error.code().data(), error.code().size());
    } catch (const std::bad_alloc&) {
        hash = digest(hash, "memory", 6);
    }
    return hash == kNoResult ? 1 : hash;
}

template <typename T>
T* shared(std::size_t count) {
    void* memory =
        mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
    return static_cast<T*>(memory);
}

[[noreturn]] void decodeFrom(const Settings& settings, std::uint64_t begin, int fill,
                             volatile std::uint64_t* at, std::uint64_t* results) {
    for (std::uint64_t i = begin; i < settings.count; ++i) {
        *at = i;
        mallopt(M_PERTURB, fill);  // OpenEXR sets it back
        const itimerval patience{{0, 0}, {kMaxSeconds, 0}};
        setitimer(ITIMER_PROF, &patience, nullptr);
        results[i] = decode(farol::fuzz::craftImage(settings.first + i, settings.seeds));
    }
    _exit(0);
}

/// Returns how many images ended the process.
std::uint64_t run(const Settings& settings, int fill, std::uint64_t* results) {
    auto* at = shared<std::uint64_t>(1);
    std::uint64_t ended = 0;
    std::map<std::string, int> reasons;
    for (std::uint64_t begin = 0; begin < settings.count;) {
        std::fflush(nullptr);
        const pid_t child = fork();
        if (child < 0) throw std::runtime_error("no child process");
        if (child == 0) decodeFrom(settings, begin, fill, at, results);
        int status = 0;
        while (waitpid(child, &status, 0) < 0)
            if (errno != EINTR) throw std::runtime_error("the child process is lost");
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) break;
        const std::string reason = WIFSIGNALED(status)
                                       ? strsignal(WTERMSIG(status))
                                       : "exit code " + std::to_string(WEXITSTATUS(status));
        if (reasons[reason]++ < 20)
            std::printf("image %llu ended the process: %s\n",
                        static_cast<unsigned long long>(settings.first + *at), reason.c_str());
        ++ended;
        begin = *at + 1;
    }
    munmap(at, sizeof *at);
    return ended;
}

std::uint64_t number(const char* text) {
    const auto value = farol::parseExact<std::uint64_t>(text);
    if (!value) throw std::runtime_error(std::string("\"") + text + "\" is not a whole number");
    return *value;
}

Settings readSettings(int count, char** words) {
    Settings settings;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--count" && i + 1 < count) {
            settings.count = number(words[++i]);
        } else if (word == "--once") {
            settings.once = true;
        } else if (word == "--first" && i + 1 < count) {
            settings.first = number(words[++i]);
        } else if (word == "--save" && i + 2 < count) {
            settings.first = number(words[++i]);
            settings.saveTo = words[++i];
        } else {
            std::vector<std::filesystem::path> files;
            for (const auto& entry : std::filesystem::directory_iterator(word))
                files.push_back(entry.path());
            std::sort(files.begin(), files.end());
            for (const auto& file : files) {
                std::ifstream in(file, std::ios::binary);
                settings.seeds.emplace_back(std::istreambuf_iterator<char>(in),
                                            std::istreambuf_iterator<char>());
            }
        }
    }
    return settings;
}

int compare(const Settings& settings) {
    auto* first = shared<std::uint64_t>(settings.count);
    auto* second = shared<std::uint64_t>(settings.count);
    const std::uint64_t ended =
        run(settings, 0x55, first) + (settings.once ? 0 : run(settings, 0xAA, second));
    std::uint64_t differing = 0;
    for (std::uint64_t i = 0; i < settings.count; ++i) {
        if (first[i] == second[i] || first[i] == kNoResult || second[i] == kNoResult) continue;
        if (differing++ < 20)
            std::printf("image %llu gives two results\n",
                        static_cast<unsigned long long>(settings.first + i));
    }
    std::printf(
        "%llu images: %llu times the process ended, %llu results "
        "differ\n",
        static_cast<unsigned long long>(settings.count), static_cast<unsigned long long>(ended),
        static_cast<unsigned long long>(differing));
    return ended + differing == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
    // Small pieces of memory that are used again would not be filled.
    constexpr const char* kTunables = "GLIBC_TUNABLES";
    if (std::getenv(kTunables) == nullptr) {
        setenv(kTunables, "glibc.malloc.tcache_count=0", 1);
        execv("/proc/self/exe", words);
    }
    try {
        const Settings settings = readSettings(count, words);
        if (settings.saveTo.empty()) return compare(settings);
        std::ofstream(settings.saveTo, std::ios::binary)
            << farol::fuzz::craftImage(settings.first, settings.seeds).bytes;
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
