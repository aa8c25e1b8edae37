// Which ball's next event is due first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace carom {

/// Of each ball one time, s; infinite where nothing is due. Earliest first; at one instant by the
/// balls' order, so that runs repeat exactly.
///
/// A heap of four children a node whose entries move in place: an event that gives its ball another
/// one costs a walk in a heap of one entry a ball, and nothing that was overtaken is left in it.
class EventQueue {
  public:
    struct Entry {
        double time = std::numeric_limits<double>::infinity();
        int ball = -1;
    };

    explicit EventQueue(std::size_t balls);
    void put(int ball, double time);
    void drop(int ball) { put(ball, std::numeric_limits<double>::infinity()); }
    /// The time is infinite where nothing is due.
    const Entry& first() {
        if (taken_) drop(at(0).ball);
        return at(0);
    }
    /// Its ball has nothing due any more. What it is given next most often takes its place.
    void take_first() {
        first();
        at(0).time = -std::numeric_limits<double>::infinity();  // so that all stays below it
        taken_ = true;
    }
    /// What first() would tell.
    Entry upcoming() const {
        if (!taken_) return at(0);
        return size_ > 1 ? at(least_child(0)) : Entry{};
    }

    /// Calls f(ball) for some of which one comes next, after the first.
    template <class F>
    void for_some_upcoming(F&& f) const {
        for (std::size_t place = 1; place <= kChildren && place < size_; ++place) f(at(place).ball);
    }

  private:
    static constexpr std::size_t kChildren = 4;
    /// The children of a node: one line of cache.
    struct alignas(64) Siblings {
        std::array<Entry, kChildren> entries;
    };

    static bool before(const Entry& a, const Entry& b) {
        return a.time < b.time || (a.time == b.time && a.ball < b.ball);
    }
    Entry& at(std::size_t place) {
        return heap_[(place + kChildren - 1) / kChildren]
            .entries[(place + kChildren - 1) % kChildren];
    }
    const Entry& at(std::size_t place) const {
        return heap_[(place + kChildren - 1) / kChildren]
            .entries[(place + kChildren - 1) % kChildren];
    }
    void set(std::size_t place, const Entry& entry) {
        at(place) = entry;
        place_[static_cast<std::size_t>(entry.ball)] = static_cast<std::uint32_t>(place);
    }
    /// Only of a place that has one.
    std::size_t least_child(std::size_t place) const;
    void move_up(std::size_t place, const Entry& entry);
    void move_down(std::size_t place, const Entry& entry);

    std::size_t size_;                  ///< one entry a ball; never 0
    std::vector<Siblings> heap_;        ///< the first one stands alone, at the end of its line
    std::vector<std::uint32_t> place_;  ///< per ball, in the heap
    bool taken_ = false;                ///< the first one was taken, and stands there still
};

}  // namespace carom
