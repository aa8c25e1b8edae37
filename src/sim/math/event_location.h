// Where a quantity that must stay >= 0 along a piece first turns negative.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "sim/math/bracketed_root.h"

namespace carom {

/// Looked at in so many places of a piece, which is short against its motion.
inline constexpr std::size_t kGateLooks = 8;

/// Look j of a piece of h seconds.
inline double gate_place(double h, std::size_t j) {
    return h * static_cast<double>(j) / static_cast<double>(kGateLooks);
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

/// A quantity along the fit of a piece: its values at the looks, and anywhere.
template <class OnFit>
class GateLooks {
  public:
    template <class AtLook>
    GateLooks(double h, const AtLook& at_look, OnFit on_fit) : h_(h), on_fit_(std::move(on_fit)) {
        for (std::size_t j = 0; j <= kGateLooks; ++j) looks_[j] = at_look(j);
    }

    /// The first place before `limit`, to rounding: found on the fit, located on `on_course`. 0
    /// where it was never above 0; with `skip_start` that is no answer.
    template <class OnCourse>
    std::optional<double> first_negative(const OnCourse& on_course, double limit,
                                         bool skip_start) const {
        double above = -1;  // the last place where it was above 0
        for (std::size_t j = 0; j <= kGateLooks; ++j) {
            if (j > 0 && gate_place(h_, j - 1) > limit) break;
            const double place = gate_place(h_, j);
            if (looks_[j] > 0) above = place;
            double below = looks_[j] < 0 && j > 0 ? place : -1;
            if (const double dip = dip_at(j); dip >= 0) {
                below = dip;
                if (dip < above) above = gate_place(h_, j - 1);
            }
            if (below < 0) continue;
            if (above >= 0) return bracketed_root(on_course, above, below);
            if (!skip_start) return 0.0;
        }
        return {};
    }

  private:
    /// Where a gate that is open at look j and around it dips below 0 in between; -1 for nowhere.
    double dip_at(std::size_t j) const {
        if (j == 0 || j == kGateLooks) return -1;
        if (!(looks_[j] > 0 && looks_[j] <= looks_[j - 1] && looks_[j] < looks_[j + 1])) return -1;
        const double s = lowest_between(on_fit_, gate_place(h_, j - 1), gate_place(h_, j + 1));
        return on_fit_(s) < 0 ? s : -1;
    }

    double h_;
    OnFit on_fit_;
    std::array<double, kGateLooks + 1> looks_;
};

template <class AtLook, class OnFit>
GateLooks(double, const AtLook&, OnFit) -> GateLooks<OnFit>;

}  // namespace carom
