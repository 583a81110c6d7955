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
using generator::ShapeCall;

/// Meshes up to here are made: finer ones have the same faults.
constexpr std::size_t kMaxTriangles = 20'000;

void make(const ShapeCall& call, const scene::Assets& assets) {
    try {
        const std::size_t most = generator::countTriangles(call, assets);
        require(most <= generator::kMaxTriangles, "more triangles than are allowed");
        if (most > kMaxTriangles) return;
        for (const auto uv :
             {scene::UvLayout::face, scene::UvLayout::atlas, scene::UvLayout::layout2017}) {
            const generator::Mesh mesh = generator::generate(call, assets, uv);
            checkMesh(mesh);
            require(mesh.triangles() <= most, "more triangles than were counted");
        }
        reached(call.entry->name);
    } catch (const Error& error) {
        checkError(error);
    }
}

void refine(const ShapeCall& call, const scene::Assets& assets) {
    scene::Model model;
    model.source = {scene::ModelSource::Kind::shape, "", call};
    if (!generator::isAdaptive(model)) return;
    for (const double error : {1e-12, 0.25, 1e12}) {
        try {
            const ShapeCall fine = generator::refine(model, assets, {error, 8});
            require(generator::countTriangles(fine, assets) > 0, "refined to nothing");
            reached("refined " + fine.entry->name);
        } catch (const Error& fault) {
            checkError(fault);
        }
    }
}

void tryWords(const Words& words, const scene::Assets& assets) {
    try {
        const ShapeCall call = generator::parseCall(words);
        if (!call.entry->takesFile || generator::isOneWord(call.file))
            require(generator::parseCall(generator::splitWords(generator::textOf(call))) == call,
                    "a call's text is another call");
        make(call, assets);
        refine(call, assets);
    } catch (const Error& error) {
        checkError(error);
    }
}

}  // namespace

const Target& target() {
    static const Target made = [] {
        Target out{{"txt"}, {"auto", "p.ply", "t.patch", "teapot.patch", "missing.ply"}, 512};
        for (const generator::ShapeEntry& shape : generator::shapes()) {
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
        tryWords(words, assets);
        if (const auto named = generator::wordsOfName(command)) tryWords(*named, assets);
        try {
            Diagnostics findings;
            make(generator::parseComment(words, command, {"scene.xml", 1, 1}, findings), assets);
            checkDiagnostics(findings);
        } catch (const Error& error) {
            checkError(error);
        }
    }
    return 0;
}
