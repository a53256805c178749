#include "solid/contacts.hpp"

#include "solid/body_force.hpp"

namespace weir {

namespace {

/// Entry of a body with what it met, a new one if need be; −1 if there is no room. Within a step a
/// slot is always of the same body.
template <class Real>
std::int32_t entry_of(Contacts<Real>& contacts, const Contact& met) {
    const auto holds = [&](std::int32_t at) {
        const Contact& entry = contacts.entry[at];
        return entry.body.slot == met.body.slot && entry.with == met.with &&
               entry.other.slot == met.other.slot;
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
    Contact& entry = contacts.entry[contacts.used];
    entry = Contact{};
    entry.body = met.body;
    entry.other = met.other;
    entry.with = met.with;
    return contacts.used++;
}

}  // namespace

template <class Real>
void record(Contacts<Real>& contacts, const Contact& met) {
    const std::int32_t at = entry_of(contacts, met);
    if (at < 0) {
        ++contacts.missed;
        return;
    }
    contacts.last = static_cast<std::uint16_t>(at);
    Contact& entry = contacts.entry[at];
    ++entry.blows;
    entry.impulse_m3ps = entry.impulse_m3ps + met.impulse_m3ps;
    entry.place_m = entry.place_m + met.place_m;
}

namespace {

template <class Real>
void record_contact(Contacts<Real>& contacts, const Body<Real>& body, std::uint16_t slot,
                    Liquid kind, Vec2<Real> place, Vec2<Real> lost) {
    const float mass = kind == Liquid::second ? contacts.second_density * contacts.particle_m2
                                              : contacts.particle_m2;
    Contact met;
    met.body = {slot, body.generation, contacts.world};
    met.impulse_m3ps = (mass * contacts.cell_m) * convert<float>(lost);
    met.place_m = contacts.cell_m * convert<float>(place);
    record(contacts, met);
}

template <class Real>
void finish(Contacts<Real>& contacts) {
    for (std::int32_t at = 0; at < contacts.used; ++at) {
        Contact& entry = contacts.entry[at];
        entry.place_m = (1.0F / static_cast<float>(entry.blows)) * entry.place_m;
    }
}

template <bool Told, bool Felt, class Real>
void record_blow(Contacts<Real>& contacts, const Walls<Real>& walls, std::uint16_t slot,
                 Liquid kind, Vec2<Real> place, Vec2<Real> lost) {
    if constexpr (Told) {
        record_contact(contacts, walls.body[slot], slot, kind, place, lost);
    }
    if constexpr (Felt) {
        receive_blow(walls, slot, kind, place, lost);
    }
}

}  // namespace

template <bool Told, bool Felt, class Real>
const detail::Blows<Real>& detail::blows() {
    static constexpr Blows<Real> kBlows{record_blow<Told, Felt, Real>,
                                        Told ? finish<Real> : nullptr};
    return kBlows;
}

#define WEIR_INSTANTIATE(Real)                                        \
    template const detail::Blows<Real>& detail::blows<true, true>();  \
    template const detail::Blows<Real>& detail::blows<true, false>(); \
    template const detail::Blows<Real>& detail::blows<false, true>(); \
    template void record(Contacts<Real>&, const Contact&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
