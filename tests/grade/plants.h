#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "sheet.h"

/// Shared by plants.
namespace farol::test {

using Share = std::optional<double>;

/// The share of models below the innermost group around the line.
inline double shareOf(const Sheet& sheet, std::size_t line) {
    std::size_t all = 0;
    for (std::size_t i = 0; i < sheet.size(); ++i) all += sheet.is(i, "model") ? 1 : 0;
    const std::size_t group = sheet.groupOf(line);
    const std::size_t touched = group < sheet.size() ? sheet.models(group) : all;
    return static_cast<double>(touched) / static_cast<double>(std::max<std::size_t>(1, all));
}

/// The share of one model.
inline double oneModel(const Sheet& sheet) {
    std::size_t all = 0;
    for (std::size_t i = 0; i < sheet.size(); ++i) all += sheet.is(i, "model") ? 1 : 0;
    return 1.0 / static_cast<double>(std::max<std::size_t>(1, all));
}

/// Changes one free element of a tag that `change` accepts.
template <typename Change>
Share changeOne(Sheet& sheet, Dice& dice, int plant, const std::string& tag, Change change) {
    std::vector<std::size_t> lines = sheet.free(tag);
    while (!lines.empty()) {
        const std::size_t at = dice.below(lines.size());
        const std::size_t line = lines[at];
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
        if (!change(line)) continue;
        sheet.mark(line, plant);
        return shareOf(sheet, line);
    }
    return {};
}

/// Plants of transforms, groups and what moves.
std::vector<Plant> placePlants();
/// Plants of lights, materials, textures and the camera.
std::vector<Plant> dressPlants();
/// Plants of shapes and meshes.
std::vector<Plant> meshPlants();

}  // namespace farol::test
