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

nlohmann::json toJson(const grade::RequiredThing& thing, Language language) {
    nlohmann::json out{{"who", textIn(language, thing.who)}};
    if (!thing.reason.empty()) out["message"] = textIn(language, thing.reason);
    if (!thing.where.file.empty()) out["file"] = thing.where.file;
    if (thing.where.line > 0) out["line"] = thing.where.line;
    return out;
}

nlohmann::json toJson(const grade::ExplainedObject& object, Language language) {
    nlohmann::json out = toJson(object.thing, language);
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
nlohmann::json listOf(const Things& things, Language language) {
    nlohmann::json out = nlohmann::json::array();
    for (const auto& thing : things) out.push_back(toJson(thing, language));
    return out;
}

void print(const grade::ExplainedObject& object, Language language) {
    const auto part = [&](const Message& text) { std::cout << ", " << textIn(language, text); };
    std::cout << "  " << placeOf(object.thing.where)
              << textIn(language,
                        message<"part.explain/object">(
                            "who"_arg = object.thing.who, "shape"_arg = object.shape,
                            "radius"_arg = rounded(object.radius), "depth"_arg = object.depth));
    part(object.moves ? message<"part.explain/moves">() : message<"part.explain/still">());
    if (!object.image.empty())
        part(message<"part.explain/image">("file"_arg = uncut(object.image)));
    if (object.orbitRadius)
        part(message<"part.explain/orbit">("radius"_arg = rounded(*object.orbitRadius),
                                           "seconds"_arg = rounded(object.periodS.value_or(0.0))));
    part(message<"part.explain/pixels">(
        "counts"_arg =
            uncut(joined(object.pixels, " ", [](int pixels) { return std::to_string(pixels); }))));
    std::cout << "\n";
}

Message stateOf(grade::Met met) {
    if (met == grade::Met::yes) return message<"part.explain/met">();
    return met == grade::Met::partly ? message<"part.explain/partly">()
                                     : message<"part.explain/unmet">();
}

void printMisses(const std::vector<grade::RequiredThing>& misses, Language language) {
    for (const grade::RequiredThing& miss : misses)
        std::cout << "  " << textIn(language, message<"part.explain/no">()) << ": "
                  << placeOf(miss.where) << textIn(language, miss.who) << " "
                  << textIn(language, miss.reason) << "\n";
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
    const Language language = report.language();
    nlohmann::json objects = nlohmann::json::array(), results = nlohmann::json::array();
    for (const grade::ExplainedSelector& one : all)
        objects.push_back({{"id", one.id},
                           {"kind", one.isDefinition ? "define" : "requirement"},
                           {"count", one.count},
                           {"matches", listOf(one.objects, language)},
                           {"misses", listOf(one.misses, language)}});
    for (const grade::RequirementGrade& one : grades)
        results.push_back({{"id", one.id},
                           {"text", one.text},
                           {"state", grade::kMetWords[one.met]},
                           {"points", one.points},
                           {"most", one.most},
                           {"reason", textIn(language, one.reason)},
                           {"matches", listOf(one.matches, language)},
                           {"misses", listOf(one.misses, language)}});
    report.set("times", selectors.timesS());
    report.set("selectors", std::move(objects));
    report.set("requirements", std::move(results));
    if (report.json()) return kDone;
    std::cout << textIn(
                     language,
                     message<"part.explain/times">(
                         "times"_arg = uncut(joined(selectors.timesS(), " ",
                                                    [](double timeS) { return rounded(timeS); }))))
              << "\n";
    for (const grade::ExplainedSelector& one : all) {
        const auto id = "id"_arg = one.id;
        const auto count = "count"_arg = one.count;
        std::cout << "\n"
                  << textIn(language, one.isDefinition ? message<"part.explain/define">(id, count)
                                                       : message<"part.explain/count">(id, count))
                  << "\n";
        for (const grade::ExplainedObject& object : one.objects) print(object, language);
        printMisses(one.misses, language);
    }
    std::cout << "\n";
    for (const grade::RequirementGrade& one : grades) {
        std::cout << textIn(language, stateOf(one.met)) << "  " << rounded(one.points) << " / "
                  << rounded(one.most) << "  " << one.id << ": " << one.text << " ("
                  << textIn(language, one.reason) << ")\n";
        for (const grade::RequiredThing& match : one.matches)
            std::cout << "  " << textIn(language, message<"part.explain/yes">()) << ": "
                      << placeOf(match.where) << textIn(language, match.who) << "\n";
        printMisses(one.misses, language);
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
