// The module: links FFmpeg's libraries, so that the program does not.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/video/module.h"

namespace {

using farol::image::VideoSettings;

/// FFmpeg's own text of a negative result.
int checked(int result, const char* step) {
    if (result >= 0) return result;
    char reason[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(result, reason, sizeof reason);
    throw std::runtime_error(std::string(step) + ": " + reason);
}

struct Release {
    void operator()(AVFormatContext* one) const { avformat_free_context(one); }
    void operator()(AVCodecContext* one) const { avcodec_free_context(&one); }
    void operator()(AVFrame* one) const { av_frame_free(&one); }
    void operator()(AVPacket* one) const { av_packet_free(&one); }
    void operator()(SwsContext* one) const { sws_freeContext(one); }
    void operator()(AVIOContext* one) const {
        av_freep(&one->buffer);
        avio_context_free(&one);
    }
};
template <typename T>
using Owned = std::unique_ptr<T, Release>;

/// A file in memory that a container is written to.
class MemoryFile {
  public:
    MemoryFile() {
        constexpr int kBuffer = 64 << 10;
        auto* buffer = static_cast<unsigned char*>(av_malloc(kBuffer));
        io_.reset(avio_alloc_context(buffer, kBuffer, 1, this, nullptr, write, seek));
        if (!io_) {
            av_free(buffer);
            throw std::bad_alloc();
        }
    }
    AVIOContext* io() const { return io_.get(); }
    const std::string& bytes() const { return bytes_; }

  private:
    static int write(void* self, std::uint8_t* data, int size) {
        auto& file = *static_cast<MemoryFile*>(self);
        const auto count = static_cast<std::size_t>(size);
        if (file.at_ + count > file.bytes_.size()) file.bytes_.resize(file.at_ + count);
        std::memcpy(file.bytes_.data() + file.at_, data, count);
        file.at_ += count;
        return size;
    }
    static std::int64_t seek(void* self, std::int64_t offset, int from) {
        auto& file = *static_cast<MemoryFile*>(self);
        const auto size = static_cast<std::int64_t>(file.bytes_.size());
        if ((from & AVSEEK_SIZE) != 0) return size;
        const std::int64_t base = from == SEEK_CUR   ? static_cast<std::int64_t>(file.at_)
                                  : from == SEEK_END ? size
                                                     : 0;
        if (base + offset < 0) return AVERROR(EINVAL);
        file.at_ = static_cast<std::size_t>(base + offset);
        return base + offset;
    }

    std::string bytes_;
    std::size_t at_ = 0;
    Owned<AVIOContext> io_;
};

class Video {
  public:
    explicit Video(const VideoSettings& settings) : settings_(settings) {
        av_log_set_level(AV_LOG_QUIET);
        codec_ = avcodec_find_encoder_by_name(settings.encoder);
        if (codec_ == nullptr)
            throw std::runtime_error(std::string("this FFmpeg has no encoder ") + settings.encoder);
        packet_.reset(av_packet_alloc());
        AVFormatContext* format = nullptr;
        checked(avformat_alloc_output_context2(&format, nullptr, settings.container, nullptr),
                "container");
        format_.reset(format);
        format_->pb = file_.io();
        format_->flags |= AVFMT_FLAG_BITEXACT;  // no time, no random number
    }

    void add(const std::uint8_t* pixels, int width, int height) {
        if (!encoder_) open(width, height);
        checked(av_frame_make_writable(frame_.get()), "frame");
        const std::uint8_t* from = onBlack(pixels, width, height);
        const int stride = encoder_->width * kChannels;
        sws_scale(scaler_.get(), &from, &stride, 0, encoder_->height, frame_->data,
                  frame_->linesize);
        frame_->pts = next_++;
        encode(frame_.get());
    }

    const std::string& finish() {
        if (!encoder_) throw std::runtime_error("no frames");
        encode(nullptr);
        checked(av_write_trailer(format_.get()), "end");
        avio_flush(format_->pb);
        return file_.bytes();
    }

  private:
    static constexpr int kChannels = 4;

    void open(int width, int height) {
        const AVRational rate = av_d2q(settings_.fps, 100'000);
        encoder_.reset(avcodec_alloc_context3(codec_));
        if (!encoder_) throw std::bad_alloc();
        // Chroma has half the size: one more column or row where the size is odd.
        encoder_->width = width + width % 2;
        encoder_->height = height + height % 2;
        encoder_->pix_fmt = AV_PIX_FMT_YUV420P;
        encoder_->time_base = av_inv_q(rate);
        encoder_->framerate = rate;
        // No frame waits for a later one: the first is shown at time 0, and loops have no seam.
        encoder_->max_b_frames = 0;
        encoder_->thread_count = 1;
        encoder_->flags |= AV_CODEC_FLAG_BITEXACT;
        encoder_->color_range = AVCOL_RANGE_MPEG;
        encoder_->colorspace = AVCOL_SPC_BT709;
        encoder_->color_primaries = AVCOL_PRI_BT709;
        encoder_->color_trc = AVCOL_TRC_IEC61966_2_1;
        if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0)
            encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        setQuality();
        checked(avcodec_open2(encoder_.get(), codec_, nullptr), "encoder");
        stream_ = avformat_new_stream(format_.get(), nullptr);
        if (stream_ == nullptr) throw std::bad_alloc();
        stream_->time_base = encoder_->time_base;
        stream_->avg_frame_rate = rate;
        checked(avcodec_parameters_from_context(stream_->codecpar, encoder_.get()), "stream");
        checked(avformat_write_header(format_.get(), nullptr), "head");
        frame_.reset(av_frame_alloc());
        if (!frame_) throw std::bad_alloc();
        frame_->format = encoder_->pix_fmt;
        frame_->width = encoder_->width;
        frame_->height = encoder_->height;
        checked(av_frame_get_buffer(frame_.get(), 0), "frame");
        scaler_.reset(sws_getContext(encoder_->width, encoder_->height, AV_PIX_FMT_RGB0,
                                     encoder_->width, encoder_->height, encoder_->pix_fmt,
                                     SWS_AREA | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP, nullptr,
                                     nullptr, nullptr));
        if (!scaler_) throw std::runtime_error("no conversion of colours");
        const int* to709 = sws_getCoefficients(SWS_CS_ITU709);
        sws_setColorspaceDetails(scaler_.get(), to709, 1, to709, 0, 0, 1 << 16, 1 << 16);
    }

    /// Constant quality: the scale of the codec's crf, from nearly lossless to coarse.
    void setQuality() {
        const bool isVp9 = std::string(settings_.encoder).find("vp9") != std::string::npos;
        const double coarsest = isVp9 ? 63.0 : 51.0, step = isVp9 ? 0.48 : 0.36;
        const auto crf =
            static_cast<std::int64_t>(std::lround(coarsest - step * settings_.quality));
        checked(av_opt_set_int(encoder_->priv_data, "crf", crf, 0), "quality");
        if (isVp9) {
            encoder_->bit_rate = 0;
            av_opt_set(encoder_->priv_data, "deadline", "realtime", 0);
            av_opt_set_int(encoder_->priv_data, "cpu-used", 6, 0);
            av_opt_set_int(encoder_->priv_data, "lag-in-frames", 0, 0);
        } else {
            av_opt_set(encoder_->priv_data, "preset", "veryfast", 0);
            av_opt_set(encoder_->priv_data, "x264-params", "sync-lookahead=0", 0);
        }
    }

    /// Rows of RGBx of the encoder's size; the last column and row are repeated. Opaque frames of
    /// that size are returned as they are.
    const std::uint8_t* onBlack(const std::uint8_t* pixels, int width, int height) {
        const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        std::uint8_t alphas = 255;
        for (std::size_t i = 0; i < count; ++i) alphas &= pixels[kChannels * i + 3];
        if (alphas == 255 && width == encoder_->width && height == encoder_->height) return pixels;
        rgb_.resize(static_cast<std::size_t>(encoder_->width) *
                    static_cast<std::size_t>(encoder_->height) * kChannels);
        std::uint8_t* to = rgb_.data();
        for (int y = 0; y < encoder_->height; ++y) {
            const std::uint8_t* row =
                pixels + static_cast<std::ptrdiff_t>(std::min(y, height - 1)) * width * kChannels;
            for (int x = 0; x < encoder_->width; ++x, ++to) {
                const std::uint8_t* pixel = row + std::min(x, width - 1) * kChannels;
                for (int c = 0; c < 3; ++c)
                    *to++ = static_cast<std::uint8_t>((pixel[c] * pixel[3] + 127) / 255);
            }
        }
        return rgb_.data();
    }

    /// Writes the packets of a frame; null: of all that wait.
    void encode(const AVFrame* frame) {
        checked(avcodec_send_frame(encoder_.get(), frame), "encoder");
        for (;;) {
            const int result = avcodec_receive_packet(encoder_.get(), packet_.get());
            if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
            checked(result, "encoder");
            packet_->duration = 1;
            av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
            packet_->stream_index = stream_->index;
            checked(av_interleaved_write_frame(format_.get(), packet_.get()), "packet");
        }
    }

    const VideoSettings settings_;
    const AVCodec* codec_ = nullptr;
    MemoryFile file_;
    Owned<AVFormatContext> format_;
    Owned<AVCodecContext> encoder_;
    Owned<AVFrame> frame_;
    Owned<AVPacket> packet_;
    Owned<SwsContext> scaler_;
    AVStream* stream_ = nullptr;  ///< of format_
    std::int64_t next_ = 0;
    std::vector<std::uint8_t> rgb_;
};

/// The types of exceptions stay on this side: a module that is loaded late may have its own.
template <typename Step>
const char* guarded(const Step& step) {
    static thread_local std::string reason;
    try {
        step();
        return nullptr;
    } catch (const std::exception& error) {
        reason = error.what();
    } catch (...) {
        reason = "unknown";
    }
    return reason.c_str();
}

void* openVideo(const VideoSettings& settings, const char** why) {
    void* video = nullptr;
    *why = guarded([&] { video = std::make_unique<Video>(settings).release(); });
    return video;
}

const char* addFrame(void* video, const std::uint8_t* pixels, int width, int height) {
    return guarded([&] { static_cast<Video*>(video)->add(pixels, width, height); });
}

const char* finishVideo(void* video, const char** bytes, std::size_t* size) {
    return guarded([&] {
        const std::string& file = static_cast<Video*>(video)->finish();
        *bytes = file.data();
        *size = file.size();
    });
}

void closeVideo(void* video) { delete static_cast<Video*>(video); }

}  // namespace

extern "C" __attribute__((visibility("default"))) const farol::image::VideoModule* farol_video() {
    static constexpr farol::image::VideoModule kModule{openVideo, addFrame, finishVideo,
                                                       closeVideo};
    return &kModule;
}
