// What a world needs beyond liquid in a tank, decided while linking. `World::init` is inline and
// names the stages that its definition asks for: where that is a constant, as in firmware, the
// compiler knows which, and the linker (--gc-sections) leaves the others out. A definition that is
// known only when the program runs names all.
#pragma once

#include "weir/config.hpp"
#include "weir/storage.hpp"

namespace weir {

/// What there is room for.
enum class Bodies { none, still, moving };

template <class Real>
struct Stages;
template <Bodies Room, class Real>
const Stages<Real>& plain_stages();
/// The same in packed worlds with `Capacity::two_way`.
template <Bodies Room, class Real>
const Stages<Real>& balanced_stages();

namespace detail {

// Tables of functions; each stands beside the stage that it names.
template <class Real>
struct Blows;
template <class Real>
struct Elasticity;
template <class Real>
struct MassMatrix;
template <class Real>
struct OddBorders;
template <class Real>
struct Rest;
template <class Real>
struct RowOrder;
template <class Real>
struct SecondLiquid;
template <class Real>
struct Tension;
template <class Real>
struct Touching;
template <class Real>
struct TwoWay;
template <class Real>
struct Viscosity;

/// `Told`: there is room for contacts; `Felt`: bodies are told what liquid does to them.
template <bool Told, bool Felt, class Real>
const Blows<Real>& blows();
template <class Real>
const Elasticity<Real>& elasticity();
template <class Real>
const MassMatrix<Real>& mass_matrix();
template <class Real>
const OddBorders<Real>& odd_borders();
template <class Real>
const RowOrder<Real>& row_order();
/// `Solids`, here and below: there is room for bodies.
template <bool Solids, class Real>
const Rest<Real>& rest();
template <bool Solids, class Real>
const SecondLiquid<Real>& second_liquid();
template <class Real>
const Tension<Real>& tension();
template <class Real>
const Touching<Real>& touching();
template <bool Solids, class Real>
const TwoWay<Real>& two_way();
template <bool Solids, class Real>
const Viscosity<Real>& viscosity();

/// Null: nothing in the definition asks for it, and it can never be called. A snapshot goes only
/// into a world of the same definition.
template <class Real>
struct Features {
    const Stages<Real>* stages = nullptr;  ///< never null; for bodies only if there is room for any
    const Blows<Real>* blows = nullptr;
    const Elasticity<Real>* elasticity = nullptr;
    const MassMatrix<Real>* mass_matrix = nullptr;
    const OddBorders<Real>* odd_borders = nullptr;
    const Rest<Real>* rest = nullptr;
    const RowOrder<Real>* row_order = nullptr;
    const SecondLiquid<Real>* second_liquid = nullptr;
    const Tension<Real>* tension = nullptr;
    const Touching<Real>* touching = nullptr;
    const TwoWay<Real>* two_way = nullptr;
    const Viscosity<Real>* viscosity = nullptr;
};

/// Liquid that rubs on itself, and liquid that nothing pulls at.
WEIR_ALWAYS_INLINE bool wants_mass_matrix(const WorldDef& def) {
    const bool pulled = def.gravity_mps2.x != 0.0F || def.gravity_mps2.y != 0.0F ||
                        def.surface_tension_m3ps2 > 0.0F;
    return def.viscosity_m2ps > 0.0F || !pulled;
}

/// A stage that also meets bodies has a second table where there is no room for any.
template <class Real>
WEIR_ALWAYS_INLINE Features<Real> features_of(const WorldDef& def) {
    const Capacity& room = def.capacity;
    const bool open = room.bodies == 0;
    Features<Real> features;
    const bool moving = room.moving_bodies;
    features.stages = open     ? &plain_stages<Bodies::none, Real>()
                      : moving ? &plain_stages<Bodies::moving, Real>()
                               : &plain_stages<Bodies::still, Real>();
    if (room.contacts > 0) {
        features.blows = room.two_way ? &blows<true, true, Real>() : &blows<true, false, Real>();
    } else if (room.two_way) {
        features.blows = &blows<false, true, Real>();
    }
    if (room.bodies > 1) {
        features.touching = &touching<Real>();
    }
    if (def.pressure == Pressure::equation_of_state) {
        features.elasticity = &elasticity<Real>();
    }
    if constexpr (!Stored<Real>::shares_momentum) {  // packed worlds do without
        if (wants_mass_matrix(def)) {
            features.mass_matrix = &mass_matrix<Real>();
        }
    }
    if (def.keep_sorted) {
        features.row_order = &row_order<Real>();
    }
    if (def.periodic_x || def.periodic_y || def.viscosity_m2ps > 0.0F) {
        features.odd_borders = &odd_borders<Real>();
    }
    if (room.second_liquid) {
        features.second_liquid =
            open ? &second_liquid<false, Real>() : &second_liquid<true, Real>();
    }
    if (def.sleep.speed_mps > 0.0F) {
        features.rest = open ? &rest<false, Real>() : &rest<true, Real>();
    }
    if (def.surface_tension_m3ps2 > 0.0F) {
        features.tension = &tension<Real>();
    }
    if (room.two_way) {
        features.two_way = open ? &two_way<false, Real>() : &two_way<true, Real>();
        if constexpr (Stored<Real>::shares_momentum) {
            features.stages = open     ? &balanced_stages<Bodies::none, Real>()
                              : moving ? &balanced_stages<Bodies::moving, Real>()
                                       : &balanced_stages<Bodies::still, Real>();
        }
    }
    if (def.viscosity_m2ps > 0.0F) {
        features.viscosity = open ? &viscosity<false, Real>() : &viscosity<true, Real>();
    }
    return features;
}

}  // namespace detail

}  // namespace weir
