// Work of which a part is worth having when it is interrupted: a film.
#pragma once

#include <atomic>
#include <functional>

#include "cli/interrupt.h"

namespace carom {

/// While it lives, an interrupt does not end the process before the work has come to its own end,
/// however long that takes; a second one, and a time limit, do. But a step() is left where it is,
/// as an Interrupt says, and `keep` is called in the place of the thread that works, which never
/// goes on. Work and steps are of one thread.
class KeptWork {
  public:
    /// `keep` keeps what there is, and says so; then the process ends.
    KeptWork(const Interrupt& interrupt, std::function<void()> keep);
    ~KeptWork();
    KeptWork(const KeptWork&) = delete;
    KeptWork& operator=(const KeptWork&) = delete;

    /// Runs what may take long and be left in the middle: it must change nothing that `keep` uses.
    template <class Step>
    void step(const Step& step) {
        const Inside inside(*this);
        step();
    }

  private:
    enum class Place { kOutside, kInside, kLeft };
    class Inside {
      public:
        explicit Inside(KeptWork& work) : work_(work) { work_.go(Place::kOutside, Place::kInside); }
        ~Inside() { work_.go(Place::kInside, Place::kOutside); }
        Inside(const Inside&) = delete;
        Inside& operator=(const Inside&) = delete;

      private:
        KeptWork& work_;
    };
    void go(Place from, Place to) noexcept;
    void leave();

    const Interrupt& interrupt_;
    std::function<void()> keep_;
    std::atomic<Place> place_ = Place::kOutside;
};

}  // namespace carom
