// Runs a target on mutated seeds where there is no libFuzzer:
//   fuzz_scene [--seconds N] [--runs N] [--seed S] [--patience N] [--out FOLDER] CORPUS...
//   fuzz_scene --dictionary      prints the target's tokens as libFuzzer takes them
// The inputs run in a child, so that whatever ends it (a sanitizer, a signal, a hang, too much
// memory) leaves the last input in shared memory for the parent to save. Exit code 1: a finding.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/number.h"
#include "tests/fuzz/corpus.h"
#include "tests/fuzz/mutate.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t kMemoryFactor = 4;  // red zones, and freed memory that is kept back
#else
constexpr std::size_t kMemoryFactor = 1;
#endif
constexpr int kFindingCode = 77;
/// Seeds that were made rather than read, at most.
constexpr std::size_t kMaxKept = 4096;

struct Settings {
    std::uint64_t runs = 0;     ///< 0: no bound
    std::uint64_t seconds = 0;  ///< of CPU time; 0: no bound
    std::uint64_t seed = 1;
    /// Seconds of CPU time, so that a busy machine makes no finding, after which an input counts
    /// as a hang: none needs a hundredth of it.
    std::uint64_t patience = 30;
    std::string out = ".";
    int child = -1;  ///< set in the child: the descriptor of the shared memory
    bool dictionary = false;
    std::vector<std::string> corpus;
};

/// Data of the child that the parent can read after any end of it.
struct Shared {
    std::uint64_t runs, kept, reached;
    double cpuSeconds;
    std::size_t size;
    bool finished;
    char input[kMaxInput];
};

std::set<std::string, std::less<>>& reachedNow() {
    static std::set<std::string, std::less<>> things;
    return things;
}

double cpuSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void runOne(const std::string& input, const Settings& settings, Shared& shared) {
    std::copy(input.begin(), input.end(), shared.input);
    shared.size = input.size();
    const itimerval patience{{0, 0}, {static_cast<time_t>(settings.patience), 0}};
    setitimer(ITIMER_PROF, &patience, nullptr);
    reachedNow().clear();
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    ++shared.runs;
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const std::size_t megabytes = static_cast<std::size_t>(used.ru_maxrss) / 1024;
    require(megabytes < target().maxMegabytes * kMemoryFactor,
            "the run has come to " + std::to_string(megabytes) + " MiB");
}

/// True if the input reached a set of things that none before it did.
bool isNew(std::set<std::string>& known) {
    std::string all;
    for (const std::string& thing : reachedNow()) all += thing + ' ';
    return known.insert(all).second;
}

void fuzz(const Settings& settings, std::vector<std::string> seeds, Shared& shared) {
    std::set<std::string> known;
    for (const std::string& seed : seeds) {
        runOne(seed, settings, shared);
        isNew(known);
    }
    Mutator mutator(settings.seed, target().tokens);
    // Of two seeds the shorter: it runs sooner, and an edit changes more of it.
    const auto pick = [&]() -> const std::string& {
        const std::string& one = seeds[mutator.below(seeds.size())];
        const std::string& two = seeds[mutator.below(seeds.size())];
        return two.size() < one.size() ? two : one;
    };
    const std::size_t read = seeds.size();
    while ((settings.runs == 0 || shared.runs < settings.runs) &&
           (settings.seconds == 0 || shared.cpuSeconds < static_cast<double>(settings.seconds))) {
        std::string input = mutator.mutate(pick(), pick(), kMaxInput);
        runOne(input, settings, shared);
        shared.cpuSeconds = cpuSeconds();
        if (isNew(known) && seeds.size() < read + kMaxKept) seeds.push_back(std::move(input));
        shared.kept = seeds.size() - read;
        shared.reached = known.size();
    }
    shared.cpuSeconds = cpuSeconds();
}

/// Returns the child's exit code.
int childMain(const Settings& settings, std::vector<std::string> seeds, Shared& shared) {
    try {
        fuzz(settings, std::move(seeds), shared);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        _exit(kFindingCode);  // no search for leaks: it would hide this finding's code
    }
    const itimerval off{};
    setitimer(ITIMER_PROF, &off, nullptr);
    shared.finished = true;
    return 0;
}

