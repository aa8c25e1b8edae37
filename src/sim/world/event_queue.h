// Which ball's next event is due first.
#pragma once

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
    const Entry& first() const { return heap_.front(); }

  private:
    static constexpr std::size_t kChildren = 4;

    static bool before(const Entry& a, const Entry& b) {
        return a.time < b.time || (a.time == b.time && a.ball < b.ball);
    }
    void set(std::size_t place, const Entry& entry) {
        heap_[place] = entry;
        place_[static_cast<std::size_t>(entry.ball)] = static_cast<std::uint32_t>(place);
    }
    void move_up(std::size_t place, const Entry& entry);
    void move_down(std::size_t place, const Entry& entry);

    std::vector<Entry> heap_;           ///< one per ball; never empty
    std::vector<std::uint32_t> place_;  ///< per ball, in heap_
};

}  // namespace carom
