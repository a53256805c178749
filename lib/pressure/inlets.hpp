// Liquid that a caller adds beneath the surface asks the pressure for room.
#pragma once

#include <type_traits>

#include "base/work.hpp"
#include "math/vec2.hpp"
#include "weir/blocks.hpp"

namespace weir {

struct GridShape;
template <class Real>
struct Domain;
template <class Real>
struct PressureFields;
template <class Real>
struct Walls;

/// Volume that a cell can be asked for, cells. What is more is left to the drift, or a crowd of
/// particles that are put into one place would burst.
template <class Real>
inline constexpr Real kMostOwed = Real(4);

/// A cell of the tank's into which liquid was added, and the volume that it has no room for yet.
template <class Real>
struct Inlet {
    std::int16_t i = 0;
    std::int16_t j = 0;
    Real owed = Real(0);  ///< cells
};

template <class Real>
struct Inlets {
    /// Between the equations and their solve, or behind a step of the equation of state. Set where
    /// there are any: who neither adds particles one by one nor restores links nothing of it.
    void (*make_room)(const Domain<Real>& domain) = nullptr;
    /// `make_room` (pressure/make_room.hpp), for what no inlet takes.
    void (*make_room_around)(const GridShape& s, Real gain, Work work,
                             PressureFields<Real>& fields) = nullptr;
    std::int32_t count = 0;
    Inlet<Real> at[kMostInlets];
};

/// Packed worlds have no bytes to spare for it.
struct NoInlets {};
template <class Real>
inline constexpr bool kHasInlets = !Stored<Real>::shares_momentum;
template <class Real>
using InletsOf = std::conditional_t<kHasInlets<Real>, Inlets<Real>, NoInlets>;

/// That so much was added in a place of the tank, cells: nothing if it was not beneath the surface
/// in the last substep, of which the pressure tells. What is set up particle by particle is not.
template <class Real>
void note_inlet(const GridShape& tank, const Walls<Real>& walls, Vec2<Real> place, Real volume,
                PressureFields<Real>& fields);

/// Whatever was noted can be asked for from now on.
template <class Real>
void link_inlets(PressureFields<Real>& fields);

/// For so many substeps all that is too dense beneath liquid asks for room, after a body was put
/// into it; in packed worlds, which have no bytes to remember where it was, also after liquid was
/// added. For ever, what a splash presses together would gain energy.
inline constexpr std::uint8_t kRoomTurns = 128;

/// That something was added there: nothing if no liquid was over it in the last substep.
/// `weight`: of a cell in that one.
void note_dense(const GridShape& tank, Vec2<SmallFixed> place, SmallFixed weight,
                PressureFields<SmallFixed>& fields);

/// Between the equations and their solve.
void make_room_packed(const GridShape& s, PressureFields<SmallFixed>& fields);

/// Asks for what a substep asks for.
template <class Real>
void make_room_at_inlets(const Domain<Real>& domain) {
    if constexpr (kHasInlets<Real>) {
        const Inlets<Real>& inlets = domain.fields.inlets;
        if (inlets.count > 0) {
            inlets.make_room(domain);
        }
    }
}

}  // namespace weir
