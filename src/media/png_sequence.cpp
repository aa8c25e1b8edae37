// A film as one PNG per frame.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/failure.h"
#include "media/frame_sink.h"
#include "media/frame_workers.h"
#include "media/output_file.h"
#include "media/output_folder.h"
#include "media/png.h"
#include "media/thread_clock.h"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr const char* kNamesInFolder = "frame_%05d.png";

[[noreturn]] void refuse_frames(const std::string& pattern, const std::string& why) {
    throw Failure(FailureKind::kInput,
                  fmt::format("cannot name frames after '{}': {}", pattern, why));
}

/// A pattern taken apart: what stands before and after the number, "%%" already a percent sign.
struct Pattern {
    std::string before;
    std::string after;
    int digits = 0;  ///< at least so many, filled up with zeros
    bool zeros = false;
};

/// Reads what follows a '%' at `i`: digits and 'd'. Leaves `i` behind it.
void read_number_format(const std::string& text, std::size_t& i, Pattern& pattern) {
    constexpr int kMostDigits = 18;  // those of a 64-bit number
    pattern.zeros = i < text.size() && text[i] == '0';
    while (i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0) {
        pattern.digits = pattern.digits * 10 + (text[i++] - '0');
        if (pattern.digits > kMostDigits) refuse_frames(text, "the number has too many digits");
    }
    if (i >= text.size() || text[i] != 'd')
        refuse_frames(text,
                      "after '%' only a number format like %05d can stand (a percent sign is %%)");
    if (pattern.digits > 0 && !pattern.zeros)
        refuse_frames(text,
                      fmt::format("write %0{}d, so that the names hold no spaces", pattern.digits));
    ++i;
}

/// The pattern in `text`; `found` says whether there was a number format at all.
Pattern parse_pattern(const std::string& text, bool& found) {
    Pattern pattern;
    found = false;
    for (std::size_t i = 0; i < text.size();) {
        std::string& part = found ? pattern.after : pattern.before;
        const char c = text[i++];
        if (c != '%') {
            part += c;
        } else if (i < text.size() && text[i] == '%') {
            part += '%';
            ++i;
        } else {
            if (found) refuse_frames(text, "the frame's number stands in it twice");
            read_number_format(text, i, pattern);
            found = true;
        }
    }
    return pattern;
}

/// Of "frames/%05d.png" as it stands; of a folder, the names in it.
Pattern sequence_pattern(const std::string& text) {
    bool found = false;
    Pattern pattern = parse_pattern(text, found);
    if (!found) {
        const std::string folder = pattern.before;
        if (folder.empty()) refuse_frames(text, "the name is empty");
        pattern = parse_pattern(kNamesInFolder, found);
        pattern.before = (fs::path(folder) / pattern.before).string();
    } else if (pattern.after.find('/') != std::string::npos) {
        refuse_frames(text, "the number must stand in the file's name, not in a folder's");
    } else if (!pattern.after.ends_with(".png")) {
        refuse_frames(
            text,
            "frames are PNGs: the name must end in .png, such as frame_%05d.png (and %% is "
            "a percent sign)");
    }
    return pattern;
}

std::string frame_path(const Pattern& pattern, std::int64_t number) {
    return fmt::format("{}{:0{}}{}", pattern.before, number, pattern.digits, pattern.after);
}

int thread_count(int wanted) {
    if (wanted > 0) return wanted;
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 8);
}

class PngSequence final : public FrameSink {
  public:
    PngSequence(const std::string& text, int threads, Existing existing, FrameNotes notes)
        : pattern_(sequence_pattern(text)),
          existing_(existing),
          notes_(std::move(notes)),
          folder_(fs::path(frame_path(pattern_, 0)).parent_path().string()),
          encoders_(static_cast<std::size_t>(thread_count(threads))),
          workers_(thread_count(threads), thread_count(threads),
                   [this](int worker, std::int64_t number, const Image& frame,
                          const ChangedParts& /*changed*/) {
                       save(encoders_[static_cast<std::size_t>(worker)], number, frame);
                   }) {
        if (!folder_.empty()) prepare_folder(folder_);
    }

    void write(std::int64_t number, const Image& frame) override {
        CAROM_CHECK(number, >=, 0);
        workers_.push(number, frame, {});
    }
    void write_changed(std::int64_t number, const Image& frame,
                       const ChangedParts& changed) override {
        CAROM_CHECK(number, >=, 0);
        workers_.push(number, frame, changed);
    }
    void write_swapped(std::int64_t number, Image& frame) override {
        CAROM_CHECK(number, >=, 0);
        workers_.push_swapped(number, frame);
    }

    void finish() override { workers_.drain(); }

    std::string keep_partial() override {
        workers_.drain();
        const std::lock_guard lock(mutex_);
        if (written_ == 0) return "";
        return folder_.empty() ? "." : folder_;
    }

    SinkTimes times() const override {
        const std::lock_guard lock(mutex_);
        return times_;
    }

  private:
    void save(PngEncoder& encoder, std::int64_t number, const Image& frame) {
        const double begin = calling_thread_cpu_s();
        const std::string bytes = encoder.encode(frame, notes_ ? notes_(number) : PngNotes{});
        const double encoded = calling_thread_cpu_s();
        write_text_file(frame_path(pattern_, number), bytes, Durability::kUnsynced, existing_);
        const double written = calling_thread_cpu_s();

        const std::lock_guard lock(mutex_);
        times_.encode_cpu_s += encoded - begin;
        times_.write_cpu_s += written - encoded;
        ++written_;
    }

    const Pattern pattern_;
    const Existing existing_;
    const FrameNotes notes_;
    const std::string folder_;
    mutable std::mutex mutex_;
    SinkTimes times_;
    std::int64_t written_ = 0;
    std::vector<PngEncoder> encoders_;  ///< of each worker
    FrameWorkers workers_;              ///< last: its threads use the rest
};

}  // namespace

std::string sequence_path(const std::string& pattern, std::int64_t number) {
    return frame_path(sequence_pattern(pattern), number);
}

std::string sequence_folder(const std::string& pattern) {
    const std::string folder = fs::path(sequence_path(pattern, 0)).parent_path().string();
    return folder.empty() ? "." : folder;
}

std::optional<std::int64_t> sequence_number(const std::string& pattern, const std::string& name) {
    Pattern names = sequence_pattern(pattern);
    names.before = fs::path(names.before + "x").filename().string();
    names.before.pop_back();
    if (name.size() <= names.before.size() + names.after.size()) return std::nullopt;
    const char* first = name.data() + names.before.size();
    const char* last = name.data() + name.size() - names.after.size();
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(first, last, number);
    if (error != std::errc() || end != last || number < 0) return std::nullopt;
    if (frame_path(names, number) != name) return std::nullopt;
    return number;
}

std::unique_ptr<FrameSink> make_png_sequence(const std::string& pattern, int threads,
                                             Existing existing, FrameNotes notes) {
    return std::make_unique<PngSequence>(pattern, threads, existing, std::move(notes));
}

}  // namespace carom
