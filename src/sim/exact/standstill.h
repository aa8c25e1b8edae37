// Whether a run gets on.
#pragma once

namespace carom {

/// Counts events without progress in time.
class Standstill {
  public:
    /// Whether an event at this time [s] of this ball is one too many: then it is given up on.
    bool stuck(double time, int ball) {
        if (time > last_) {
            *this = {};
            last_ = time;
            return false;
        }
        of_one_ball_ = ball == ball_ ? of_one_ball_ + 1 : 0;
        ball_ = ball;
        if (++events_ <= kMostAtOneInstant && of_one_ball_ <= kMostOfOneBall) return false;
        of_one_ball_ = 0;
        ++given_up_;
        return true;
    }
    /// Even giving up does not help.
    bool is_hopeless() const { return given_up_ > kMostGivenUpAtOnce; }

  private:
    /// A rack of balls needs hundreds, one ball by itself hardly any.
    static constexpr int kMostAtOneInstant = 20'000;
    static constexpr int kMostOfOneBall = 200;
    static constexpr int kMostGivenUpAtOnce = 1000;

    double last_ = -1;  ///< s
    int events_ = 0, of_one_ball_ = 0, ball_ = -1, given_up_ = 0;
};

}  // namespace carom
