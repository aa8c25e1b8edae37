#include "sim/world/event_queue.h"

#include <algorithm>

namespace carom {

EventQueue::EventQueue(std::size_t balls)
    : size_(std::max<std::size_t>(balls, 1)),
      heap_((size_ + kChildren - 2) / kChildren + 1),
      place_(balls) {
    for (std::size_t i = 0; i < balls; ++i) set(i, {at(i).time, static_cast<int>(i)});
}

void EventQueue::put(int ball, double time) {
    const std::size_t place = place_[static_cast<std::size_t>(ball)];
    const Entry entry{time, ball};
    if (taken_ && place == 0) taken_ = false;
    if (before(entry, at(place)))
        move_up(place, entry);
    else
        move_down(place, entry);
}

std::size_t EventQueue::least_child(std::size_t place) const {
    const std::size_t begin = kChildren * place + 1;
    const std::size_t end = std::min(begin + kChildren, size_);
    std::size_t least = begin;
    for (std::size_t child = begin + 1; child < end; ++child)
        if (before(at(child), at(least))) least = child;
    return least;
}

void EventQueue::move_up(std::size_t place, const Entry& entry) {
    while (place > 0) {
        const std::size_t parent = (place - 1) / kChildren;
        if (!before(entry, at(parent))) break;
        set(place, at(parent));
        place = parent;
    }
    set(place, entry);
}

void EventQueue::move_down(std::size_t place, const Entry& entry) {
    while (kChildren * place + 1 < size_) {
        const std::size_t least = least_child(place);
        if (!before(at(least), entry)) break;
        set(place, at(least));
        place = least;
    }
    set(place, entry);
}

}  // namespace carom
