// Which particles are in cells that have a share of PIC, some in one look.
#pragma once

#include <cstdint>

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Cells of rows first … end − 1 have a share, if of 0.
struct SharedCells {
    const float* share;  ///< of the tank's first cell
    std::int32_t stride;
    float first;
    float end;
    std::int32_t stored;  ///< number of some cell that is
};

/// Particles that are looked at before those found are drawn.
inline constexpr std::int32_t kMostLooked = 256;

/// Notes which of the first `count` particles have one, as long as enough are left. Returns how
/// many were looked at. `found`: room for as many, and how many there are.
template <class L>
inline std::int32_t find_sharing(const SharedCells& cells, const float* position,
                                 std::int32_t count, std::int32_t* number, std::int32_t& found) {
    const auto factors = L::pairs_of_shorts(1, cells.stride);
    const auto stored = typename L::Ints{} + cells.stored;
    std::int32_t n = 0;
    std::int32_t k = 0;
    for (; k + L::kLanes <= count; k += L::kLanes) {
        const auto a = L::load(position + 2 * k);
        const auto b = L::load(position + 2 * k + L::kLanes);
        const auto y = L::template shuffle<1, 3, 5, 7>(a, b);
        const auto inside = (y >= L::all(cells.first)) & (y < L::all(cells.end));
        if (!L::any_true(inside)) {
            continue;
        }
        // Elsewhere anything may stand, or nothing.
        const auto at = L::sums_of_products(L::whole(a), L::whole(b), factors);
        const auto share = L::numbers_at(cells.share, inside ? at : stored);
        for (auto left = L::bits_of(inside & (share > L::all(0.0F))); left != 0;
             left &= left - 1U) {
            number[n++] = k + L::place_of_sum(__builtin_ctz(left));
        }
    }
    found = n;
    return k;
}

#if WEIR_HAS_WIDE_LANES
std::int32_t find_sharing_wide(const SharedCells& cells, const float* position,
                               std::int32_t count, std::int32_t* number, std::int32_t& found);
#endif

/// The same with as many lanes as the processor has, of all of up to `kMostLooked` particles.
/// Returns how many were found.
inline std::int32_t find_all_sharing(const SharedCells& cells, const float* position,
                                     std::int32_t count, std::int32_t* number) {
    std::int32_t found = 0;
    std::int32_t k = 0;
#if WEIR_HAS_WIDE_LANES
    k = has_wide_lanes() ? find_sharing_wide(cells, position, count, number, found)
                         : find_sharing<FourLanes>(cells, position, count, number, found);
#else
    k = find_sharing<FourLanes>(cells, position, count, number, found);
#endif
    for (; k < count; ++k) {
        const float x = position[2 * k];
        const float y = position[2 * k + 1];
        if (y >= cells.first && y < cells.end &&
            cells.share[static_cast<std::int32_t>(y) * cells.stride +
                        static_cast<std::int32_t>(x)] > 0.0F) {
            number[found++] = k;
        }
    }
    return found;
}

#endif

}  // namespace weir
