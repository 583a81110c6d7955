#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include "cli/command.h"
#include "cli/confine.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "cli/source.h"
#include "core/text.h"
#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "interchange/write.h"

namespace farol::cli {
namespace {

constexpr const char* kEndings =
    ".glb, .obj or .xml of a scene, or .3d, .obj, .ply, .3db or .glb of a mesh file";

struct Flags {
    std::string input, output, assets, form;
    double timeS = 0.0;
    bool strict = false;
    ConfinementFlags confinement;
};

/// Files of a written model. Those beside it have its name.
struct Places {
    std::string stem;                  ///< of the output without folder and ending
    std::vector<std::string> outputs;  ///< the output, a library, numbered images
};

/// Notes which files are read.
class NotedAssets final : public scene::Assets {
  public:
    explicit NotedAssets(std::shared_ptr<const scene::Assets> assets)
        : assets_(std::move(assets)) {}
    std::set<std::string> names() const {
        const std::lock_guard lock(mutex_);
        return names_;
    }
    std::vector<std::string> list() const override { return assets_->list(); }
    bool has(const std::string& path) const override { return assets_->has(path); }
    std::optional<std::string> read(const std::string& path) const override {
        const std::lock_guard lock(mutex_);
        names_.insert(path);
        return assets_->read(path);
    }
    std::optional<std::uint64_t> size(const std::string& path) const override {
        return assets_->size(path);
    }
    void prefetch(const std::vector<std::string>& paths) const override {
        assets_->prefetch(paths);
    }
    std::string version(const std::string& path) const override { return assets_->version(path); }

