#include "grade/requirements/requirement.h"

#include "core/text.h"
#include "generator/call.h"
#include "generator/registry.h"

namespace farol::grade {

std::string problemOfShape(const std::string& call) {
    try {
        const std::vector<std::string_view> words = split(call);
        generator::parseCall({words.begin(), words.end()});
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

const std::vector<std::string_view>& shapeWords() {
    static const std::vector<std::string_view> kWords = [] {
        std::vector<std::string_view> words;
        for (const generator::ShapeEntry& shape : generator::shapes()) words.push_back(shape.name);
        words.emplace_back("file");
        return words;
    }();
    return kWords;
}

}  // namespace farol::grade
