#include "cli/standard_output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "cli/cpu_timer.h"
#include "core/failure.h"
#include "core/temporary_folder.h"
#include "media/film_format.h"
#include "media/png.h"
#include "media/threaded_sink.h"

namespace carom {

void write_standard_output(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
            continue;
        }
        if (errno == EINTR) continue;
        if (errno == EPIPE) throw ReaderGone{};
        throw Failure(FailureKind::kOutput,
                      fmt::format("writing to standard output: {}", std::strerror(errno)));
    }
}

namespace {

class PngStream : public FrameSink {
  public:
    explicit PngStream(FrameNotes notes) : notes_(std::move(notes)) {}

    void write(std::int64_t number, const Image& frame) override {
        std::string bytes;
        {
            const CpuTimer timer(times_.encode_cpu_s);
            bytes = encoder_.encode(frame, notes_(number));
        }
        const CpuTimer timer(times_.write_cpu_s);
        write_standard_output(bytes);
    }
    void finish() override {}
    std::string keep_partial() override { return {}; }
    SinkTimes times() const override { return times_; }

  private:
    FrameNotes notes_;
    PngEncoder encoder_;
    SinkTimes times_;
};

class FilmStream : public FrameSink {
  public:
    FilmStream(const std::string& format, const FilmOptions& options, int waiting_frames)
        : film_path_((folder_.path() / ("film." + format)).string()),
          film_(make_threaded_sink(make_film_writer(film_path_, options), waiting_frames)) {}

    void write(std::int64_t number, const Image& frame) override { film_->write(number, frame); }
    void write_changed(std::int64_t number, const Image& frame,
                       const ChangedParts& changed) override {
        film_->write_changed(number, frame, changed);
    }
    void finish() override {
        film_->finish();
        copy(film_path_);
    }
    std::string keep_partial() override {
        const std::string partial = film_->keep_partial();
        if (!partial.empty()) copy(partial);
        return partial.empty() ? "" : "standard output";
    }
    SinkTimes times() const override { return film_->times(); }

  private:
    static void copy(const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        std::string block(1 << 20, '\0');
        while (file.read(block.data(), static_cast<std::streamsize>(block.size())),
               file.gcount() > 0)
            write_standard_output({block.data(), static_cast<std::size_t>(file.gcount())});
        if (file.bad())
            throw Failure(FailureKind::kOutput, fmt::format("reading {} back failed", path));
    }

    TemporaryFolder folder_{FailureKind::kOutput};
    std::string film_path_;
    std::unique_ptr<FrameSink> film_;
};

}  // namespace

std::unique_ptr<FrameSink> make_png_stream(FrameNotes notes) {
    return make_threaded_sink(std::make_unique<PngStream>(std::move(notes)), 1);
}

std::unique_ptr<FrameSink> make_film_stream(const std::string& format, const FilmOptions& options,
                                            int waiting_frames) {
    if (film_format("film." + format).streaming != FilmStreaming::kAtTheEnd)
        return make_threaded_sink(make_film_pipe(STDOUT_FILENO, format, options), waiting_frames);
    return std::make_unique<FilmStream>(format, options, waiting_frames);
}

}  // namespace carom
