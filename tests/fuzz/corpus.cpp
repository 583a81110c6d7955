#include "tests/fuzz/corpus.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "core/digest.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {
namespace {

namespace fs = std::filesystem;

bool wanted(const fs::path& path, const std::vector<std::string>& endings) {
    const std::string ending = path.extension().string();
    return endings.empty() || std::any_of(endings.begin(), endings.end(),
                                          [&](const auto& one) { return ending == "." + one; });
}

std::string contentOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::vector<std::string> readCorpus(const std::vector<std::string>& paths,
                                    const std::vector<std::string>& endings) {
    std::set<fs::path> files;
    for (const std::string& path : paths) {
        if (fs::is_directory(path)) {
            for (const auto& entry : fs::recursive_directory_iterator(path))
                if (entry.is_regular_file() && wanted(entry.path(), endings))
                    files.insert(entry.path());
        } else if (fs::is_regular_file(path)) {
            files.insert(path);  // named by itself: taken whatever its ending
        } else {
            throw std::runtime_error("there is no corpus " + path);
        }
    }
    std::vector<std::string> seeds;
    std::set<std::string> known;
    for (const fs::path& file : files) {
        if (fs::file_size(file) > kMaxInput) {
            std::fprintf(stderr, "left out, over %zu bytes: %s\n", kMaxInput, file.c_str());
            continue;
        }
        std::string content = contentOf(file);
        if (known.insert(content).second) seeds.push_back(std::move(content));
    }
    return seeds;
}

std::string saveInput(const std::string& folder, const std::string& input) {
    fs::create_directories(folder);
    const fs::path path = fs::path(folder) / ("finding-" + contentDigest(input));
    std::ofstream(path, std::ios::binary) << input;
    return path.string();
}

}  // namespace farol::fuzz
