// Both stencils of a particle in lanes, on fields of which two numbers a face stand side by side.
#pragma once

#include "grid/staggered_grid.hpp"
#include "math/lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Both stencils of a particle, as lanes: u, u, v, v.
struct StencilPair {
    std::uint32_t u;  ///< bases, before what `Strides` puts in front of both fields
    std::uint32_t v;
    Lanes fx;
    Lanes fy;
};

/// From a stencil's lower nodes to its upper ones, and its base from its column and row.
struct Strides {
    std::int32_t up;
    ShortLanes factors;

    explicit Strides(std::int32_t stride)
        : up(2 * stride), factors(pairs_of_shorts(1, stride)) {}
    /// Where the base of u stencils, or v stencils, counts from.
    template <class Float>
    static Float* of_u(Float* pairs) {
        return pairs + 2;
    }
    template <class Float>
    Float* of_v(Float* pairs) const {
        return pairs + up;
    }
};

/// Of a particle at lanes 0 and 1: stencil_u and stencil_v.
inline StencilPair stencils(const Strides& strides, Lanes position) {
    const Lanes shifted = shuffle<0, 1, 0, 1>(position, position) + Lanes{0.0F, 0.5F, 0.5F, 0.0F};
    const LaneMask node = __builtin_convertvector(shifted, LaneMask);
    const Lanes f = shifted - __builtin_convertvector(node, Lanes);
    const std::uint64_t bases = two_sums_of_products(node, strides.factors);
    return {static_cast<std::uint32_t>(bases), static_cast<std::uint32_t>(bases >> 32U),
            shuffle<0, 0, 2, 2>(f, f), shuffle<1, 1, 3, 3>(f, f)};
}

#endif

}  // namespace weir
