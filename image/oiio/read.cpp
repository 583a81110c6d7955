// The module: links OpenImageIO and its dependencies, so that the program does not.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/module.h"

namespace {

using farol::image::ModuleRequest;

class Reader {
  public:
    explicit Reader(const ModuleRequest& request)
        : request_(request),
          // The reader never writes.
          source_(const_cast<char*>(request.bytes.data()), request.bytes.size()),
          input_(OIIO::ImageInput::create(request.format, false, nullptr, &source_)) {
        if (!input_) throw std::runtime_error("this OpenImageIO has no reader for it");
        OIIO::ImageSpec spec;
        if (!input_->set_ioproxy(&source_) ||
            !input_->open(std::string("memory.") + request.format, spec))
            fail();
        if (spec.width != request.width || spec.height != request.height ||
            spec.x != request.left || spec.y != request.top || spec.depth > 1 || spec.deep ||
            spec.tile_width != request.tileWidth || spec.tile_height != request.tileHeight)
            throw std::runtime_error("its size and its pixels differ");
        begin_ = spec.nchannels;
        for (int c = 0; c < request.channelCount; ++c) {
            const auto& names = spec.channelnames;
            const auto name = std::find(names.begin(), names.end(), request.channels[c]);
            if (name == names.end())
                throw std::runtime_error(std::string("it has no channel ") + request.channels[c]);
            indices_.push_back(static_cast<int>(name - names.begin()));
            begin_ = std::min(begin_, indices_.back());
            end_ = std::max(end_, indices_.back() + 1);
        }
    }

    void read() {
        constexpr int kMaxPixels = 4 << 20;  // of four floats
        const bool isTiled = request_.tileWidth > 0;
        const int width = isTiled ? request_.tileWidth : request_.width;
        const int height =
            isTiled ? request_.tileHeight
                    : std::max(1, kMaxPixels * 4 / (end_ - begin_) / std::max(1, request_.width));
        for (int y = 0; y < request_.height; y += height)
            for (int x = 0; x < request_.width; x += width)
                readBlock(x, y, std::min(width, request_.width - x),
                          std::min(height, request_.height - y));
    }

  private:
    [[noreturn]] void fail() const {
        std::string reason = input_->geterror();
        if (reason.empty()) reason = OIIO::geterror();
        throw std::runtime_error(reason.empty() ? "damaged" : reason);
    }

    void readBlock(int x, int y, int width, int height) {
        const auto channels = static_cast<std::size_t>(end_ - begin_);
        const auto columns = static_cast<std::size_t>(width);
        samples_.assign(columns * static_cast<std::size_t>(height) * channels, 0.0F);
        const int left = request_.left + x, top = request_.top + y;
        const bool isRead =
            request_.tileWidth > 0
                ? input_->read_tiles(0, 0, left, left + width, top, top + height, 0, 1, begin_,
                                     end_, OIIO::TypeDesc::FLOAT, samples_.data())
                : input_->read_scanlines(0, 0, top, top + height, 0, begin_, end_,
                                         OIIO::TypeDesc::FLOAT, samples_.data());
        if (!isRead) fail();
        row_.resize(columns * indices_.size());
        const float* from = samples_.data();
        for (int line = 0; line < height; ++line) {
            float* to = row_.data();
            for (std::size_t i = 0; i < columns; ++i, from += channels)
                for (const int index : indices_) *to++ = from[index - begin_];
            request_.take(request_.user, x, y + line, width, row_.data());
        }
    }

    const ModuleRequest& request_;
    OIIO::Filesystem::IOMemReader source_;
    std::unique_ptr<OIIO::ImageInput> input_;
    std::vector<int> indices_;  ///< of the requested channels in the file
    int begin_ = 0, end_ = 0;   ///< channels of the file that are read
    std::vector<float> samples_, row_;
};

}  // namespace

// The types of exceptions stay on this side: a module that is loaded late may have its own.
extern "C" __attribute__((visibility("default"))) const char* farol_read_image(
    const ModuleRequest& request) {
    static std::string reason;  // one call at a time
    try {
        // All in the calling thread.
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);
        Reader(request).read();
        return nullptr;
    } catch (const std::bad_alloc&) {
        return farol::image::kModuleOutOfMemory;
    } catch (const std::exception& error) {
        reason = error.what();
    } catch (...) {
        reason = "damaged";
    }
    return reason.c_str();
}
