#include "scene/bundle.h"

#include <algorithm>
#include <vector>

#include "scene/digest.h"
#include "scene/words.h"

namespace farol::scene {
namespace {

constexpr std::size_t kShownCandidates = 5;

bool isDocument(const std::string& path) {
    return path.size() > 4 && sameWord(std::string_view(path).substr(path.size() - 4), ".xml");
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
    if (candidates.empty())
        throw Error("bundle.no-scene",
                    "There is no scene among the files: no part named \"scene\", no scene.xml and "
                    "no other .xml file.",
                    {}, "scene");
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
