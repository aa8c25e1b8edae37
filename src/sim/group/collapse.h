// Inelastic collapse of balls that nothing presses together: in free space a ball between others
// may meet them ever more often and ever more slowly, infinitely often in a finite time (S.
// McNamara and W. R. Young, "Inelastic collapse and clumping in a one-dimensional granular medium",
// 1992).
#pragma once

#include <cstddef>
#include <vector>

namespace carom {

/// Follows each ball's impacts, and says which balls are members of a heap that has collapsed. An
/// impact on a heap goes through all of it at once, as if its gaps were none, until what still
/// approaches is slow; that does not rebound. So an impact takes at most kSlow^2 of its energy more
/// than all its rebounds would, and places are off by kNear.
class CollapseRule {
  public:
    /// So many impacts of a ball after its fastest one, and ...
    static constexpr int kImpacts = 32;
    /// ... within the time in which that one alone would go this part of the radius, are collapse.
    static constexpr double kWindow = 0.1;
    /// Gaps of a heap are smaller than this part of a radius.
    static constexpr double kNear = 1e-4;
    /// In a heap, what is slower than this part of the impact at hand does not rebound.
    static constexpr double kSlow = 1e-3;

    explicit CollapseRule(std::size_t balls) : series_(balls) {}

    bool in_heap(int ball) const { return series_[static_cast<std::size_t>(ball)].in_heap; }
    /// It met something while nothing else was near.
    void leave_heap(int ball) { series_[static_cast<std::size_t>(ball)] = {}; }

    /// An impact of a ball, m/s > 0. Those of one instant count once, however many they are.
    void note(int ball, double radius, double approach, double now) {
        Series& s = series_[static_cast<std::size_t>(ball)];
        if (s.in_heap) return;
        if (approach >= s.fastest || now > s.until) {
            s = {approach, now + kWindow * radius / approach, now, 0, false};
        } else if (now > s.last) {
            s.last = now;
            s.in_heap = ++s.impacts >= kImpacts;
        }
    }

  private:
    struct Series {
        double fastest = 0;  ///< approach, m/s
        double until = 0;    ///< s
        double last = 0;     ///< s, the instant that was counted last
        int impacts = 0;     ///< since the fastest one
        bool in_heap = false;
    };
    std::vector<Series> series_;
};

}  // namespace carom
