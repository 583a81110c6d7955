#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/stopwatch.h"
#include "render/renderer.h"

/// Shared by the measuring programs: arguments, the job, medians.
namespace farol::bench {

inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

/// SCENE.xml [--runs N] [--json] [--save STEM] [name=value ...]
struct Arguments {
    std::filesystem::path scene;
    int runs = 51;
    bool json = false;
    std::string save;
    render::PictureOptions options;

    static Arguments parse(int count, char** arguments) {
        Arguments given;
        for (int i = 1; i < count; ++i) {
            const std::string word(arguments[i]);
            const std::size_t equals = word.find('=');
            if (word == "--json")
                given.json = true;
            else if (word == "--runs" && i + 1 < count)
                given.runs = std::max(1, std::atoi(arguments[++i]));
            else if (word == "--save" && i + 1 < count)
                given.save = arguments[++i];
            else if (equals != std::string::npos && given.scene.string().size())
                render::applyOption(given.options, word.substr(0, equals), word.substr(equals + 1));
            else if (given.scene.empty())
                given.scene = word;
            else
                throw std::runtime_error("what is " + word + "?");
        }
        if (given.scene.empty())
            throw std::runtime_error(
                "give SCENE.xml [--runs N] [--json] [--save STEM] [name=value ...]");
        return given;
    }
};

/// The job of the arguments, named so that the renderer keeps the scene, as the service does.
inline render::Job jobOf(const Arguments& given) {
    std::ifstream in(given.scene, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + given.scene.string());
    render::Job job;
    job.name = given.scene.filename().string();
    job.xml = {std::istreambuf_iterator<char>(in), {}};
    job.assets = std::make_shared<scene::FolderAssets>(
        given.scene.has_parent_path() ? given.scene.parent_path().string() : ".");
    job.options = given.options;
    job.identity = given.scene.string();
    return job;
}

}  // namespace farol::bench
