#include "scene/bundle.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "scene/digest.h"
#include "scene/words.h"

namespace farol::scene {
namespace {

constexpr std::size_t kShownCandidates = 5;

bool isDocument(const std::string& path) {
    return path.size() > 4 && sameWord(std::string_view(path).substr(path.size() - 4), ".xml");
}

bool isMesh(const std::string& path) {
    static constexpr std::string_view kEndings[] = {".3d",  ".3db", ".obj", ".ply",
                                                    ".tri", ".stl", ".off", ".patch"};
    return std::any_of(std::begin(kEndings), std::end(kEndings), [&](std::string_view ending) {
        return path.size() > ending.size() &&
               sameWord(std::string_view(path).substr(path.size() - ending.size()), ending);
    });
}

}  // namespace

std::size_t Bundle::bytes() const {
    std::size_t sum = 0;
    for (const auto& [path, content] : files) sum += path.size() + content.size();
    return sum;
}

std::string mainOf(const std::map<std::string, std::string>& files) {
    if (files.count("scene.xml") != 0) return "scene.xml";
    std::vector<std::string> candidates;
    for (const auto& [path, content] : files)
        if (isDocument(path)) candidates.push_back(path);
    if (candidates.size() == 1) return candidates.front();
    if (candidates.empty()) {
        std::string message =
            "There is no scene among the files: no part named \"scene\", no scene.xml and no other "
            ".xml file.";
        const auto mesh = std::find_if(files.begin(), files.end(),
                                       [](const auto& one) { return isMesh(one.first); });
        // A word of a document cannot hold quotes, and a name with them is better not shown as
        // code.
        if (mesh != files.end() && mesh->first.find_first_of("\"<&") == std::string::npos)
            message +=
                " A mesh is drawn by a scene that names it: add a scene.xml with <world><group>"
                "<models><model file=\"" +
                mesh->first + "\"/></models></group></world>.";
        else
            message += " Add a scene.xml that names them.";
        throw Error("bundle.no-scene", message, {}, "scene");
    }
    std::string names;
    for (std::size_t i = 0; i < std::min(candidates.size(), kShownCandidates); ++i)
        names += (i == 0 ? "" : ", ") + quoted(candidates[i]);
    if (candidates.size() > kShownCandidates) names += " and more";
    throw Error("bundle.which-scene",
                "Which file is the scene? " + names +
                    " could be; call one scene.xml, or send it as the part \"scene\".",
                {}, "scene");
}

std::string digestOf(const Bundle& bundle) {
    std::string all = std::to_string(bundle.main.size()) + ":" + bundle.main;
    for (const auto& [path, content] : bundle.files)
        all.append(std::to_string(path.size()))
            .append(":")
            .append(path)
            .append(contentDigest(content));
    return contentDigest(all);
}

}  // namespace farol::scene
