#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <vector>

#include "cli/command.h"
#include "cli/files.h"
#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "generator/words.h"
#include "scene/assets.h"

namespace farol::cli {
namespace {

constexpr const char* kUsageLine = "farol generate SHAPE ARGS... OUT, or farol generate IN OUT";
constexpr const char* kEndings =
    "a file to write that ends with .3d, .obj, .ply or .3db (or - for stdout)";

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string helpOf(const generator::Shape& shape) {
    std::ostringstream text;
    text << "  " << generator::usageOf(shape) << "\n      " << shape.summary << "\n";
    for (const generator::Argument& one : shape.arguments)
        text << "      " << upper(one.name) << ": " << one.help << "; "
             << (one.integer ? "a whole number " : "") << one.min << ".." << one.max << "\n";
    return text.str();
}

std::string allShapes() {
    std::string text =
        "Shapes, with their arguments in order (those in brackets may be left out):\n";
    for (const generator::Shape& shape : generator::shapes()) text += helpOf(shape);
    return text +
           "\nA mesh file (.3d .obj .ply .stl .off .tri .3db) in the place of the shape is "
           "converted.";
}

/// Words that no flag took. Numbers may be negative: the shape says whether it takes them.
std::vector<std::string> wordsOf(const CLI::App& command) {
    const std::vector<std::string> words = command.remaining();
    for (const std::string& word : words)
        if (word.size() > 1 && word[0] == '-' &&
            (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0))
            throw UsageError("generate takes no option " + word + " (" + kUsageLine + ")");
    if (words.size() < 2) throw UsageError(std::string("too few words: ") + kUsageLine);
    return words;
}

generator::Mesh convert(const std::string& path, Report& report) {
    Diagnostics findings;
    generator::Mesh mesh = generator::io::decodeMesh(readInput(path), path, findings);
    report.add(findings);
    return mesh;
}

/// A profile or patch file may lie anywhere; the generator looks it up by name in its folder.
generator::Mesh make(std::vector<std::string> words, scene::UvLayout uv, Report& report) {
    try {
        Diagnostics findings;
        words = generator::wordsOfComment(words, "", {}, findings);
        report.add(findings);
    } catch (const Error&) {
        // As written, the words tell better what is wrong with them.
    }
    const generator::Shape* shape = generator::findShape(words.front());
    std::string folder = ".";
    if (shape != nullptr && shape->takesFile && words.size() > 1) {
        folder = folderOf(words[1]);
        words[1] = std::filesystem::path(words[1]).filename().string();
    }
    try {
        return generator::generate(words, scene::FolderAssets(folder), uv);
    } catch (const Error& error) {
        // The words are the command line, so the fault is in its use.
        if (error.code().rfind("shape.", 0) == 0 || error.code() == "limit.triangles")
            throw UsageError(error.what(), error.code());
        throw;
    }
}

scene::UvLayout layoutOf(const std::string& name) {
    if (name == "atlas") return scene::UvLayout::atlas;
    return name == "2017" ? scene::UvLayout::layout2017 : scene::UvLayout::face;
}

int run(const CLI::App& command, const std::string& uv, Report& report) {
    std::vector<std::string> words = wordsOf(command);
    const std::string output = words.back();
    words.pop_back();
    const bool converts = words.size() == 1 && generator::isMeshName(words.front()) &&
                          generator::findShape(words.front()) == nullptr;
    using generator::io::Format;
    const auto format =
        output == "-" ? std::optional(Format::text3d) : generator::io::formatOf(output);
    if (output == "-" && report.json())
        throw UsageError("--json and - would both write to standard output");
    if (!format) throw UsageError("\"" + output + "\" is the last word, which must be " + kEndings);
    if (converts && !uv.empty())
        throw UsageError("--uv lays out shapes; a mesh file keeps its own texture coordinates");
    const generator::Mesh mesh =
        converts ? convert(words.front(), report) : make(words, layoutOf(uv), report);
    writeOutput(output, generator::io::encodeMesh(mesh, *format));
    report.set("output", output);
    report.set("vertices", mesh.positions.size());
    report.set("triangles", mesh.triangles());
    if (!report.json() && output != "-")
        std::cout << output << ": " << mesh.positions.size() << " vertices, " << mesh.triangles()
                  << " triangles" << std::endl;
    return kDone;
}

}  // namespace

void addGenerate(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("generate", "Writes the mesh of a shape");
    const auto uv = std::make_shared<std::string>();
    command->description(std::string("Writes the mesh of a shape: ") + kUsageLine);
    command
        ->add_option("--uv", *uv,
                     "texture coordinates: a whole picture a face, or one picture "
                     "around the shape, or as the 2017 engine; default face")
        ->type_name("LAYOUT")
        ->check(CLI::IsMember({"face", "atlas", "2017"}));
    command->footer(allShapes);
    command->allow_extras();
    command->callback([&action, command, uv] {
        action = [command, uv](Report& report) { return run(*command, *uv, report); };
    });
}

}  // namespace farol::cli
