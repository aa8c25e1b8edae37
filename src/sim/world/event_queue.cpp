#include "sim/world/event_queue.h"

#include <algorithm>

namespace carom {

EventQueue::EventQueue(std::size_t balls) : heap_(std::max<std::size_t>(balls, 1)), place_(balls) {
    for (std::size_t i = 0; i < balls; ++i) set(i, {heap_[i].time, static_cast<int>(i)});
}

void EventQueue::put(int ball, double time) {
    const std::size_t place = place_[static_cast<std::size_t>(ball)];
    const Entry entry{time, ball};
    if (before(entry, heap_[place]))
        move_up(place, entry);
    else
        move_down(place, entry);
}

void EventQueue::move_up(std::size_t place, const Entry& entry) {
    while (place > 0) {
        const std::size_t parent = (place - 1) / kChildren;
        if (!before(entry, heap_[parent])) break;
        set(place, heap_[parent]);
        place = parent;
    }
    set(place, entry);
}

void EventQueue::move_down(std::size_t place, const Entry& entry) {
    for (;;) {
        const std::size_t begin = kChildren * place + 1;
        const std::size_t end = std::min(begin + kChildren, heap_.size());
        if (begin >= end) break;
        std::size_t least = begin;
        for (std::size_t child = begin + 1; child < end; ++child)
            if (before(heap_[child], heap_[least])) least = child;
        if (!before(heap_[least], entry)) break;
        set(place, heap_[least]);
        place = least;
    }
    set(place, entry);
}

}  // namespace carom
