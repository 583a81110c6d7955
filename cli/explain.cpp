#include <cmath>
#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/confine.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "cli/source.h"
#include "core/text.h"
#include "grade/requirements/evaluate.h"
#include "grade/rubric/rubric.h"
#include "render/prepare.h"

namespace farol::cli {
namespace {

struct Flags {
    std::string rubric, scene, assets;
    ConfinementFlags confinement;
};

std::string rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string placeOf(const Location& where) {
    if (where.line <= 0) return where.file.empty() ? "" : where.file + ": ";
    return where.file + ":" + std::to_string(where.line) + ": ";
}

nlohmann::json toJson(const grade::RequiredThing& thing) {
    nlohmann::json out{{"who", thing.who}};
    if (!thing.reason.empty()) out["message"] = thing.reason;
    if (!thing.where.file.empty()) out["file"] = thing.where.file;
    if (thing.where.line > 0) out["line"] = thing.where.line;
    return out;
}

nlohmann::json toJson(const grade::ExplainedObject& object) {
    nlohmann::json out = toJson(object.thing);
    out["shape"] = object.shape;
    if (!object.image.empty()) out["image"] = object.image;
    out["depth"] = object.depth;
    out["radius"] = object.radius;
    out["moves"] = object.moves;
    out["pixels"] = object.pixels;
    if (object.orbitRadius) out["orbit"] = *object.orbitRadius;
    if (object.periodS) out["period"] = *object.periodS;
    return out;
}

template <typename Things>
nlohmann::json listOf(const Things& things) {
    nlohmann::json out = nlohmann::json::array();
    for (const auto& thing : things) out.push_back(toJson(thing));
    return out;
}

void print(const grade::ExplainedObject& object) {
    std::cout << "  " << placeOf(object.thing.where) << object.thing.who << ": " << object.shape
              << ", radius " << rounded(object.radius) << ", in " << object.depth << " groups"
              << (object.moves ? ", moves" : ", stands still");
    if (!object.image.empty()) std::cout << ", image " << object.image;
    if (object.orbitRadius)
        std::cout << ", orbit " << rounded(*object.orbitRadius) << " in "
                  << rounded(object.periodS.value_or(0.0)) << " s";
    std::cout << ", pixels "
              << joined(object.pixels, " ", [](int pixels) { return std::to_string(pixels); })
              << "\n";
}

void printMisses(const std::vector<grade::RequiredThing>& misses) {
    for (const grade::RequiredThing& miss : misses)
        std::cout << "  no: " << placeOf(miss.where) << miss.who << " " << miss.reason << "\n";
}

int explain(const render::Job& job, const grade::Rubric& rubric, Report& report) {
    render::Renderer renderer;
    constexpr std::size_t kMeshBytes = std::size_t{128} << 20U;
    render::MeshLibrary meshes(kMeshBytes);
    const auto prepared = std::make_shared<const render::Prepared>(render::prepare(job));
    report.add(prepared->diagnostics);
    grade::Requirements selectors(rubric, renderer, meshes, prepared, job);
    grade::Requirements requirements(rubric, renderer, meshes, prepared, job);
    const std::vector<grade::ExplainedSelector> all = selectors.explain();
    const std::vector<grade::RequirementGrade> grades = requirements.grade();
    nlohmann::json objects = nlohmann::json::array(), results = nlohmann::json::array();
    for (const grade::ExplainedSelector& one : all)
        objects.push_back({{"id", one.id},
                           {"kind", one.isDefinition ? "define" : "requirement"},
                           {"count", one.count},
                           {"matches", listOf(one.objects)},
                           {"misses", listOf(one.misses)}});
    for (const grade::RequirementGrade& one : grades)
        results.push_back({{"id", one.id},
                           {"text", one.text},
                           {"state", grade::kMetWords[one.met]},
                           {"points", one.points},
                           {"most", one.most},
                           {"reason", one.reason},
                           {"matches", listOf(one.matches)},
                           {"misses", listOf(one.misses)}});
    report.set("times", selectors.timesS());
    report.set("selectors", std::move(objects));
    report.set("requirements", std::move(results));
    if (report.json()) return kDone;
    std::cout << "times "
              << joined(selectors.timesS(), " ", [](double timeS) { return rounded(timeS); })
              << " s\n";
    for (const grade::ExplainedSelector& one : all) {
        std::cout << "\n"
                  << one.id << (one.isDefinition ? " (define)" : "") << ": " << one.count
                  << (one.count == 1 ? " object\n" : " objects\n");
        for (const grade::ExplainedObject& object : one.objects) print(object);
        printMisses(one.misses);
    }
    std::cout << "\n";
    for (const grade::RequirementGrade& one : grades) {
        std::cout << grade::kMetWords[one.met] << "  " << rounded(one.points) << " / "
                  << rounded(one.most) << "  " << one.id << ": " << one.text << " (" << one.reason
                  << ")\n";
        for (const grade::RequiredThing& match : one.matches)
            std::cout << "  yes: " << placeOf(match.where) << match.who << "\n";
        printMisses(one.misses);
    }
    std::cout << std::flush;
    return kDone;
}

int run(const Flags& flags, Report& report) {
    const grade::Rubric rubric = grade::readRubric(readInput(flags.rubric), flags.rubric);
    if (rubric.requirements.empty() && rubric.definitions.empty())
        throw UsageError(message<"usage/explain">("path"_arg = uncut(flags.rubric)));
    render::Job job = openSource(flags.scene, flags.assets, false);
    job.options.missing = render::Missing::placeholder;
    report.setInput(job.name);
    const Confinement confinement{flags.confinement, {assetFolder(flags.scene, flags.assets)}, {}};
    return confine(confinement, report, [&](Outputs&) { return explain(job, rubric, report); });
}

}  // namespace

void addExplain(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand(
        "explain", "Shows what each selector of a rubric matches in a scene, and what is measured");
    const auto flags = std::make_shared<Flags>();
    command->add_option("RUBRIC", flags->rubric, "a rubric with requirements, .json")
        ->type_name("")
        ->required();
    command->add_option("SCENE", flags->scene, "an .xml scene, or - for stdin")
        ->type_name("")
        ->required();
    command
        ->add_option("--assets", flags->assets,
                     "folder of the files that the scene names; default the scene's own")
        ->type_name("DIR");
    addConfinement(*command, flags->confinement);
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
