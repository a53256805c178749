// What bodies and tank receive, balanced with what the liquid loses (`Capacity::two_way`).
#pragma once

#include "step/simulation.hpp"

namespace weir {

/// Where `substep` opens and closes it. Packed worlds that have one do so around the substep.
template <class Real>
inline constexpr bool kLedgerWithin = !Stored<Real>::shares_momentum;

/// Momentum in whole numbers: 2⁻³² cell/s times the mass of a particle of the first liquid, a
/// velocity's raw number times a density's. Sums are exact, or wrap around, which leaves
/// differences exact.
using WholeMomentum = Vec2<std::uint64_t>;

/// The ledger of fixed-point worlds, in the record behind the tank's.
struct WholeLedger {
    WholeMomentum received;    ///< by bodies and tank in this step
    WholeMomentum gravity;     ///< given by it since the world began
    Vec2<std::int32_t> owed;   ///< by it to each velocity, 2⁻⁴⁶ cell/s: less than a raw number
    std::uint64_t weight = 0;  ///< of the particles that were summed
};
static_assert(sizeof(WholeLedger) <= kBodyLoadBytes<Fixed>, "it takes a body's place");

template <class Real>
inline WholeLedger& whole_ledger(const BodyTable<Real>& table) {
    return *reinterpret_cast<WholeLedger*>(table.load + load_records<Real>(table.capacity) - 1);
}

/// What a particle of either liquid weighs there.
template <class Real>
inline std::uint64_t whole_weight(const Settings<Real>& settings, bool second) {
    return static_cast<std::uint64_t>((second ? settings.second_density : Real(1)).raw);
}

/// What a body received in this step; its record says so in floats, which are whole numbers after
/// all. Slot `capacity` is the tank, which has what all received less what bodies did.
template <class Real>
WholeMomentum whole_received(const Simulation<Real>& simulation, std::int32_t slot);

/// At a substep's top: the liquid's momentum and what all have received so far.
template <class Real>
void open_ledger(Simulation<Real>& simulation, Work work);

/// At its end: what gravity gave, less what the liquid's momentum changed by and what was counted
/// where it was exchanged, is what the method itself does to momentum. The tank and the bodies
/// that move as told get it, each by the share of what it received in this step; it acts on their
/// centres of mass. Without gravity free bodies do, too, and are moved by it in the next substep:
/// with it they would be by what the tank gives liquid at rest, and heavy crates stay down. Where
/// nobody received any it is nobody's.
///
/// In fixed point it balances to the last unit, step by step: what shares leave, and what would be
/// nobody's, is the tank's. Gravity gives whole numbers, and what it owes with the next substep.
/// Cost: all particles are read twice.
template <class Real>
void close_ledger(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work);

}  // namespace weir
