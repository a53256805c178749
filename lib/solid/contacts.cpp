#include "solid/contacts.hpp"

namespace weir {

namespace {

/// Entry of a body, a new one if need be; −1 if there is no room.
template <class Real>
std::int32_t entry_of(Contacts<Real>& contacts, BodyId id) {
    const auto holds = [&](std::int32_t at) {
        return contacts.entry[at].body.slot == id.slot &&
               contacts.entry[at].body.generation == id.generation;
    };
    if (contacts.last < contacts.used && holds(contacts.last)) {
        return contacts.last;
    }
    for (std::int32_t at = 0; at < contacts.used; ++at) {
        if (holds(at)) {
            return at;
        }
    }
    if (contacts.used == contacts.capacity) {
        return -1;
    }
    contacts.entry[contacts.used] = Contact{};
    contacts.entry[contacts.used].body = id;
    return contacts.used++;
}

}  // namespace

template <class Real>
void record_blow(Contacts<Real>& contacts, const Body<Real>& body, std::uint16_t slot,
                 Liquid kind, Vec2<Real> place, Vec2<Real> lost) {
    if (contacts.capacity == 0) {
        return;
    }
    const std::int32_t at = entry_of(contacts, {slot, body.generation, contacts.world});
    if (at < 0) {
        ++contacts.missed;
        return;
    }
    contacts.last = static_cast<std::uint16_t>(at);
    Contact& entry = contacts.entry[at];
    const float mass = kind == Liquid::second ? contacts.second_density * contacts.particle_m2
                                              : contacts.particle_m2;
    ++entry.particles;
    entry.impulse_m3ps =
        entry.impulse_m3ps + (mass * contacts.cell_m) * convert<float>(lost);
    entry.place_m = entry.place_m + contacts.cell_m * convert<float>(place);
}

template <class Real>
void finish(Contacts<Real>& contacts) {
    for (std::int32_t at = 0; at < contacts.used; ++at) {
        Contact& entry = contacts.entry[at];
        entry.place_m = (1.0F / static_cast<float>(entry.particles)) * entry.place_m;
    }
}

#define WEIR_INSTANTIATE(Real)                                                           \
    template void record_blow(Contacts<Real>&, const Body<Real>&, std::uint16_t, Liquid, \
                              Vec2<Real>, Vec2<Real>);                                   \
    template void finish(Contacts<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
