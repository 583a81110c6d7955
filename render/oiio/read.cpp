// The module: OpenImageIO and what it needs, apart from the program.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "render/decoder.h"
#include "render/image_file.h"

namespace {

using farol::render::Decoded;

void read(const char* format, std::string_view bytes, bool wantsPixels, Decoded& out) {
    // The reader never writes.
    OIIO::Filesystem::IOMemReader proxy(const_cast<char*>(bytes.data()), bytes.size());
    const auto input = OIIO::ImageInput::create(format, false, nullptr, &proxy);
    if (!input) throw std::runtime_error(std::string("this build has no decoder for ") + format);
    OIIO::ImageSpec spec, config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->set_ioproxy(&proxy) || !input->open(std::string("memory.") + format, spec, config))
        throw std::runtime_error(input->geterror());
    if (spec.depth > 1 || spec.nchannels > 16)
        throw std::runtime_error("it is a volume or has more than 16 channels");
    out.width = spec.width;
    out.height = spec.height;
    out.channels = std::min(spec.nchannels, 4);
    if (!wantsPixels || out.width <= 0 || out.height <= 0 || out.channels <= 0 ||
        out.pixels() > farol::render::kMaxTexturePixels)
        return;
    out.allocate();
    if (!input->read_image(0, 0, 0, out.channels, OIIO::TypeDesc::UINT8, out.samples.data()))
        throw std::runtime_error(input->geterror());
}

}  // namespace

// The types of exceptions stay on this side: a module that is loaded late may have its own.
extern "C" __attribute__((visibility("default"))) bool farol_read_picture(const char* format,
                                                                          std::string_view bytes,
                                                                          bool wantsPixels,
                                                                          Decoded& out,
                                                                          const char*& fault) {
    thread_local std::string said;
    try {
        read(format, bytes, wantsPixels, out);
        return true;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        said = error.what();
        fault = said.c_str();
        return false;
    }
}
