// What is met at one instant, before it is known what hangs together.
#pragma once

#include <array>
#include <vector>

#include "sim/contact/contact.h"

namespace carom {

/// The contacts that are known to be met at one instant, one per pair, by ball.
class Seeds {
  public:
    explicit Seeds(std::size_t balls) : first_(balls, -1) {}
    void clear();
    void add(const Contact& contact);
    const std::vector<Contact>& all() const { return all_; }
    /// Calls f(contact) for those of one ball.
    template <class F>
    void for_each_of(int ball, F&& f) const {
        for (int i = first_[static_cast<std::size_t>(ball)]; i >= 0; i = next_of(i, ball))
            f(all_[static_cast<std::size_t>(i)]);
    }

  private:
    int next_of(int seed, int ball) const;

    std::vector<Contact> all_;
    std::vector<std::array<int, 2>> next_;  ///< in the lists of `ball` and of the other ball
    std::vector<int> first_;                ///< per ball, -1 for none
};

}  // namespace carom
