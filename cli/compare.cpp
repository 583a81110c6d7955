#include "grade/images/compare.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <vector>

#include "cli/command.h"
#include "cli/compare_meshes.h"
#include "cli/confine.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "core/text.h"
#include "grade/images/flip.h"
#include "image/format.h"
#include "image/image_file.h"

namespace farol::cli {
namespace {

struct Flags {
    std::string first, second, shape, crop, diff, heat;
    std::vector<std::string> masks;
    bool maskAxes = false;
    ConfinementFlags confinement;
};

/// A fault in the flag is one of the command line.
grade::Rectangle parseRectangle(const std::string& flag, const std::string& text) {
    try {
        return grade::readRectangle(text, flag);
    } catch (const Error& error) {
        throw UsageError(error.primary());
    }
}

image::Image decode(const std::string& bytes, const std::string& path, const std::string& crop) {
    const image::Image image = image::decodeImage(bytes, path, {path, 0, 0});
    try {
        return grade::cut(image, crop);
    } catch (const Error& error) {
        Diagnostic fault = error.primary();
        fault.where = {path, 0, 0};
        throw Error(Diagnostics{fault});
    }
}

std::string requirePng(const std::string& flag, const std::string& path) {
    if (!path.empty() && fileEnding(path) != "png")
        throw UsageError(message<"usage/compare-png">("flag"_arg = flag, "path"_arg = path));
    return path;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4f", value);
    return text;
}

/// The text in a column of that many characters: on its left, or on its right.
std::string padded(const std::string& text, std::size_t width, bool isRight) {
    const auto length =
        static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
            return (static_cast<unsigned>(c) & 0xC0U) != 0x80U;
        }));
    const std::string blanks(width > length ? width - length : 0, ' ');
    return isRight ? blanks + text : text + blanks;
}

void print(const grade::Comparison& found, Language language) {
    constexpr std::size_t kName = 12, kColumn = 15;
    const auto row = [&](const Message& name, const std::string& plain,
                         const std::string& tolerant) {
        std::cout << padded(name.empty() ? "" : textIn(language, name), kName, false)
                  << padded(plain, kColumn, true) << padded(tolerant, kColumn, true) << "\n";
    };
    std::cout << textIn(language, message<"part.compare/size">("width"_arg = found.width,
                                                               "height"_arg = found.height))
              << "\n";
    row({}, textIn(language, message<"part.compare/same">()),
        textIn(language, message<"part.compare/least">()));
    row(message<"part.compare/mean">(), number(found.meanLevels), number(found.tolerantMeanLevels));
    row(message<"part.compare/max">(), number(found.maxLevels), number(found.tolerantMaxLevels));
    for (std::size_t i = 0; i < grade::kLevels.size(); ++i)
        row(message<"part.compare/within">("levels"_arg = grade::kLevels[i]),
            number(100.0 * found.within[i]), number(100.0 * found.tolerantWithin[i]));
    std::cout << textIn(language,
                        message<"part.compare/summary">(
                            "psnr"_arg = number(found.psnrDb),
                            "ssim"_arg = found.ssim ? number(*found.ssim) : "-",
                            "mean"_arg = number(found.flip.mean),
                            "median"_arg = number(found.flip.median),
                            "upper"_arg = number(found.flip.p95),
                            "top"_arg = number(found.flip.p99), "max"_arg = number(found.flip.max)))
              << std::endl;
    if (found.counted < 1.0)
        std::cout << textIn(language, message<"part.compare/counted">(
                                          "share"_arg = number(100.0 * found.counted)))
                  << std::endl;
}

int compare(const Flags& flags, const image::Image& first, const image::Image& second,
            const std::vector<grade::Rectangle>& hidden, Report& report, Outputs& outputs) {
    grade::requireSameSize(first.width, first.height, second.width, second.height);
    grade::Mask mask;
    grade::hide(mask, first.width, first.height, hidden);
    if (flags.maskAxes) grade::hideAxes(mask, first, second);
    const auto [found, shown] = grade::compare(first, second, mask);
    if (!flags.diff.empty()) outputs.write(0, image::encodePng(shown));
    if (!flags.heat.empty())
        outputs.write(1, image::encodePng(grade::heatMap(
                             grade::flip(grade::FloatImage(first), grade::FloatImage(second)))));
    report.merge(parseJson(grade::toJson(found), grade::kComparisonJson));
    if (!report.json()) print(found, report.language());
    return kDone;
}

int run(const Flags& flags, Report& report) {
    if (isMeshComparison(flags.first, flags.shape))
        return compareMeshes({flags.first, flags.second, flags.shape, flags.confinement}, report);
    if (flags.second.empty()) throw UsageError(message<"usage/compare">());
    requirePng("--diff", flags.diff);
    requirePng("--heat", flags.heat);
    std::vector<grade::Rectangle> hidden;
    for (const std::string& text : flags.masks) hidden.push_back(parseRectangle("--mask", text));
    if (!flags.crop.empty() && flags.crop != "auto") parseRectangle("--crop", flags.crop);
    const std::string first = readInput(flags.first), second = readInput(flags.second);
    const Confinement confinement{flags.confinement, {}, {flags.diff, flags.heat}};
    return confine(confinement, report, [&](Outputs& outputs) {
        return compare(flags, decode(first, flags.first, flags.crop),
                       decode(second, flags.second, flags.crop), hidden, report, outputs);
    });
}

}  // namespace

void addCompare(CLI::App& root, Action& action) {
    CLI::App* command =
        root.add_subcommand("compare", "Compares two images of one size, or two meshes");
    const auto flags = std::make_shared<Flags>();
    command->add_option("A", flags->first, "an image file, or a mesh file")
        ->type_name("")
        ->required();
    command->add_option("B", flags->second, "the same to compare with; of a mesh the expected one")
        ->type_name("");
    command
        ->add_option("--shape", flags->shape,
                     "the expected mesh, as farol generate takes it: \"sphere 1 10 10\"")
        ->type_name("CALL");
    command
        ->add_option("--crop", flags->crop,
                     "px from the top left: cuts each image that is not WxH yet; auto: cuts "
                     "the frame and the title bar off a screenshot")
        ->type_name("WxH+X+Y|auto");
    command->add_option("--mask", flags->masks, "px: a part that does not count (repeatable)")
        ->type_name("WxH+X+Y")
        ->allow_extra_args(false);
    command->add_flag("--mask-axes", flags->maskAxes,
                      "coordinate axes and the pixels around them do not count");
    command->add_option("--heat", flags->heat, "writes FLIP as a .png, from black (0) to white (1)")
        ->type_name("FILE");
    command->add_option("--diff", flags->diff, "writes a .png that shows where they differ")
        ->type_name("FILE");
    addConfinement(*command, flags->confinement);
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
