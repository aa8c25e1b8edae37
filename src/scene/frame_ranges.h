// A choice of a film's frames, as ranges: as small for a year of film as for a second.
#pragma once

#include <cstdint>
#include <iterator>
#include <vector>

namespace carom {

/// first, first + step ... up to last at most.
struct FrameRange {
    std::int64_t first = 0;
    std::int64_t last = 0;
    std::int64_t step = 1;
    std::int64_t size() const { return (last - first) / step + 1; }
};

class FrameRanges {
  public:
    FrameRanges() = default;
    /// Frames that several ranges name are there once. Throws Failure(kInput) where ranges with
    /// steps lie over one another and have more frames than can be sorted in a moment.
    explicit FrameRanges(std::vector<FrameRange> ranges);
    /// 0 ... count - 1.
    static FrameRanges all(std::int64_t count) { return FrameRanges({{0, count - 1, 1}}); }

    bool empty() const { return ranges_.empty(); }
    std::int64_t size() const;
    std::int64_t front() const { return ranges_.front().first; }
    std::int64_t back() const;
    bool contains(std::int64_t frame) const;

    /// In increasing order.
    class Iterator {
      public:
        using iterator_category = std::input_iterator_tag;
        using value_type = std::int64_t;
        using difference_type = std::ptrdiff_t;
        using pointer = const std::int64_t*;
        using reference = std::int64_t;

        explicit Iterator(std::vector<FrameRange>::const_iterator range, std::int64_t frame)
            : range_(range), frame_(frame) {}
        std::int64_t operator*() const { return frame_; }
        Iterator& operator++();
        bool operator==(const Iterator&) const = default;

      private:
        friend class FrameRanges;
        std::vector<FrameRange>::const_iterator range_, end_;
        std::int64_t frame_ = 0;
    };
    Iterator begin() const;
    Iterator end() const;

  private:
    std::vector<FrameRange> ranges_;  ///< each before the next, none empty
};

}  // namespace carom
