#include "sim/group/seeds.h"

namespace carom {

void Seeds::clear() {
    for (const Contact& c : all_) {
        first_[static_cast<std::size_t>(c.ball)] = -1;
        if (!c.other.is_surface) first_[static_cast<std::size_t>(c.other.index)] = -1;
    }
    all_.clear();
    next_.clear();
}

int Seeds::next_of(int seed, int ball) const {
    const auto i = static_cast<std::size_t>(seed);
    return next_[i][all_[i].ball == ball ? 0 : 1];
}

void Seeds::add(const Contact& contact) {
    bool known = false;
    for_each_of(contact.ball, [&](const Contact& c) {
        known |= c.ball == contact.ball && c.other == contact.other;
    });
    if (known) return;
    const int index = static_cast<int>(all_.size());
    all_.push_back(contact);
    int& first = first_[static_cast<std::size_t>(contact.ball)];
    next_.push_back({first, -1});
    first = index;
    if (contact.other.is_surface) return;
    int& first_of_other = first_[static_cast<std::size_t>(contact.other.index)];
    next_.back()[1] = first_of_other;
    first_of_other = index;
}

}  // namespace carom
