// The film as a sink of frames: encoder, container, and a name that appears at the end.
#include "media/film_muxer.h"
#include "media/frame_sink.h"
#include "media/output_file.h"
#include "media/video_encoder.h"

namespace carom {

namespace {

class FilmWriter final : public FrameSink {
  public:
    FilmWriter(const std::string& path, const FilmOptions& options)
        : container_(film_container(path)),
          encoder_(path, options, FilmMuxer::wants_global_header(container_)),
          file_(path),
          muxer_(file_.temporary_path(), path, container_, encoder_.context(), options.title) {}

    void write(std::int64_t, const Image& frame) override {
        encoder_.encode(frame, [this](AVPacket& packet) { mux(packet); });
    }

    void finish() override {
        close();
        file_.commit();
    }

    std::string keep_partial() override {
        if (encoder_.frames() == 0) return "";
        const std::string kept = partial_path(file_.path());
        close();
        file_.commit_as(kept);
        return kept;
    }

    SinkTimes times() const override {
        return {encoder_.convert_cpu_s(), encoder_.encode_cpu_s(), write_cpu_s_};
    }

  private:
    void mux(AVPacket& packet) {
        const double begin = calling_thread_cpu_s();
        muxer_.write(packet);
        write_cpu_s_ += calling_thread_cpu_s() - begin;
    }

    void close() {
        encoder_.flush([this](AVPacket& packet) { mux(packet); });
        const double begin = calling_thread_cpu_s();
        muxer_.close();
        write_cpu_s_ += calling_thread_cpu_s() - begin;
    }

    FilmContainer container_;
    VideoEncoder encoder_;
    OutputFile file_;
    FilmMuxer muxer_;
    double write_cpu_s_ = 0;
};

}  // namespace

std::unique_ptr<FrameSink> make_film_writer(const std::string& path, const FilmOptions& options) {
    return std::make_unique<FilmWriter>(path, options);
}

}  // namespace carom
