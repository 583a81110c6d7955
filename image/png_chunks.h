#pragma once

#include <cstdint>
#include <string>

#include "image/image.h"

/// The pieces of a PNG file (Portable Network Graphics Specification, W3C, 2nd and 3rd edition),
/// shared by still and animated pictures.
namespace farol::image::png {

void appendU16(std::string& out, std::uint32_t value);
void appendU32(std::string& out, std::uint32_t value);

/// Begins a chunk and returns where; its length is filled in by finishChunk.
std::size_t beginChunk(std::string& out, const char* type);
void finishChunk(std::string& out, std::size_t begin);

/// Signature and IHDR, 8 bits a channel; channels 3 (RGB) or 4 (RGBA).
void appendHeader(std::string& out, int width, int height, int channels);
/// Returns the image's rows, filtered and deflated, without a chunk around them. Leaves out alpha
/// if `channels` is 3.
void appendPixels(std::string& out, const Image& image, int channels);

}  // namespace farol::image::png
