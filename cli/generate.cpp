#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#include "cli/command.h"
#include "cli/confine.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "generator/words.h"
#include "scene/files/assets.h"

namespace farol::cli {
namespace {

constexpr const char* kUsageLine = "farol generate SHAPE ARGS... OUT";
constexpr const char* kEndings = "a name that ends with .3d, .obj, .ply or .3db, or - for stdout";

struct Flags {
    std::string uv;
    ConfinementFlags confinement;
};

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string helpOf(const generator::ShapeEntry& shape) {
    std::ostringstream text;
    text << "  " << generator::usageOf(shape) << "\n      " << shape.summary << "\n";
    for (const generator::Argument& one : shape.arguments)
        text << "      " << upper(one.name) << ": " << one.help << "; "
             << (one.isInteger() ? "a whole number " : "") << one.min << ".." << one.max << "\n";
    return text.str();
}

std::string allShapes() {
    std::string text =
        "Shapes, with their arguments in order (those in brackets may be left out):\n";
    for (const generator::ShapeEntry& shape : generator::shapes()) text += helpOf(shape);
    return text;
}

/// Returns the words that are no flags. Numbers may be negative: the shape checks them.
std::vector<std::string> wordsOf(const CLI::App& command) {
    const std::vector<std::string> words = command.remaining();
    for (const std::string& word : words)
        if (word.size() > 1 && word[0] == '-' &&
            (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0))
            throw UsageError(message<"usage/generate-option">("option"_arg = word,
                                                              "usage"_arg = uncut(kUsageLine)));
    if (words.size() < 2)
        throw UsageError(message<"usage/generate">("usage"_arg = uncut(kUsageLine)));
    return words;
}

/// Runs a step that parses the shape's words. They are arguments: reports faults as UsageError.
template <typename Step>
auto asUsage(Step step) {
    try {
        return step();
    } catch (const Error& error) {
        if (error.code().rfind("shape.", 0) == 0 || error.code() == "limit.triangles")
            throw UsageError(error.primary());
        throw;
    }
}

/// A shape, and the folder of the profile or patch file that it names.
struct LocatedCall {
    generator::ShapeCall call;
    std::string folder = ".";
};

generator::ShapeCall parse(const std::vector<std::string>& words, Report& report) {
    try {
        Diagnostics findings;
        generator::ShapeCall call = generator::parseComment(words, "", {}, findings);
        // A scene's slips are repaired; a command can be typed again.
        const bool slip = std::any_of(findings.begin(), findings.end(), [](const Diagnostic& one) {
            return one.code == "shape.argument";
        });
        if (slip) call = generator::parseCall(words);
        report.add(findings);
        return call;
    } catch (const Error&) {
        return generator::parseCall(words);  // the words as written give a clearer error
    }
}

/// A profile or patch file may lie anywhere; the generator looks it up by name in its folder.
LocatedCall locate(generator::ShapeCall call) {
    LocatedCall located{std::move(call)};
    if (located.call.entry->takesFile) {
        std::string& file = located.call.file;
        located.folder = folderOf(file);
        file = std::filesystem::path(file).filename().string();
    }
    return located;
}

scene::UvLayout layoutOf(const std::string& name) {
    if (name == "atlas") return scene::UvLayout::atlas;
    return name == "2017" ? scene::UvLayout::layout2017 : scene::UvLayout::face;
}

int write(const generator::Mesh& mesh, generator::io::Format format, const std::string& path,
          Report& report, Outputs& outputs) {
    outputs.write(0, generator::io::encodeMesh(mesh, format));
    report.set("output", path);
    report.set("vertices", mesh.positions().size());
    report.set("triangles", mesh.triangles());
    if (!report.json() && path != "-")
        std::cout << path << ": " << mesh.positions().size() << " vertices, " << mesh.triangles()
                  << " triangles" << std::endl;
    return kDone;
}

int run(const CLI::App& command, const Flags& flags, Report& report) {
    std::vector<std::string> words = wordsOf(command);
    const std::string output = words.back();
    words.pop_back();
    using generator::io::Format;
    const auto format =
        output == "-" ? std::optional(Format::text3d) : generator::io::formatOf(output);
    if (output == "-" && report.json())
        throw UsageError(message<"usage/output-twice">("output"_arg = "-"));
    if (!format)
        throw UsageError(
            message<"usage/generate-format">("path"_arg = output, "known"_arg = uncut(kEndings)));
    Confinement confinement{flags.confinement, {}, {output}};
    const LocatedCall shape = locate(asUsage([&] { return parse(words, report); }));
    confinement.readable = {shape.folder};
    return confine(confinement, report, [&](Outputs& outputs) {
        const generator::Mesh mesh = asUsage([&] {
            return generator::generate(shape.call, scene::FolderAssets(shape.folder),
                                       layoutOf(flags.uv));
        });
        return write(mesh, *format, output, report, outputs);
    });
}

}  // namespace

void addGenerate(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("generate", "Writes the mesh of a shape");
    const auto flags = std::make_shared<Flags>();
    command->description(std::string("Writes the mesh of a shape: ") + kUsageLine);
    command
        ->add_option("--uv", flags->uv,
                     "texture coordinates: a whole image a face, or one image "
                     "around the shape, or as the 2017 engine; default face")
        ->type_name("LAYOUT")
        ->check(CLI::IsMember({"face", "atlas", "2017"}));
    addConfinement(*command, flags->confinement);
    command->footer(allShapes);
    command->allow_extras();
    command->callback([&action, command, flags] {
        action = [command, flags](Report& report) { return run(*command, *flags, report); };
    });
}

}  // namespace farol::cli
