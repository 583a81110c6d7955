#include "grade/compare.h"

#include <charconv>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/files.h"
#include "render/encode.h"
#include "render/image_file.h"

namespace farol::cli {
namespace {

struct Flags {
    std::string first, second, crop, diff;
};

struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;
};

Rectangle parseCrop(const std::string& text) {
    Rectangle wanted;
    const char *at = text.data(), *end = at + text.size();
    const auto number = [&](char before, int& value) {
        if (before != '\0' && (at == end || *at++ != before)) return false;
        const auto [next, error] = std::from_chars(at, end, value);
        at = next;
        return error == std::errc();
    };
    if (!number('\0', wanted.width) || !number('x', wanted.height) || !number('+', wanted.x) ||
        !number('+', wanted.y) || at != end)
        throw UsageError("--crop " + text + ": takes WxH+X+Y, as in 512x512+1+31");
    return wanted;
}

render::Image open(const std::string& path, const std::optional<Rectangle>& wanted) {
    const render::Image image = render::decodeImage(readInput(path), path, {path, 0, 0});
    if (!wanted || (image.width == wanted->width && image.height == wanted->height)) return image;
    try {
        return grade::crop(image, wanted->x, wanted->y, wanted->width, wanted->height);
    } catch (const Error& error) {
        throw Error(error.code(), error.what(), {path, 0, 0});
    }
}

nlohmann::json shares(const std::array<double, grade::kLevels.size()>& within) {
    nlohmann::json all;
    for (std::size_t i = 0; i < within.size(); ++i)
        all.push_back({{"levels", grade::kLevels[i]}, {"share", within[i]}});
    return all;
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
    row("PSNR, dB", found.psnrDb, found.psnrDb);
    std::cout << std::flush;
}

int run(const Flags& flags, Report& report) {
    std::optional<Rectangle> wanted;
    if (!flags.crop.empty()) wanted = parseCrop(flags.crop);
    if (!flags.diff.empty() && endingOf(flags.diff) != "png")
        throw UsageError("--diff " + flags.diff + ": must end with .png");
    const render::Image first = open(flags.first, wanted), second = open(flags.second, wanted);
    const auto [found, shown] = grade::compare(first, second);
    if (!flags.diff.empty()) writeOutput(flags.diff, render::encodePng(shown));
    report.set("width", found.width);
    report.set("height", found.height);
    report.set("mean", found.meanLevels);
    report.set("max", found.maxLevels);
    report.set("within", shares(found.within));
    report.set("psnr", std::isfinite(found.psnrDb) ? nlohmann::json(found.psnrDb) : nullptr);
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
                     "px from the top left: cuts each picture that is not WxH yet")
        ->type_name("WxH+X+Y");
    command->add_option("--diff", flags->diff, "writes a .png that shows where they differ")
        ->type_name("FILE");
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
