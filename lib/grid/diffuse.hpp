// Viscous stress on the faces that hold liquid.
#pragma once

#include "grid/staggered_grid.hpp"

namespace weir {

/// From this density of their cells on faces count as full.
inline constexpr double kHalfFull = 0.5;

/// How much mass a component's faces carry, as far as it matters to what rubs on them.
template <class Real>
struct FaceShare {
    const DensityOf<Real>* density;  ///< of the cells, ghosts mirrored
    const ShareOf<Real>* open;       ///< open fraction of the faces; null: no solids
    std::int32_t back;               ///< from a face to the cell before it: 1 for u, stride for v
    const VelocityOf<Real>* light = nullptr;  ///< 1/density of the faces; null: 1 everywhere

    /// From half full on faces count as full, so that the noise between particles does not.
    Real volume(std::int32_t face) const {
        const Real before = density[face - back];
        const Real after = density[face];
        return before > Real(0) && after > Real(0) ? minimum(before + after, Real(1)) : Real(0);
    }
    Real mass_of(std::int32_t face, Real of_volume) const {
        return Stored<Real>::shares_momentum || light == nullptr ? of_volume
                                                                 : of_volume / Real(light[face]);
    }
    Real at(std::int32_t face) const {
        const Real full = volume(face);
        if (!(full > Real(0))) {
            return Real(0);
        }
        return mass_of(face, open == nullptr ? full : full * Real(open[face]));
    }
};

/// From how many 512ths of a unit on a change of a packed velocity becomes one: from an eighth of
/// it, three, five or seven, in turn. Always rounded to the nearest, less than half a unit a step
/// would be none for ever, and the more rows a flow has, the gentler it bends. The same everywhere
/// in a substep: particles take a part of each of the faces around, which would be none again.
inline constexpr std::int32_t kNearest = 256;
constexpr std::int32_t rounded_from(std::uint32_t turn) {
    return 64 + 128 * static_cast<std::int32_t>(turn & 3U);
}

/// A velocity that is to change a little. Mirrored flows stay mirrored.
template <class Real>
inline Real changed([[maybe_unused]] VelocityOf<Real> here, Real then,
                    [[maybe_unused]] std::int32_t from) {
    if constexpr (Stored<Real>::coarse) {
        const Real change = then - here;
        constexpr std::int32_t kMost = 0x7FFFFFFF >> 9;
        const auto size = static_cast<std::int32_t>(fixed::magnitude(change.raw) >> 1U);
        const std::int32_t units = minimum((size + 256 - from / 2) >> 8, kMost);
        return here + Real::of_raw((change.raw < 0 ? -units : units) * 512);
    } else {
        return then;
    }
}

/// One component as it was, and which of its faces move.
template <class Real>
struct Rubbing {
    FaceShare<Real> share;
    const VelocityOf<Real>* field;  ///< ghost lines extended
    std::int32_t first_i;           ///< the first face that is no wall
    std::int32_t first_j;
    bool between_walls;             ///< of the tank, on its two sides across the component
};

/// out = field + amount ∇·(∇u + (∇u)ᵀ) on one component's faces, less its trace; `other` is the
/// other component. The stress in a cell, and that at a node, pulls at the four faces around by
/// no more than the mass of the least of them: what one gains the other loses, a drop that rushes
/// by does not drag a pool along, and what adds up is symmetric, so that kinetic energy falls
/// while amount ≤ ¼. A face counts if both its cells have seen a particle; one that does not
/// exerts nothing. `out` keeps its value where no liquid is.
/// In a liquid's midst the second part adds up to none, and each face and its neighbour pull one
/// another by the mass of the lesser of both.
/// `from`: as `rounded_from` says.
template <class Real>
void diffuse(const GridShape& shape, const Rubbing<Real>& faces, const Rubbing<Real>& other,
             const Part& rows, Real amount, std::int32_t from, VelocityOf<Real>* out);

}  // namespace weir
