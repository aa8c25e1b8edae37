#include "scene/frame_ranges.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/failure.h"

namespace carom {

namespace {

bool before(const FrameRange& a, const FrameRange& b) { return a.first < b.first; }

bool are_apart(const std::vector<FrameRange>& ranges) {
    for (std::size_t i = 1; i < ranges.size(); ++i)
        if (ranges[i].first <= ranges[i - 1].last) return false;
    return true;
}

/// Of ranges in order: those without steps that touch or overlap become one.
std::vector<FrameRange> joined(const std::vector<FrameRange>& ranges) {
    std::vector<FrameRange> result;
    for (const FrameRange& range : ranges) {
        const bool joins = !result.empty() && result.back().step == 1 && range.step == 1 &&
                           range.first <= result.back().last + 1;
        if (joins)
            result.back().last = std::max(result.back().last, range.last);
        else
            result.push_back(range);
    }
    return result;
}

/// Frame by frame, for ranges with steps that lie over one another.
std::vector<FrameRange> one_by_one(const std::vector<FrameRange>& ranges) {
    constexpr std::int64_t kMost = 10'000'000;  // sorted in a second, 80 MB
    std::int64_t total = 0;
    for (const FrameRange& range : ranges) total += std::min(range.size(), kMost + 1);
    if (total > kMost)
        throw Failure(FailureKind::kInput,
                      fmt::format("--frames: ranges with steps that lie over one another may have "
                                  "{} frames together, not {:.3g}",
                                  kMost, static_cast<double>(total)));
    std::vector<std::int64_t> frames;
    for (const FrameRange& range : ranges)
        for (std::int64_t k = range.first; k <= range.last; k += range.step) frames.push_back(k);
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    std::vector<FrameRange> result;
    for (const std::int64_t frame : frames) result.push_back({frame, frame, 1});
    return joined(result);
}

}  // namespace

FrameRanges::FrameRanges(std::vector<FrameRange> ranges) {
    // The last frame that a range really has, so that it says where the range ends.
    for (FrameRange& range : ranges) range.last = range.first + (range.size() - 1) * range.step;
    std::sort(ranges.begin(), ranges.end(), before);
    ranges_ = joined(ranges);
    if (!are_apart(ranges_)) ranges_ = one_by_one(ranges_);
}

std::int64_t FrameRanges::size() const {
    std::int64_t total = 0;
    for (const FrameRange& range : ranges_) total += range.size();
    return total;
}

std::int64_t FrameRanges::back() const { return ranges_.back().last; }

bool FrameRanges::contains(std::int64_t frame) const {
    const auto after =
        std::upper_bound(ranges_.begin(), ranges_.end(), FrameRange{frame, 0, 1}, before);
    if (after == ranges_.begin()) return false;
    const FrameRange& range = *std::prev(after);
    return frame <= range.last && (frame - range.first) % range.step == 0;
}

FrameRanges::Iterator& FrameRanges::Iterator::operator++() {
    if (frame_ < range_->last) {
        frame_ += range_->step;
    } else {
        ++range_;
        frame_ = range_ == end_ ? 0 : range_->first;
    }
    return *this;
}

FrameRanges::Iterator FrameRanges::begin() const {
    Iterator first(ranges_.begin(), ranges_.empty() ? 0 : ranges_.front().first);
    first.end_ = ranges_.end();
    return first;
}

FrameRanges::Iterator FrameRanges::end() const {
    Iterator last(ranges_.end(), 0);
    last.end_ = ranges_.end();
    return last;
}

}  // namespace carom
