#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace farol::test {

/// The processes that this one has started and that are still running, but for `others`.
inline std::vector<pid_t> childrenBut(const std::set<pid_t>& others = {}) {
    std::vector<pid_t> all;
    std::error_code failed;
    for (std::filesystem::directory_iterator at("/proc", failed), end; !failed && at != end;
         at.increment(failed)) {
        const std::string name = at->path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        std::ifstream in(at->path() / "stat");
        std::string text;
        std::getline(in, text);
        // "PID (NAME) STATE PARENT ...", and a name may hold anything.
        const std::size_t close = text.rfind(')');
        if (close == std::string::npos || close + 4 > text.size()) continue;
        const char state = text[close + 2];
        const pid_t pid = std::stoi(name);
        if (state != 'Z' && state != 'X' && std::stoi(text.substr(close + 4)) == getpid() &&
            others.count(pid) == 0)
            all.push_back(pid);
    }
    return all;
}

/// The same as a set.
inline std::set<pid_t> childrenNow() {
    const std::vector<pid_t> all = childrenBut();
    return {all.begin(), all.end()};
}

}  // namespace farol::test
