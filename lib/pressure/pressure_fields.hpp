// Cell fields of the pressure stage. `pressure` survives from step to step: the solve starts there.
#pragma once

#include <type_traits>

#include "grid/staggered_grid.hpp"
#include "pressure/inlets.hpp"
#include "weir/features.hpp"
#include "weir/memory.hpp"

namespace weir {

/// Cells of a patch that a wall parts from the patch's other liquid, a bit each, 4 a row.
struct CutOff {
    std::uint16_t cells = 0;
    std::uint16_t beside = 0;  ///< those that go with the coarse cell on the left or right
    std::uint16_t above = 0;   ///< with the one below or above
};
static_assert(sizeof(CutOff) == kCutOffBytes, "see kCutOffBytes");

/// The tank in cells four times as large, with its own ring of ghost cells.
template <class Real>
struct CoarseGrid {
    GridShape shape;  ///< of what the liquid is in, as the fine grid's
    VelocityOf<Real>* correction = nullptr;  ///< the volume's: a patch's mean excess
    VelocityOf<Real>* residual = nullptr;    ///< the volume's: a patch's disorder
    Real* inverse_diagonal = nullptr;  ///< 0 where there is no liquid
    Real* weight_u = nullptr;  ///< of the left face: open share / density / distance, summed
    Real* weight_v = nullptr;
    Real* reach_u = nullptr;  ///< the same without density. With one liquid they are the weights
    Real* reach_v = nullptr;
    Real* centre_x = nullptr;  ///< mean of the liquid cells' columns within the coarse cell, 0 … 3
    Real* centre_y = nullptr;
    CutOff* cut_off = nullptr;  ///< null: there is no room for bodies
    bool parted = false;        ///< some of that is not empty
    std::int16_t first_row = 0;  ///< of those that hold liquid
    std::int16_t last_row = -1;
};

/// One solve, between its parts.
template <class Real>
struct Solve {
    static constexpr std::int16_t kNotAsked = -1;

    std::int32_t first_row = 0;  ///< these hold all the liquid
    std::int32_t last_row = -1;
    /// Cells from the first to the last liquid one of a row, where that is most: of the coarse grid
    /// if there is one. kNotAsked: gravity pulls across rows.
    std::int16_t longest_row = kNotAsked;
    std::int8_t cycles = 0;
    bool makes_room = false;     ///< in one of `room_turns`, of which its substep may begin more
    Real rescale = Real(0);      ///< of the last pressure p, to start from
    Real share = Real(1);        ///< of that, in the end
    /// Packed: at least 16 if the old pressure is not the solution. Fixed, while it settles: how
    /// far from that it is, last digits.
    std::uint32_t off = 0;
    Product<Real> wanted{};      ///< pᵀb, of the equations Ap = b
    Product<Real> there{};       ///< pᵀAp, but for its diagonal at first

