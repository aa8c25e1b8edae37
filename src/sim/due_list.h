// Which ball's next event is due first.
#pragma once

#include <cstdint>
#include <queue>
#include <vector>

namespace carom {

/// An entry: small, since the list is long and most of its cost is memory.
struct Due {
    double time = 0;  ///< s
    int ball = -1;
    std::uint32_t turn = 0;  ///< of the ball's entries: older ones are void
};

/// At most one entry a ball counts, the last one put in. Earliest first; at one instant by the
/// balls' order, so that runs repeat exactly.
class DueList {
  public:
    explicit DueList(std::size_t balls) : turns_(balls, 0) {}

    /// Replaces the ball's entry.
    void put(int ball, double time) { queue_.push({time, ball, ++turn(ball)}); }
    void drop(int ball) { ++turn(ball); }
    /// Until the list changes; none where it is empty.
    const Due* first() {
        while (!queue_.empty() && turn(queue_.top().ball) != queue_.top().turn) queue_.pop();
        return queue_.empty() ? nullptr : &queue_.top();
    }
    void pop() { queue_.pop(); }

  private:
    struct Later {
        bool operator()(const Due& a, const Due& b) const {
            return a.time > b.time || (a.time == b.time && a.ball > b.ball);
        }
    };
    std::uint32_t& turn(int ball) { return turns_[static_cast<std::size_t>(ball)]; }

    std::priority_queue<Due, std::vector<Due>, Later> queue_;
    std::vector<std::uint32_t> turns_;  ///< per ball, of its last entry
};

}  // namespace carom