std::string describe(int status, const Settings& settings) {
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        if (signal == SIGPROF)
            return "no end within " + std::to_string(settings.patience) + " s of CPU time";
        return std::string("signal ") + strsignal(signal);
    }
    if (WEXITSTATUS(status) == kFindingCode) return "a broken promise, reported above";
    return "exit code " + std::to_string(WEXITSTATUS(status));
}

std::uint64_t readNumber(const std::string& flag, const char* text) {
    const auto value = parseExact<std::uint64_t>(text);
    if (!value) throw std::runtime_error(flag + " takes a whole number");
    return *value;
}

Settings readSettings(int count, char** words) {
    Settings settings;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--dictionary") {
            settings.dictionary = true;
        } else if (word.starts_with("--")) {
            if (i + 1 == count) throw std::runtime_error(word + " needs a value");
            const char* value = words[++i];
            if (word == "--out")
                settings.out = value;
            else if (word == "--seconds")
                settings.seconds = readNumber(word, value);
            else if (word == "--runs")
                settings.runs = readNumber(word, value);
            else if (word == "--seed")
                settings.seed = readNumber(word, value);
            else if (word == "--child")  // the driver's own: see run
                settings.child = static_cast<int>(readNumber(word, value));
            else if (word == "--patience")
                settings.patience = readNumber(word, value);
            else
                throw std::runtime_error("unknown flag " + word);
        } else {
            settings.corpus.push_back(word);
        }
    }
    if (settings.runs == 0 && settings.seconds == 0) settings.seconds = 60;
    return settings;
}

void printDictionary() {
    for (const std::string& token : target().tokens) {
        std::string line;
        for (const char c : token) {
            const auto byte = static_cast<unsigned char>(c);
            char text[8];
            std::snprintf(text, sizeof text, "\\x%02X", byte);
            const bool plain = byte >= 0x20 && byte < 0x7F && c != '"' && c != '\\';
            line += plain ? std::string(1, c) : std::string(text);
        }
        std::printf("\"%s\"\n", line.c_str());
    }
}

Shared& mapShared(int descriptor) {
    void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
    return *static_cast<Shared*>(memory);  // a new file's zeros are its first state
}

int runChild(const Settings& settings) {
    return childMain(settings, readCorpus(settings.corpus, target().endings),
                     mapShared(settings.child));
}

int run(const Settings& settings, int count, char** words) {
    const std::size_t read = readCorpus(settings.corpus, target().endings).size();
    if (read == 0) throw std::runtime_error("the corpus holds no seed for this target");
    const int descriptor = memfd_create("fuzz", 0);
    if (descriptor < 0 || ftruncate(descriptor, sizeof(Shared)) != 0)
        throw std::runtime_error("no shared memory");
    Shared& shared = mapShared(descriptor);
    std::vector<char*> arguments(words, words + count);
    std::string flag = "--child", number = std::to_string(descriptor);
    arguments.insert(arguments.end(), {flag.data(), number.data(), nullptr});
    std::fflush(nullptr);
    // Started anew: libraries have threads from the start, which a fork alone would not have.
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no child process");
    if (child == 0) {
        execv("/proc/self/exe", arguments.data());
        _exit(127);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) throw std::runtime_error("the child process is lost");
    std::printf("%llu runs, %.1f s of CPU time, %zu seeds read, %llu made, %llu outcomes\n",
                static_cast<unsigned long long>(shared.runs), shared.cpuSeconds, read,
                static_cast<unsigned long long>(shared.kept),
                static_cast<unsigned long long>(shared.reached));
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && shared.finished) return 0;
    if (shared.finished) {
        std::printf("finding at the end of the run: %s (a leak has no single input)\n",
                    describe(status, settings).c_str());
        return 1;
    }
    const std::string path =
        saveInput(settings.out, std::string(shared.input, std::min(shared.size, kMaxInput)));
    std::printf("finding: %s; the input is in %s\n", describe(status, settings).c_str(),
                path.c_str());
    return 1;
}

}  // namespace

void reached(std::string_view what) { reachedNow().emplace(what); }

}  // namespace farol::fuzz

int main(int count, char** words) {
    using namespace farol::fuzz;
    try {
        const Settings settings = readSettings(count, words);
        if (settings.child >= 0) return runChild(settings);
        if (!settings.dictionary) return run(settings, count, words);
        printDictionary();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