    /// How deep liquid is that takes so many rows, cells along gravity's axis: from there errors
    /// have to come to the surface, which takes sweeps.
    std::int32_t depth(std::int32_t rows) const {
        return longest_row == kNotAsked ? rows : longest_row;
    }
};

/// Fixed point goes on for ever about its last digits, unless it is led to rest.
template <class Real>
inline constexpr bool kSettles = !std::is_floating_point<Real>::value;
/// Velocities are known to 1/65536, packed ones to 1/128. Liquid that gravity holds is led to rest
/// below this, cells/s.
template <class Real>
inline constexpr Real kSettling = Real(Stored<Real>::coarse ? 0.25 : 1.0 / 256.0);

/// Substeps from one in which leaning surfaces are quieted to the next.
inline constexpr std::uint8_t kQuietEvery = 4;
/// Whoever rounds in turns goes by the same count.
inline void next_turn(std::uint8_t& turn) {
    turn = static_cast<std::uint8_t>((turn + 1) % kQuietEvery);
}

/// A solve starts from so many times the last pressure at most.
template <class Real>
inline constexpr Real kMostRescale = Real(16);

/// What surface tension makes of liquid.
enum Tension : std::uint8_t { kNoTension, kDrops, kPools };

/// Tension against gravity, cells² (of the capillary length), from where on liquid is drops, which
/// tension holds together. Below it weight is the stronger one within a patch already: a pool.
inline constexpr std::int32_t kDropLength2 = 16;

template <class Real>
struct PressureFields {
    Real* pressure = nullptr;          ///< dt · p / ρ (the first liquid's), cells²/s; 0 in air
    VelocityOf<Real>* divergence = nullptr;        ///< net flow out of the cell, cells/s
    VelocityOf<Real>* inverse_diagonal = nullptr;  ///< 0 where not liquid; see `stored_inverse`
    DensityOf<Real>* density = nullptr;            ///< 1 = full at rest
    LevelOf<Real>* level = nullptr;    ///< of the surface over `least_head`, cells; > 0 liquid
    CoarseGrid<Real> coarse;
    /// But with surface tension air cells hold the surface's: a `Tension`, as of the substep.
    std::uint8_t on_surface = kNoTension;
    /// Whether paths are straight where the pressure sees to it (leap.hpp): with liquid of one
    /// density. Liquids that overturned gained 0.9 % in energy by it.
    bool leaps = true;
    /// Packed worlds drift every other substep: 1 and the cells that the last one found overfull;
    /// 0: it had none.
    std::uint16_t drift_turn = 0;
    /// Substeps since leaning surfaces were quieted, or were to be; kQuietEvery if there was none.
    /// In packed worlds viscosity rounds, and drift is paid for, by it.
    std::uint8_t quiet_turn = 0;
    /// For so many substeps what is too dense asks for room (inlets.hpp).
    std::uint8_t room_turns = 0;
    bool crowded = false;              ///< some of packed liquid, as the last drift found
    bool settling = false;             ///< liquid of fixed point is being led to rest
    WEIR_NO_UNIQUE_ADDRESS InletsOf<Real> inlets;  ///< where liquid was added that waits for room
    Seconds<Real> last_dt{};           ///< dt that `pressure` was solved for
    /// What of `pressure` to start from, at most kMostRescale: as gravity has changed since it was
    /// solved for; less if sound has become slower.
    Real change = Real(1);
    Real sound_speed = Real(0);  ///< with an equation of state, in use, cells/s; 0: incompressible
    /// Pressure under a cell of still liquid, and what gravity makes of a velocity in the step.
    Real cell_weight = Real(0);
    Solve<Real> solve = {};
    const detail::Elasticity<Real>* elasticity = nullptr;       ///< null: incompressible
    const detail::SecondLiquid<Real>* second_liquid = nullptr;  ///< null: there is one
};

template <class Real>
inline bool are_drops(const PressureFields<Real>& fields) {
    return fields.on_surface == kDrops;
}

/// Where the surface is nearer to a cell's centre, it counts as so near, cells: below a twentieth
/// the equation would be stiffer than the surface is known. What a compressible liquid stores
/// would tear it apart with a lever of more than four.
template <class Real>
inline Real least_fraction(const PressureFields<Real>& fields) {
    return Real(fields.sound_speed > Real(0) ? 0.25F : 0.05F);
}

/// A cell is liquid where the surface stands so high over its centre at least, cells: levels count
/// from there on; from the centre in drops, with an equation of state and in packed worlds. The
/// pressure on a nearer surface would have a lever that is stiffer than the surface is known, and
/// where the lever is limited instead, leaning surfaces stir the liquid: pressure is then not
/// hydrostatic.
template <class Real>
inline Real least_head(const PressureFields<Real>& fields) {
    if constexpr (Stored<Real>::coarse) {
        return kPackedHead<Real>;
    }
    const bool from_centre = are_drops(fields) || fields.sound_speed > Real(0);
    return Real(from_centre ? 0.0F : 0.05F);
}

/// Density of a cell that particles reach, but that has no room for liquid: 0, though not the 0 of
/// a cell that none reaches.
template <class Real>
inline constexpr Real kNoRoom = Real(-0.0);

/// Whether it is known that no particle reaches a cell; in packed worlds, that hardly any does.
/// Fixed point has one 0 and does not know.
template <class Real>
inline bool is_empty([[maybe_unused]] const PressureFields<Real>& fields,
                     [[maybe_unused]] std::int32_t cell) {
    if constexpr (std::is_same<Real, float>::value) {
        return bound_key(fields.density[cell]) == 0;
    } else if constexpr (Stored<Real>::coarse) {
        return fields.density[cell].raw == 0;
    } else {
        return false;
    }
}

/// Where the surface is hardly lower in the next cell it may lie beyond that; no further than this.
template <class Real>
inline constexpr Real kLargestFraction = Real(2);

}  // namespace weir
