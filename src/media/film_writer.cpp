// The film as a sink of frames: encoder, container, and a name that appears at the end.
#include <optional>

#include "core/check.h"
#include "media/film_choice.h"
#include "media/film_muxer.h"
#include "media/film_text.h"
#include "media/frame_sink.h"
#include "media/output_file.h"
#include "media/sound_track.h"
#include "media/video_encoder.h"
#include "media/webp_film.h"

namespace carom {

namespace {

/// The sound that goes with the pictures; none where the container holds none or none is wanted.
std::optional<SoundTrack> make_sound(const std::string& path, const FilmFormat& format,
                                     const FilmOptions& options) {
    if (options.sound.samples == nullptr || format.sound == nullptr) return std::nullopt;
    return std::make_optional<SoundTrack>(path, *format.sound, options);
}

/// Frames in, a container out.
class FilmEncoding {
  public:
    /// `url` is where the container goes; `path` is for messages.
    FilmEncoding(const std::string& url, const std::string& path, const FilmFormat& format,
                 VideoEncoder& encoder, const FilmOptions& options)
        : encoder_(encoder),
          frame_s_(encoder.stream().time_base),
          sound_(make_sound(path, format, options)),
          muxer_(url, path, format, stream(), options.title, options.comment) {}

    void write(const Image& frame, const ChangedParts& changed) {
        encoder_.encode(frame, changed, [this](AVPacket& packet) { mux(packet); });
    }
    void close() {
        encoder_.flush([this](AVPacket& packet) { mux(packet); });
        const double begin = calling_thread_cpu_s();
        if (sound_) sound_->write_rest(encoder_.frames(), muxer_);
        muxer_.close();
        write_cpu_s_ += calling_thread_cpu_s() - begin;
    }
    SinkTimes times() const {
        const double sound = sound_ ? sound_->encode_cpu_s() : 0;
        return {encoder_.convert_cpu_s(), encoder_.encode_cpu_s() + sound, write_cpu_s_};
    }

  private:
    FilmStream stream() const {
        FilmStream stream = encoder_.stream();
        if (sound_) stream.sound = sound_->parameters();
        return stream;
    }
    void mux(AVPacket& packet) {
        const double begin = calling_thread_cpu_s();
        // Pictures that are decoded first wait for sound up to there.
        if (sound_) sound_->write_until(static_cast<double>(packet.dts) * av_q2d(frame_s_), muxer_);
        muxer_.write(packet);
        write_cpu_s_ += calling_thread_cpu_s() - begin;
    }

    VideoEncoder& encoder_;
    AVRational frame_s_;
    std::optional<SoundTrack> sound_;
    FilmMuxer muxer_;
    double write_cpu_s_ = 0;
};

class FilmWriter final : public FrameSink {
  public:
    FilmWriter(const std::string& path, const FilmChoice& choice, const FilmOptions& options)
        : format_(*choice.format),
          options_(options),
          encoder_(path, choice, options, FilmMuxer::wants_global_header(format_)),
          file_(path, options.existing),
          film_(libav_url(file_.temporary_path()), path, format_, encoder_, options) {}

    void write(std::int64_t, const Image& frame) override { film_.write(frame, {}); }
    void write_changed(std::int64_t, const Image& frame, const ChangedParts& changed) override {
        film_.write(frame, changed);
    }

    void finish() override {
        close();
        file_.commit();
    }

    std::string keep_partial() override {
        if (encoder_.frames() == 0) return "";
        close();
        return file_.commit_partial();
    }

    SinkTimes times() const override { return film_.times(); }

  private:
    void close() {
        film_.close();
        append_film_text(file_.temporary_path(), file_.path(), format_, options_.title,
                         options_.comment);
    }

    const FilmFormat& format_;
    const FilmOptions options_;
    VideoEncoder encoder_;
    OutputFile file_;
    FilmEncoding film_;
};

class FilmPipe final : public FrameSink {
  public:
    FilmPipe(int descriptor, const FilmChoice& choice, const FilmOptions& options)
        : encoder_(kName, choice, options, FilmMuxer::wants_global_header(*choice.format)),
          film_(pipe_url(descriptor), kName, *choice.format, encoder_, options) {}

    void write(std::int64_t, const Image& frame) override { film_.write(frame, {}); }
    void write_changed(std::int64_t, const Image& frame, const ChangedParts& changed) override {
        film_.write(frame, changed);
    }
    void finish() override { film_.close(); }
    std::string keep_partial() override {
        film_.close();
        return kName;
    }
    SinkTimes times() const override { return film_.times(); }

  private:
    static constexpr const char* kName = "standard output";
    VideoEncoder encoder_;
    FilmEncoding film_;
};

}  // namespace

void require_film(const std::string& path, const FilmOptions& options) {
    const FilmChoice choice = choose_film(path, options);
    find_encoder(path, *choice.codec);
    if (options.sound.wanted && choice.format->sound != nullptr)
        find_encoder(path, *choice.format->sound);
}

std::unique_ptr<FrameSink> make_film_pipe(int descriptor, const std::string& extension,
                                          const FilmOptions& options) {
    const FilmChoice choice = choose_film("standard output." + extension, options);
    CAROM_CHECK(choice.format->streaming != FilmStreaming::kAtTheEnd, ==, true);
    return std::make_unique<FilmPipe>(descriptor, choice, options);
}

std::unique_ptr<FrameSink> make_film_writer(const std::string& path, const FilmOptions& options) {
    const FilmChoice choice = choose_film(path, options);
    if (choice.format->container == nullptr) return make_webp_film(path, choice, options);
    return std::make_unique<FilmWriter>(path, choice, options);
}

}  // namespace carom
