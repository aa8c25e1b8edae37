#include "sim/phase/instant_notes.h"

#include <algorithm>

namespace carom {

namespace {

template <class Note>
bool is_of(const Note& note, const Contact& contact) {
    return note.ball == contact.ball && note.partner == contact.other;
}

/// That of this contact and instant; null if there is none.
template <class Note>
const Note* find(const std::vector<Note>& notes, const Contact& contact, double now) {
    const auto found = std::find_if(notes.begin(), notes.end(), [&](const Note& note) {
        return note.time == now && is_of(note, contact);
    });
    return found == notes.end() ? nullptr : &*found;
}

}  // namespace

void InstantNotes::note_landing(const Contact& contact, double now, double event_due) {
    std::erase_if(landings_, [&](const Landing& l) { return l.time < now || is_of(l, contact); });
    landings_.push_back({contact.ball, contact.other, now, event_due});
}

void InstantNotes::note_separation(const Contact& contact, double now) {
    std::erase_if(separations_, [now](const Separation& s) { return s.time < now; });
    separations_.push_back({contact.ball, contact.other, now});
    std::erase_if(landings_, [&contact](const Landing& l) { return is_of(l, contact); });
}

void InstantNotes::note_press(const Contact& contact, double now) {
    for (Separation& s : separations_)
        if (s.time == now && is_of(s, contact)) {
            s.pressed = true;
            return;
        }
}

const Landing* InstantNotes::landing_of(const Contact& contact, double now) const {
    return find(landings_, contact, now);
}

const Separation* InstantNotes::separation_of(const Contact& contact, double now) const {
    return find(separations_, contact, now);
}

}  // namespace carom