  private:
    std::shared_ptr<const scene::Assets> assets_;
    mutable std::mutex mutex_;
    mutable std::set<std::string> names_;
};

/// Throws UsageError where one of the files to write is one that the scene reads. Paths are
/// compared as text: the process that writes cannot look at folders.
void refuseOwnFiles(const std::set<std::string>& names, const std::filesystem::path& folder,
                    const std::filesystem::path& output,
                    const std::vector<interchange::SideFile>& beside) {
    std::vector<std::filesystem::path> written{output};
    for (const interchange::SideFile& file : beside)
        written.push_back(output.parent_path() / file.name);
    for (const std::string& name : names)
        for (const std::filesystem::path& path : written)
            if ((folder / name).lexically_normal() == path)
                throw UsageError(message<"usage/convert-own">("path"_arg = name));
}

/// Absolute and without links, also of a file that is not there yet.
std::filesystem::path plainPath(const std::string& path) {
    std::error_code none;  // what cannot be resolved stays as it is
    const std::filesystem::path plain =
        std::filesystem::weakly_canonical(std::filesystem::absolute(path, none), none);
    return plain.empty() ? std::filesystem::path(path) : plain;
}

Places placesOf(const std::string& output, bool hasFilesBeside) {
    const std::filesystem::path path(output);
    Places places{path.stem().string(), {output}};
    if (!hasFilesBeside) return places;
    const std::string base = (path.parent_path() / path.stem()).string();
    places.outputs.insert(places.outputs.end(),
                          {base + ".mtl", base + "-%d.png", base + "-%d.jpg"});
    return places;
}

void writeBeside(const std::vector<interchange::SideFile>& files, Outputs& outputs) {
    constexpr std::size_t kLibrary = 1, kPng = 2, kJpeg = 3;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string ending = fileEnding(files[i].name);
        const std::size_t place = ending == "mtl" ? kLibrary : ending == "png" ? kPng : kJpeg;
        // The images follow the library, from number 0.
        outputs.write(place, files[i].bytes, i == 0 ? kNoFrame : static_cast<int>(i) - 1);
    }
}

int convertMesh(const Flags& flags, generator::io::Format format, Report& report) {
    const Confinement confinement{flags.confinement, {}, {flags.output}};
    return confine(confinement, report, [&, bytes = readInput(flags.input)](Outputs& outputs) {
        Diagnostics findings;
        const generator::Mesh mesh = generator::io::decodeMesh(bytes, flags.input, findings);
        report.add(findings);
        outputs.write(0, generator::io::encodeMesh(mesh, format));
        report.set("output", flags.output);
        report.set("vertices", mesh.positions().size());
        report.set("triangles", mesh.triangles());
        if (!report.json() && flags.output != "-")
            std::cout << flags.output << ": " << mesh.positions().size() << " vertices, "
                      << mesh.triangles() << " triangles" << std::endl;
        return kDone;
    });
}

int convertScene(const Flags& flags, const std::string& ending, Report& report) {
    render::Job job = openSource(flags.input, flags.assets, flags.strict);
    job.options.timeS = flags.timeS;
    report.setInput(job.name);
    const auto assets = std::make_shared<NotedAssets>(job.assets);
    job.assets = assets;
    const std::filesystem::path folder = plainPath(assetFolder(flags.input, flags.assets)),
                                output = plainPath(flags.output);
    const Places places = placesOf(flags.output, ending == "obj");
    const Confinement confinement{
        flags.confinement, {assetFolder(flags.input, flags.assets)}, places.outputs};
    const auto form = scene::kFormWords.find(flags.form).value_or(scene::Form::canonical);
    return confine(confinement, report, [&](Outputs& outputs) {
        const interchange::WrittenScene model =
            ending == "xml"   ? interchange::writeXml(job, form)
            : ending == "obj" ? interchange::writeObj(job, places.stem, interchange::kMaxModelBytes)
                              : interchange::writeGlb(job, interchange::kMaxModelBytes);
        if (job.archive.empty()) refuseOwnFiles(assets->names(), folder, output, model.beside);
        outputs.write(0, model.bytes);
        writeBeside(model.beside, outputs);
        report.add(model.diagnostics);
        report.set("output", flags.output);
        report.set("bytes", model.bytes.size());
        nlohmann::json beside = nlohmann::json::array();
        for (const interchange::SideFile& file : model.beside) beside.push_back(file.name);
        report.set("beside", std::move(beside));
        for (const auto& [name, count] :
             {std::pair("nodes", model.nodes), std::pair("meshes", model.meshes),
              std::pair("materials", model.materials), std::pair("textures", model.textures),
              std::pair("lights", model.lights), std::pair("triangles", model.triangles),
              std::pair("animations", model.animations)})
            if (ending != "xml") report.set(name, count);
        if (report.json() || flags.output == "-") return kDone;
        std::cout << flags.output << ": " << model.bytes.size() << " bytes";
        if (ending != "xml")
            std::cout << ", " << model.nodes << " nodes, " << model.triangles << " triangles";
        std::cout << std::endl;
        return kDone;
    });
}

int run(const Flags& flags, Report& report) {
    const bool isMesh = generator::isMeshName(flags.input);
    const std::string ending = fileEnding(flags.output);
    const bool isXml = ending == "xml" || (flags.output == "-" && !isMesh);
    if (report.json() && flags.output == "-")
        throw UsageError(message<"usage/output-twice">("output"_arg = "-"));
    std::error_code none;  // of files that are not there
    if (std::filesystem::equivalent(flags.input, flags.output, none))
        throw UsageError(message<"usage/convert-same">("path"_arg = flags.output));
    if (!flags.form.empty() && !isXml) throw UsageError(message<"usage/convert-to">());
    const auto format = flags.output == "-" ? std::optional(generator::io::Format::text3d)
                                            : generator::io::formatOf(flags.output);
    if (isMesh && format) return convertMesh(flags, *format, report);
    if (isXml && !isMesh) return convertScene(flags, "xml", report);
    if (ending == "glb" || (ending == "obj" && !isMesh)) return convertScene(flags, ending, report);
    throw UsageError(
        message<"usage/convert-format">("path"_arg = flags.output, "known"_arg = uncut(kEndings)));
}

}  // namespace

void addConvert(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand(
        "convert", "Writes a scene or mesh file in another format: glTF, OBJ, another dialect");
    const auto flags = std::make_shared<Flags>();
    command->add_option("IN", flags->input, "an .xml scene or a mesh file")
        ->type_name("")
        ->required();
    command->add_option("OUT", flags->output, std::string("the file: ") + kEndings)
        ->type_name("")
        ->required();
    command->add_option("--to", flags->form, "the dialect of an .xml; default canonical")
        ->type_name("course|2017|2020|canonical")
        ->check(CLI::IsMember({"course", "2017", "2020", "canonical"}));
    takesNumber(command->add_option("--time", flags->timeS,
                                    "the moment of .obj, and at which animations begin, s"),
                -1e9, 1e9);
    command
        ->add_option("--assets", flags->assets,
                     "folder of the files that the scene names; default the scene's own")
        ->type_name("DIR");
    command->add_flag("--strict", flags->strict, "takes warnings of the scene for errors");
    addConfinement(*command, flags->confinement);
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
