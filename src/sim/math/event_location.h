// Where a quantity that must stay >= 0 along a piece first turns negative.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "sim/math/bracketed_root.h"

namespace carom {

/// Samples per piece. Pieces are short compared with the motion's time scale, so that a change of
/// sign hides between two of them only where the quantity dips: see dip_at().
inline constexpr std::size_t kSamplesPerPiece = 8;

/// Of sample j of a piece of h seconds, s.
inline double sample_time(double h, std::size_t j) {
    return h * static_cast<double>(j) / static_cast<double>(kSamplesPerPiece);
}

/// The lowest place of a function between two others that are higher, by thirds.
template <class F>
double lowest_between(const F& f, double lo, double hi) {
    constexpr int kThirds = 40;
    for (int i = 0; i < kThirds; ++i) {
        const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
        (f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
    }
    return 0.5 * (lo + hi);
}

/// A quantity along the polynomial of a piece: its values at the samples, and anywhere.
template <class OnFit>
class EventLocation {
  public:
    template <class AtSample>
    EventLocation(double h, const AtSample& at_sample, OnFit on_fit)
        : h_(h), on_fit_(std::move(on_fit)) {
        for (std::size_t j = 0; j <= kSamplesPerPiece; ++j) samples_[j] = at_sample(j);
    }

    /// The first place before `limit`, to rounding: found on the fit, located on `on_course`. 0
    /// where it was never above 0; with `skip_start` that is no answer.
    template <class OnCourse>
    std::optional<double> first_negative(const OnCourse& on_course, double limit,
                                         bool skip_start) const {
        double above = -1;  // the last place where it was above 0
        for (std::size_t j = 0; j <= kSamplesPerPiece; ++j) {
            if (j > 0 && sample_time(h_, j - 1) > limit) break;
            const double place = sample_time(h_, j);
            if (samples_[j] > 0) above = place;
            double below = samples_[j] < 0 && j > 0 ? place : -1;
            if (const double dip = dip_at(j); dip >= 0) {
                below = dip;
                if (dip < above) above = sample_time(h_, j - 1);
            }
            if (below < 0) continue;
            if (above >= 0) return bracketed_root(on_course, above, below);
            if (!skip_start) return 0.0;
        }
        return {};
    }

  private:
    /// Where a quantity that is positive at sample j and around it dips below 0; -1 for nowhere.
    double dip_at(std::size_t j) const {
        if (j == 0 || j == kSamplesPerPiece) return -1;
        if (!(samples_[j] > 0 && samples_[j] <= samples_[j - 1] && samples_[j] < samples_[j + 1]))
            return -1;
        const double s = lowest_between(on_fit_, sample_time(h_, j - 1), sample_time(h_, j + 1));
        return on_fit_(s) < 0 ? s : -1;
    }

    double h_;
    OnFit on_fit_;
    std::array<double, kSamplesPerPiece + 1> samples_;
};

template <class AtSample, class OnFit>
EventLocation(double, const AtSample&, OnFit) -> EventLocation<OnFit>;

}  // namespace carom
