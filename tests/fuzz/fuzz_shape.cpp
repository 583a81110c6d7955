// The words of shapes: as commands, file names and generator comments; small ones are made.
#include <cmath>

#include "generator/registry.h"
#include "generator/words.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/scene_words.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {
namespace {

using Words = std::vector<std::string>;

/// Meshes up to here are made: finer ones have the same faults.
constexpr std::size_t kMostTriangles = 20'000;

void make(const Words& words, const scene::Assets& assets) {
    try {
        const std::size_t most = generator::countTriangles(words, assets);
        require(most <= generator::kMaxTriangles, "more triangles than are allowed");
        if (most > kMostTriangles) return;
        for (const auto uv :
             {scene::UvLayout::face, scene::UvLayout::atlas, scene::UvLayout::layout2017}) {
            const generator::Mesh mesh = generator::generate(words, assets, uv);
            checkMesh(mesh);
            require(mesh.triangles() <= most, "more triangles than were counted");
        }
        reached(words[0]);
    } catch (const Error& error) {
        checkError(error);
    }
}

void refine(const Words& words, const scene::Assets& assets) {
    scene::Model model;
    model.source = {scene::ModelSource::Kind::shape, "", words};
    if (words.empty() || !generator::isOpen(model)) return;
    for (const double error : {1e-12, 0.25, 1e12}) {
        try {
            const Words fine = generator::refine(model, assets, {error, 8});
            require(generator::countTriangles(fine, assets) > 0, "refined to nothing");
            reached("refined " + fine[0]);
        } catch (const Error& fault) {
            checkError(fault);
        }
    }
}

}  // namespace

const Target& target() {
    static const Target made = [] {
        Target out{{"txt"}, {"auto", "p.ply", "t.patch", "teapot.patch", "missing.ply"}, 512};
        for (const generator::Shape& shape : generator::shapes()) {
            out.tokens.push_back(shape.name);
            out.tokens.insert(out.tokens.end(), shape.aliases.begin(), shape.aliases.end());
        }
        return out;
    }();
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol;
    using namespace farol::fuzz;
    const std::string text(reinterpret_cast<const char*>(data), std::min(size, kMaxInput));
    const scene::BundleAssets assets = sceneBundle("");
    // One command a line, and few of them: each may take a while.
    std::size_t begin = 0;
    for (int line = 0; line < 8 && begin <= text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string command = text.substr(begin, end - begin);
        begin = end + 1;
        const auto words = generator::splitWords(command);
        make(words, assets);
        refine(words, assets);
        if (const auto named = generator::wordsOfName(command)) make(*named, assets);
        try {
            Diagnostics findings;
            make(generator::wordsOfComment(words, command, {"scene.xml", 1, 1}, findings), assets);
            checkDiagnostics(findings);
        } catch (const Error& error) {
            checkError(error);
        }
    }
    return 0;
}
