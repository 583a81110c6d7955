#include "grade/compare.h"

#include <charconv>
#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

#include "cli/command.h"
#include "cli/files.h"
#include "grade/client_area.h"
#include "grade/flip.h"
#include "render/encode.h"
#include "render/image_file.h"

namespace farol::cli {
namespace {

struct Flags {
    std::string first, second, crop, diff, heat;
    std::vector<std::string> masks;
    bool maskAxes = false;
};

grade::Rectangle parseRectangle(const std::string& flag, const std::string& text) {
    grade::Rectangle wanted;
    const char *at = text.data(), *end = at + text.size();
    const auto number = [&](char before, int& value) {
        if (before != '\0' && (at == end || *at++ != before)) return false;
        const auto [next, error] = std::from_chars(at, end, value);
        at = next;
        return error == std::errc();
    };
    if (!number('\0', wanted.width) || !number('x', wanted.height) || !number('+', wanted.x) ||
        !number('+', wanted.y) || at != end)
        throw UsageError(flag + " " + text + ": takes WxH+X+Y, as in 512x512+1+31");
    return wanted;
}

/// Takes the part that `text` names; "auto": the client area of a window.
render::Image cut(const render::Image& image, const std::string& text, const std::string& path) {
    if (text.empty()) return image;
    if (text == "auto") return grade::crop(image, grade::clientArea(image));
    const grade::Rectangle wanted = parseRectangle("--crop", text);
    if (image.width == wanted.width && image.height == wanted.height) return image;
    try {
        return grade::crop(image, wanted);
    } catch (const Error& error) {
        throw Error(error.code(), error.what(), {path, 0, 0});
    }
}

render::Image open(const std::string& path, const std::string& crop) {
    return cut(render::decodeImage(readInput(path), path, {path, 0, 0}), crop, path);
}

std::string requirePng(const std::string& flag, const std::string& path) {
    if (!path.empty() && endingOf(path) != "png")
        throw UsageError(flag + " " + path + ": must end with .png");
    return path;
}

nlohmann::json shares(const std::array<double, grade::kLevels.size()>& within) {
    nlohmann::json all;
    for (std::size_t i = 0; i < within.size(); ++i)
        all.push_back({{"levels", grade::kLevels[i]}, {"share", within[i]}});
    return all;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4f", value);
    return text;
}

void print(const grade::Comparison& found) {
    std::cout << found.width << "x" << found.height << " pixels; levels are of 255\n"
              << "                 same pixel   least of 3x3\n";
    const auto row = [](const std::string& name, double plain, double tolerant) {
        char line[96];
        std::snprintf(line, sizeof line, "%-12s %14.4f %14.4f\n", name.c_str(), plain, tolerant);
        std::cout << line;
    };
    row("mean", found.meanLevels, found.tolerantMeanLevels);
    row("max", found.maxLevels, found.tolerantMaxLevels);
    for (std::size_t i = 0; i < grade::kLevels.size(); ++i)
        row("% within " + std::to_string(grade::kLevels[i]), 100.0 * found.within[i],
            100.0 * found.tolerantWithin[i]);
    std::cout << "PSNR " << number(found.psnrDb) << " dB, SSIM "
              << (found.ssim ? number(*found.ssim) : "-") << ", FLIP mean "
              << number(found.flip.mean) << ", median " << number(found.flip.median) << ", p95 "
              << number(found.flip.p95) << ", p99 " << number(found.flip.p99) << ", max "
              << number(found.flip.max) << std::endl;
    if (found.counted < 1.0)
        std::cout << number(100.0 * found.counted) << " % of the pixels count" << std::endl;
}

int run(const Flags& flags, Report& report) {
    requirePng("--diff", flags.diff);
    requirePng("--heat", flags.heat);
    std::vector<grade::Rectangle> hidden;
    for (const std::string& text : flags.masks) hidden.push_back(parseRectangle("--mask", text));
    if (!flags.crop.empty() && flags.crop != "auto") parseRectangle("--crop", flags.crop);
    const render::Image first = open(flags.first, flags.crop),
                        second = open(flags.second, flags.crop);
    grade::requireSameSize(first.width, first.height, second.width, second.height);
    grade::Mask mask;
    grade::hide(mask, first.width, first.height, hidden);
    if (flags.maskAxes) grade::hideAxes(mask, first, second);
    const auto [found, shown] = grade::compare(first, second, mask);
    if (!flags.diff.empty()) writeOutput(flags.diff, render::encodePng(shown));
    if (!flags.heat.empty())
        writeOutput(flags.heat, render::encodePng(grade::heatMap(grade::flip(
                                    grade::FloatImage(first), grade::FloatImage(second)))));
    report.set("width", found.width);
    report.set("height", found.height);
    report.set("mean", found.meanLevels);
    report.set("max", found.maxLevels);
    report.set("within", shares(found.within));
    report.set("psnr", std::isfinite(found.psnrDb) ? nlohmann::json(found.psnrDb) : nullptr);
    report.set("ssim", found.ssim ? nlohmann::json(*found.ssim) : nullptr);
    report.set("flip", {{"mean", found.flip.mean},
                        {"median", found.flip.median},
                        {"p95", found.flip.p95},
                        {"p99", found.flip.p99},
                        {"max", found.flip.max}});
    report.set("counted", found.counted);
    report.set("tolerant", {{"mean", found.tolerantMeanLevels},
                            {"max", found.tolerantMaxLevels},
                            {"within", shares(found.tolerantWithin)}});
    if (!report.json()) print(found);
    return kDone;
}

}  // namespace

void addCompare(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("compare", "Says how two pictures of one size differ");
    const auto flags = std::make_shared<Flags>();
    command->add_option("A", flags->first, "a picture file")->type_name("")->required();
    command->add_option("B", flags->second, "a picture file")->type_name("")->required();
    command
        ->add_option("--crop", flags->crop,
                     "px from the top left: cuts each picture that is not WxH yet; auto: cuts "
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
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
