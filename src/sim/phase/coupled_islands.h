// Small islands whose contacts all last: integrated, instead of stepped by ODE.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "sim/integrate/coupled_motion.h"
#include "sim/phase/island_links.h"

namespace carom {

class CoupledIslands {
  public:
    /// `end` [s] of the motion.
    CoupledIslands(ExactWorld& world, Links& links, const InstantNotes& notes, RunLog& log,
                   IslandLinks& island_links, double end)
        : world_(world),
          links_(links),
          notes_(notes),
          log_(log),
          island_links_(island_links),
          end_(end) {}

    enum class Outcome {
        kImpossible,  ///< it has to be stepped
        kGoesOn,
        kRests  ///< and has done so for long enough to fall asleep
    };
    /// The next pieces of the balls of a small island, all of the same length; or some of its
    /// contacts part now.
    Outcome integrate(const std::vector<int>& island, double now);

  private:
    struct PieceGuess {
        double seconds = 0;            ///< a good length for the next piece ...
        std::uint64_t modes = 0;       ///< ... while contacts and modes are these
        double begun = -1, lasts = 0;  ///< s, the last piece
        int short_pieces = 0;          ///< shorter than a step, without one between that lasted
        double stepped_until = -1;     ///< s
    };
    struct CoupledIsland {
        CoupledContacts system;
        CoupledState state;
        std::vector<Contact> contacts;  ///< in the order of the system's
    };
    bool coupled_system(const std::vector<int>& island, double now, CoupledIsland& is) const;
    void land_now(CoupledIsland& is, double now) const;
    enum class Parted { kNone, kSome, kStepInstead };
    Parted part(CoupledIsland& is, const CoupledForces& before, const CoupledForces& forces,
                double rounding_speed, double now);
    CoupledPiece piece_of(int first_ball, double now, CoupledIsland& is, CoupledForces& forces);
    bool pay_for_places(const std::vector<int>& island, double now, CoupledIsland& is) const;
    void begin_pieces(const std::vector<int>& island, double now, const CoupledIsland& is,
                      const CoupledPiece& piece, double rounding_speed);
    bool is_at_rest(const std::vector<int>& island, const CoupledIsland& is,
                    const CoupledForces& forces, double now, double seconds);
    void note_forces(const CoupledIsland& is, const CoupledForces& forces, bool still, double now);

    ExactWorld& world_;
    Links& links_;
    const InstantNotes& notes_;
    RunLog& log_;
    IslandLinks& island_links_;
    double end_;
    std::map<int, PieceGuess> guesses_;  ///< by an island's first ball
};

}  // namespace carom
