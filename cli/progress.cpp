#include "cli/progress.h"

#include <unistd.h>

#include <cstdio>

namespace farol::cli {

bool Progress::isStderrTerminal() { return ::isatty(STDERR_FILENO) != 0; }

void Progress::operator()(std::size_t done, std::size_t all) {
    const std::lock_guard lock(mutex_);
    const std::size_t percent = 100 * done / all;
    const double secondsGone =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    const auto left = static_cast<long>(
        secondsGone / static_cast<double>(done) * static_cast<double>(all - done) + 0.5);
    char time[32];
    std::snprintf(time, sizeof time, "%ld:%02ld left", left / 60, left % 60);
    if (isTerminal_) {
        std::string bar(percent / 4, '=');
        bar.resize(25, ' ');
        std::fprintf(stderr, "\r\033[K%s [%s] %zu/%zu  %s%s", work_.c_str(), bar.c_str(), done, all,
                     time, done == all ? "\n" : "");
    } else if (percent / 10 != tenth_) {
        tenth_ = percent / 10;
        std::fprintf(stderr, "%s %zu/%zu  %zu %%  %s\n", work_.c_str(), done, all, percent, time);
    }
    std::fflush(stderr);
}

}  // namespace farol::cli
