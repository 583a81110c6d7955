#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace farol::fuzz {

/// An image file made to be wrong, and the name that it is decoded under.
struct CraftedImage {
    std::string name, bytes;
};

/// Returns image `index` of an endless series: heads with palettes that are too short, runs past
/// the end, odd bit depths, extreme sizes and cut ends, for every format that is decoded. `seeds`
/// are whole files, of which some images are made. The same arguments give the same bytes.
CraftedImage craftImage(std::uint64_t index, const std::vector<std::string>& seeds);

}  // namespace farol::fuzz
