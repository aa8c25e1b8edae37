// An order of bodies and contacts that follows from where they are, not from who named them first.
//
// A direct solver with constraint force mixing, and a Gauss-Seidel iteration that ends, give answers
// that depend on the order of their rows by more than rounding. In this order the same balls have
// the same motion however a scene lists them.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/contact/solver_body.h"

namespace carom {

class CanonicalOrder {
  public:
    /// Bodies by their places along a slanted line, contacts by their bodies; of two bodies the one
    /// that comes first is `body` of their contact.
    CanonicalOrder(const std::vector<ImpactBody>& bodies,
                   const std::vector<SolverContact>& contacts);

    /// Whether bodies and contacts stand so already.
    bool is_given() const { return given_; }

    std::vector<ImpactBody> sorted(const std::vector<ImpactBody>& bodies) const;
    std::vector<SolverContact> sorted(const std::vector<SolverContact>& contacts) const;
    /// One per contact, on its `body`.
    std::vector<Vec3> sorted(const std::vector<Vec3>& impulses) const;

    /// Writes what a solver made of sorted() back under the numbers of before.
    void put_back(const std::vector<ImpactBody>& sorted, std::vector<ImpactBody>& bodies) const;
    void put_back(const std::vector<SolverContact>& sorted,
                  std::vector<SolverContact>& contacts) const;
    void put_back(const std::vector<Vec3>& sorted, std::vector<Vec3>& impulses) const;

  private:
    bool turns(const SolverContact& c) const;

    std::vector<std::size_t> bodies_;    ///< by rank
    std::vector<std::size_t> rank_;      ///< of each body
    std::vector<std::size_t> contacts_;  ///< by rank
    std::vector<bool> turned_;           ///< per contact: its bodies change places
    bool given_ = true;
};

}  // namespace carom
