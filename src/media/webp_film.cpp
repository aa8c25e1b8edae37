#include "media/webp_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/check.h"
#include "media/encoder_settings.h"
#include "media/libav.h"
#include "media/output_file.h"
#include "media/straight_alpha.h"
#include "media/thread_clock.h"
#include "media/video_encoder.h"

namespace carom {

namespace {

/// Part of a picture, in pixels. The container halves the corner, so it is even.
struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;
};

/// `count` bytes of a number, the lowest first.
void put_little_endian(std::string& bytes, std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
}

/// A RIFF chunk: four letters, length, content, and a byte more where that is odd.
std::string chunk(const char* name, const std::string& content) {
    std::string bytes = name;
    put_little_endian(bytes, content.size(), 4);
    bytes += content;
    if (content.size() % 2 != 0) bytes += '\0';
    return bytes;
}

/// The smallest rectangle with an even corner outside of which two pictures of one size agree; of
/// equal ones a single pixel, for the frame must be there.
Rectangle changed_part(const Image& a, const Image& b) {
    int top = a.height_px, bottom = -1, left = a.width_px, right = -1;
    for (int y = 0; y < a.height_px; ++y) {
        if (std::memcmp(a.row(y), b.row(y), a.stride_bytes()) == 0) continue;
        top = std::min(top, y);
        bottom = y;
        const auto differs = [&](int x) {
            return std::memcmp(a.row(y) + 4 * x, b.row(y) + 4 * x, 4) != 0;
        };
        for (int x = 0; x < left; ++x)
            if (differs(x)) left = x;
        for (int x = a.width_px - 1; x > right; --x)
            if (differs(x)) right = x;
    }
    if (bottom < 0) return {0, 0, 1, 1};
    left &= ~1;
    top &= ~1;
    return {left, top, right - left + 1, bottom - top + 1};
}

std::string xml(const std::string& text) {
    std::string safe;
    for (const char c : text)
        safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return safe;
}

/// Title and comment as XMP (ISO 16684-1), Dublin Core's title and description.
std::string xmp(const FilmOptions& options) {
    const auto property = [](const char* name, const std::string& text) {
        return text.empty() ? ""
                            : fmt::format(
                                  "<dc:{0}><rdf:Alt><rdf:li xml:lang=\"x-default\">{1}"
                                  "</rdf:li></rdf:Alt></dc:{0}>",
                                  name, xml(text));
    };
    return "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
           "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description "
           "rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\">" +
           property("title", options.title) + property("description", options.comment) +
           "</rdf:Description></rdf:RDF></x:xmpmeta>";
}

class WebpFilm final : public FrameSink {
  public:
    WebpFilm(const std::string& path, const FilmChoice& choice, const FilmOptions& options)
        : path_(path),
          options_(options),
          codec_(find_encoder(path, *choice.codec)),
          effort_(choice.level),
          file_(path, options.existing),
          stream_(std::fopen(file_.temporary_path().c_str(), "wbe")) {
        if (!stream_) fail();
        packet_.reset(allocated(libav().av_packet_alloc()));
        write_head();
    }

    void write(std::int64_t, const Image& image) override {
        CAROM_CHECK(image.width_px, ==, options_.width_px);
        CAROM_CHECK(image.height_px, ==, options_.height_px);
        const double begin = calling_thread_cpu_s();
        if (options_.transparent) {
            straighten_image(image, now_);
        } else {
            now_ = image;
            for (std::size_t i = 3; i < now_.bgra.size(); i += 4) now_.bgra[i] = 255;
        }
        const Rectangle part = frames_ == 0 ? Rectangle{0, 0, image.width_px, image.height_px}
                                            : changed_part(now_, before_);
        const double converted = calling_thread_cpu_s();
        const std::string pixels = encode(part);
        const double encoded = calling_thread_cpu_s();
        write_frame(part, pixels);
        std::swap(now_, before_);
        times_.convert_cpu_s += converted - begin;
        times_.encode_cpu_s += encoded - converted;
        times_.write_cpu_s += calling_thread_cpu_s() - encoded;
    }

    void finish() override {
        close();
        file_.commit();
    }

    std::string keep_partial() override {
        if (frames_ == 0) return "";
        close();
        return file_.commit_partial();
    }

    SinkTimes times() const override { return times_; }

  private:
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    [[noreturn]] void fail() const {
        throw Failure(FailureKind::kOutput,
                      fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
    }

    void append(const std::string& bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size()) fail();
        size_ += bytes.size();
    }

