// The text forms of requests for comparisons and of their results.
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "grade/images/client_area.h"
#include "grade/images/compare.h"

namespace farol::grade {

using nlohmann::json;

namespace {

json shares(const std::array<double, kLevels.size()>& within) {
    json all = json::array();
    for (std::size_t i = 0; i < within.size(); ++i)
        all.push_back({{"levels", kLevels[i]}, {"share", within[i]}});
    return all;
}

}  // namespace

std::string toJson(const Comparison& found) {
    const json out = {{"width", found.width},
                      {"height", found.height},
                      {"mean", found.meanLevels},
                      {"max", found.maxLevels},
                      {"within", shares(found.within)},
                      {"psnr", std::isfinite(found.psnrDb) ? json(found.psnrDb) : json(nullptr)},
                      {"ssim", found.ssim ? json(*found.ssim) : json(nullptr)},
                      {"flip",
                       {{"mean", found.flip.mean},
                        {"median", found.flip.median},
                        {"p95", found.flip.p95},
                        {"p99", found.flip.p99},
                        {"max", found.flip.max}}},
                      {"counted", found.counted},
                      {"tolerant",
                       {{"mean", found.tolerantMeanLevels},
                        {"max", found.tolerantMaxLevels},
                        {"within", shares(found.tolerantWithin)}}}};
    return out.dump();
}

Rectangle readRectangle(const std::string& text, const std::string& field) {
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
        throw Error(message<"option.range/rectangle">("field"_arg = field, "value"_arg = text), {},
                    field);
    return wanted;
}

image::Image cut(const image::Image& image, const std::string& wanted) {
    if (wanted.empty()) return image;
    if (wanted == "auto") return crop(image, clientArea(image));
    const Rectangle part = readRectangle(wanted, "crop");
    if (image.width == part.width && image.height == part.height) return image;
    return crop(image, part);
}

}  // namespace farol::grade
