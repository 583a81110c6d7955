// Encoders on one picture, turn by turn: ours, libdeflate, libpng by level, JPEG, WebP.
// Milliseconds and bytes:
//   bench_encode SCENE.xml [--runs N] [name=value ...]
// A line of JSON an encoder. (OpenImageIO writes PNG by libpng at level 6.)
#include <png.h>

#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>

#include "bench/bare_loop.h"
#include "bench/measure.h"
#include "image/format.h"

using namespace farol;

namespace {

/// RGB as libpng writes it; `filters` 0 leaves its heuristic on.
std::string libpng(const image::Image& image, int level, int filters) {
    std::string out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    if (!info || setjmp(png_jmpbuf(png)) != 0) {
        png_destroy_write_struct(&png, &info);
        throw std::runtime_error("libpng failed");
    }
    png_set_write_fn(
        png, &out,
        [](png_structp writer, png_bytep bytes, std::size_t size) {
            static_cast<std::string*>(png_get_io_ptr(writer))
                ->append(reinterpret_cast<const char*>(bytes), size);
        },
        [](png_structp) {});
    png_set_compression_level(png, level);
    if (filters != 0) png_set_filter(png, PNG_FILTER_TYPE_BASE, filters);
    const auto width = static_cast<png_uint_32>(image.width);
    png_set_IHDR(png, info, width, static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER);  // the fourth byte of our pixels is dropped
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
        png_write_row(png, &image.pixels[4 * y * width]);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
}

struct Encoder {
    std::string name;
    std::function<std::string(const image::Image&)> encode;
    std::vector<double> ms = {};
    std::size_t bytes = 0;
};

}  // namespace

int main(int count, char** arguments) try {
    const bench::Arguments given = bench::Arguments::parse(count, arguments);
    const render::Job job = bench::jobOf(given);
    image::Image image;
    render::Renderer().draw(job, image);
    std::vector<Encoder> all;
    all.push_back({"farol png", image::encodePng});
    all.push_back({"libdeflate 1 Sub", [](const image::Image& i) {
                       return bench::bareEncode(i.pixels, i.width, i.height);
                   }});
    for (const int level : {1, 3, 6, 9})
        all.push_back({"libpng " + std::to_string(level),
                       [level](const image::Image& i) { return libpng(i, level, 0); }});
    all.push_back(
        {"libpng 1 Sub", [](const image::Image& i) { return libpng(i, 1, PNG_FILTER_SUB); }});
    for (const int quality : {50, 75, 90, 100}) {
        all.push_back({"jpeg " + std::to_string(quality),
                       [quality](const image::Image& i) { return image::encodeJpeg(i, quality); }});
        all.push_back({"webp " + std::to_string(quality),
                       [quality](const image::Image& i) { return image::encodeWebp(i, quality); }});
    }
    for (int run = 0; run < given.runs; ++run)
        for (Encoder& one : all) {
            farol::Stopwatch watch;
            one.bytes = one.encode(image).size();
            one.ms.push_back(watch.lapMs());
        }
    for (const Encoder& one : all)
        std::printf("%s\n", nlohmann::json{{"bench", "encode"},
                                           {"encoder", one.name},
                                           {"width", image.width},
                                           {"height", image.height},
                                           {"ms", bench::median(one.ms)},
                                           {"bytes", one.bytes},
                                           {"runs", given.runs}}
                                .dump()
                                .c_str());
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_encode: %s\n", error.what());
    return 1;
}