    void write_head() {
        constexpr int kAnimation = 2, kXmp = 4, kAlpha = 16;
        std::string canvas;
        put_little_endian(canvas, kAnimation | kXmp | (options_.transparent ? kAlpha : 0), 4);
        put_little_endian(canvas, static_cast<std::uint64_t>(options_.width_px - 1), 3);
        put_little_endian(canvas, static_cast<std::uint64_t>(options_.height_px - 1), 3);
        std::string loop;
        put_little_endian(loop, 0, 4);  // of what is not drawn: nothing
        put_little_endian(loop, 0, 2);  // for ever
        append(std::string("RIFF\0\0\0\0WEBP", 12) + chunk("VP8X", canvas) + chunk("ANIM", loop));
    }

    /// One still WebP of a part of now_, without its RIFF head.
    std::string encode(const Rectangle& part) {
        const LibavMessages messages;
        const auto check = [&](int result) {
            if (result < 0)
                throw_libav(FailureKind::kRun, fmt::format("encode frame {} of", frames_), path_,
                            result, messages);
        };
        const CodecPtr context(allocated(libav().avcodec_alloc_context3(&codec_)));
        set_picture_format(*context, PixelFormat::kBgra, part.width, part.height);
        context->time_base = {1, 1000};
        context->flags |= AV_CODEC_FLAG_BITEXACT;
        context->compression_level = effort_;
        check(libav().av_opt_set_double(context->priv_data, "lossless", 1, 0));
        // Of a lossless picture this is effort too, in percent.
        constexpr double kMostEffort = 6;
        check(libav().av_opt_set_double(context->priv_data, "quality", 100 * effort_ / kMostEffort,
                                        0));
        check(libav().avcodec_open2(context.get(), nullptr, nullptr));
        const FramePtr frame(allocated(libav().av_frame_alloc()));
        frame->width = part.width;
        frame->height = part.height;
        frame->format = AV_PIX_FMT_BGRA;
        if (libav().av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
        for (int y = 0; y < part.height; ++y)
            std::memcpy(frame->data[0] + y * frame->linesize[0], now_.row(part.y + y) + 4 * part.x,
                        static_cast<std::size_t>(part.width) * 4);
        check(libav().avcodec_send_frame(context.get(), frame.get()));
        check(libav().avcodec_receive_packet(context.get(), packet_.get()));
        constexpr int kHead = 12;
        CAROM_CHECK(packet_->size, >, kHead);
        std::string bytes(reinterpret_cast<const char*>(packet_->data) + kHead,
                          static_cast<std::size_t>(packet_->size - kHead));
        libav().av_packet_unref(packet_.get());
        return bytes;
    }

    /// Milliseconds from the film's start to a frame, rounded.
    std::int64_t time_ms(std::int64_t frame) const {
        const std::int64_t ms = frame * 1000 * options_.fps_denominator;
        return (2 * ms + options_.fps_numerator) / (2 * std::int64_t{options_.fps_numerator});
    }

    void write_frame(const Rectangle& part, const std::string& pixels) {
        constexpr int kReplace = 2;  // do not blend
        std::string frame;
        put_little_endian(frame, static_cast<std::uint64_t>(part.x / 2), 3);
        put_little_endian(frame, static_cast<std::uint64_t>(part.y / 2), 3);
        put_little_endian(frame, static_cast<std::uint64_t>(part.width - 1), 3);
        put_little_endian(frame, static_cast<std::uint64_t>(part.height - 1), 3);
        put_little_endian(frame,
                          static_cast<std::uint64_t>(time_ms(frames_ + 1) - time_ms(frames_)), 3);
        put_little_endian(frame, kReplace, 1);
        append(chunk("ANMF", frame + pixels));
        ++frames_;
    }

    void close() {
        append(chunk("XMP ", xmp(options_)));
        constexpr std::uint64_t kMost = 0xFFFFFFFE;
        if (size_ - 8 > kMost)
            throw Failure(FailureKind::kOutput,
                          fmt::format("cannot write '{}': a WebP has at most 4 GiB", path_));
        std::string size;
        put_little_endian(size, size_ - 8, 4);
        if (std::fseek(stream_.get(), 4, SEEK_SET) != 0) fail();
        append(size);
        if (std::fclose(stream_.release()) != 0) fail();
    }

    std::string path_;
    FilmOptions options_;
    const AVCodec& codec_;
    const int effort_;  ///< 0 ... 6: libwebp's "method"
    OutputFile file_;
    std::unique_ptr<std::FILE, CloseFile> stream_;
    PacketPtr packet_;
    Image now_, before_;  ///< straight alpha
    std::int64_t frames_ = 0;
    std::uint64_t size_ = 0;  ///< bytes written
    SinkTimes times_;
};

}  // namespace

std::unique_ptr<FrameSink> make_webp_film(const std::string& path, const FilmChoice& choice,
                                          const FilmOptions& options) {
    return std::make_unique<WebpFilm>(path, choice, options);
}

}  // namespace carom
