// Contact events: what particles, and others that it met, did to each body within a step, in a
// fixed buffer.
#pragma once

#include "solid/walls.hpp"
#include "weir/contact.hpp"
#include "weir/features.hpp"

namespace weir {

template <class Real>
struct Contacts;

/// By itself: linked where blows count.
template <class Real>
struct detail::Blows {
    /// A blow of a particle: the velocity that one of a liquid lost at a place, in cells and units
    /// of time.
    void (*record)(Contacts<Real>& contacts, const Walls<Real>& walls, std::uint16_t slot,
                   Liquid kind, Vec2<Real> place, Vec2<Real> lost);
    /// Sums of places become means, once the step is over. Null: there is no room for contacts.
    void (*finish)(Contacts<Real>& contacts);
};

/// Without room (`capacity` 0) nothing is recorded and nothing is looked at.
template <class Real>
struct Contacts {
    const detail::Blows<Real>* blows = nullptr;  ///< null: nobody wants to know
    Contact* entry = nullptr;
    std::uint16_t capacity = 0;
    std::uint16_t used = 0;
    std::uint16_t last = 0;        ///< where the last blow was entered
    std::uint16_t world = 0;       ///< tag in the bodies' names
    std::int32_t missed = 0;       ///< blows for which there was no entry left
    float cell_m = 1.0F;
    float particle_m2 = 0.0F;      ///< area that a particle stands for, over the unit of time, s
    float second_density = 1.0F;
};

/// Forgets the last step's events.
template <class Real>
void clear(Contacts<Real>& contacts) {
    contacts.used = 0;
    contacts.missed = 0;
    contacts.last = 0;
}

/// Enters a blow: what `met.body` received from what it met. `met.impulse_m3ps` and `met.place_m`
/// are those of this one.
/// Cost: a search among the step's entries, from the last one that was hit.
template <class Real>
void record(Contacts<Real>& contacts, const Contact& met);

}  // namespace weir
