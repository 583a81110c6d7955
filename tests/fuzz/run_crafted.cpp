// Reads crafted mesh files by every importer:
//   run_crafted [--each] COUNT      all in one process, or each in a separate process
// Exit code 1: some of them end the process, take more than kSeconds of its CPU time, or make a
// mesh that breaks its promises; what they are is printed.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "generator/io/mesh_file.h"
#include "generator/io/patch_file.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/crafted_meshes.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {

void reached(std::string_view) {}

namespace {

namespace io = generator::io;

constexpr rlim_t kSeconds = 10;  // none takes a tenth of one
constexpr int kBroken = 3;       // exit code of a child whose mesh breaks a promise

/// Reads the file as a mesh, a profile and patches; throws Finding where a promise is broken.
void readEveryWay(const CraftedMesh& crafted) {
    try {
        Diagnostics findings;
        checkMesh(io::decodeMesh(crafted.bytes, crafted.name, findings));
    } catch (const Error& error) {
        checkError(error, crafted.name, crafted.bytes);
    }
    try {
        io::decodeProfile(crafted.bytes, crafted.name);
    } catch (const Error& error) {
        checkError(error, crafted.name, crafted.bytes);
    }
    try {
        io::parsePatchFile(crafted.bytes, crafted.name);
    } catch (const Error& error) {
        checkError(error, crafted.name, crafted.bytes);
    }
}

int readAll(std::uint64_t begin, std::uint64_t end) {
    int code = 0;
    for (std::uint64_t number = begin; number < end; ++number) {
        const CraftedMesh crafted = craftMesh(number);
        try {
            readEveryWay(crafted);
        } catch (const std::exception& broken) {
            std::printf("number %llu (%s, %s): %s\n", static_cast<unsigned long long>(number),
                        crafted.name.c_str(), crafted.kind.c_str(), broken.what());
            code = kBroken;
        }
    }
    std::fflush(nullptr);
    return code;
}

/// The outcome of a child that reads these: "" where nothing happened.
std::string outcomeOf(std::uint64_t begin, std::uint64_t end) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) return "no process";
    if (child == 0) {
        const rlim_t seconds = kSeconds + (end - begin) / 20;
        const rlimit cpu{seconds, seconds};
        setrlimit(RLIMIT_CPU, &cpu);
        _exit(readAll(begin, end));
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) return strsignal(WTERMSIG(status));
    if (WEXITSTATUS(status) == kBroken) return "a broken promise";
    return WEXITSTATUS(status) == 0 ? "" : "exit code " + std::to_string(WEXITSTATUS(status));
}

int run(bool each, std::uint64_t count) {
    std::map<std::string, int> outcomes;
    if (each) {
        for (std::uint64_t number = 0; number < count; ++number) {
            const std::string outcome = outcomeOf(number, number + 1);
            if (!outcome.empty()) ++outcomes[outcome];
        }
    } else if (const std::string outcome = outcomeOf(0, count); !outcome.empty()) {
        ++outcomes[outcome];
    }
    for (const auto& [outcome, times] : outcomes) std::printf("%d %s\n", times, outcome.c_str());
    std::printf("%llu crafted meshes read\n", static_cast<unsigned long long>(count));
    return outcomes.empty() ? 0 : 1;
}

}  // namespace
}  // namespace farol::fuzz

int main(int count, char** words) {
    const bool each = count == 3 && std::string(words[1]) == "--each";
    std::uint64_t meshes = 0;
    if (count == 2 || each) {
        const std::string word = words[count - 1];
        std::from_chars(word.data(), word.data() + word.size(), meshes);
    }
    if (meshes == 0) {
        std::fprintf(stderr, "usage: run_crafted [--each] COUNT\n");
        return 2;
    }
    return farol::fuzz::run(each, meshes);
}
