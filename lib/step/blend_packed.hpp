// blend_change in whole numbers, in one pass. There are no thin walls.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "pressure/domain.hpp"
#include "step/blend_m0.hpp"

namespace weir {

namespace packed {

/// Between two numbers of unlike size. (Whole, or compilers join two such questions to one.)
inline bool between(std::int32_t value, std::int32_t one, std::int32_t other) {
    return ((value - one) ^ whole(value - other)) < 0;
}

/// A face less a sixth of its ∇², within what is around; 171/1024 for a sixth.
inline std::int32_t sharpened(std::int32_t here, std::int32_t left, std::int32_t right,
                              std::int32_t lower, std::int32_t upper) {
    const std::int32_t bend = (left + right) + (lower + upper) - 4 * here;
    const std::int32_t sharp = here - rounded_shift(171 * bend, 10);
    if (sharp == here || between(sharp, left, right) || between(sharp, lower, upper)) {
        return sharp;
    }
    const std::int32_t low = minimum(here, minimum(minimum(left, right), minimum(lower, upper)));
    const std::int32_t high = maximum(here, maximum(maximum(left, right), maximum(lower, upper)));
    return clamp(sharp, low, high);
}

/// Whether a cell has nothing but liquid around it, as its diagonal tells: it may touch a wall.
inline bool amid(VelocityOf<SmallFixed> diagonal) {
    return diagonal.raw == 512 || diagonal.raw == 384;
}

/// change = now − before + share · sharp, in place of `before`; `share` in 2^−14ths.
inline std::int16_t blended(std::int32_t now, std::int32_t before, std::int32_t sharp,
                            std::int32_t share) {
    // A thirtieth of a small velocity would round to 0.
    return short_of(now - before + ((share * sharp + chance(now * 4 + sharp, 14)) >> 14));
}

/// A row of faces of a kind, ascending: what stood in it is kept for the row above.
struct BlendRow {
    Speed* field;
    std::int32_t count;
    std::int32_t share;
    bool sharp;  ///< some of them may have nothing but liquid around
};

/// What stands beside the tank's wall is not sharpened.
inline void blend_last(const FacesAround& at, const BlendRow& row, std::int32_t here) {
    Speed* const last = row.field + row.count;
    last->raw = blended(further(last, at.now)->raw, here, here, row.share);
}

template <bool Sharp>
void blend_row(const FacesAround at, const BlendRow& row) {
#if defined(WEIR_LOOPS_OF_M0)
    if (Sharp) {
        blend_last(at, row, blend_faces(at, row.field, row.field + row.count, row.share));
        return;
    }
#endif
    std::int32_t left = row.field[-1].raw;
    std::int32_t here = row.field[0].raw;
    Speed* const end = row.field + row.count;
    for (Speed* face = row.field; face != end; face = whole(face + 1)) {
        const std::int32_t right = face[1].raw;
        const std::int32_t now = further(face, at.now)->raw;
        const Speed diagonal = *further(face, at.diagonal);
        if ((now | here | diagonal.raw) == 0) {  // a third of them are in the air
            further(face, at.was)->raw = 0;
            left = here;
            here = right;
            continue;
        }
        std::int32_t sharp = here;
        if (Sharp && amid(diagonal) && amid(*further(face, at.before))) {
            sharp = sharpened(here, left, right, further(face, at.lower)->raw,
                              further(face, at.upper)->raw);
        }
        further(face, at.was)->raw = static_cast<std::int16_t>(here);
        face->raw = blended(now, here, sharp, row.share);
        left = here;
        here = right;
    }
    blend_last(at, row, here);
}

inline void blend(const FacesAround& at, const BlendRow& row) {
    row.sharp ? blend_row<true>(at, row) : blend_row<false>(at, row);
}

/// What `extend_velocity` is told where a share of a velocity is kept.
inline Borders<SmallFixed> slower(Borders<SmallFixed> borders, SmallFixed share) {
    SurfaceLaw<SmallFixed>* walls[] = {&borders.bottom, &borders.right, &borders.top,
                                       &borders.left};
    for (SurfaceLaw<SmallFixed>* wall : walls) {
        wall->conveyor = share * wall->conveyor;
    }
    return borders;
}

}  // namespace packed

inline void blend_packed(const Domain<SmallFixed>& domain, SmallFixed flip_ratio, Work work) {
    const Borders<SmallFixed>& borders = domain.borders;
    PressureFields<SmallFixed>& fields = domain.fields;
    StaggeredGrid<SmallFixed>& grid = domain.grid;
    const GridShape& s = grid.shape;
    // Of what is left: both shares have to add up to 1, or velocity would fade.
    const std::int32_t share = (1 << 14) - (flip_ratio.raw >> 2);
    const Part rows = work.take(s.ny + 1, 2 * s.nx);
    VelocityOf<SmallFixed>* diagonal = fields.inverse_diagonal;
    const std::ptrdiff_t row = s.stride * packed::kSpeedBytes;
    const std::ptrdiff_t to_was = packed::bytes_between(grid.mass_u, fields.divergence);
    const std::ptrdiff_t on_u = packed::bytes_between(grid.mass_u, diagonal);
    const std::ptrdiff_t on_v = packed::bytes_between(grid.mass_v, diagonal);
    packed::FacesAround of_u{packed::bytes_between(grid.mass_u, grid.u), to_was, -row, row, on_u,
                             on_u - packed::kSpeedBytes};
    // What stood there takes the place of diagonals that no row above looks at.
    packed::FacesAround of_v{packed::bytes_between(grid.mass_v, grid.v), on_v - row, -row, row,
                             on_v, on_v - row};
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const std::int32_t c = s.index(0, j);
        const bool inside = j < s.ny;
        const bool on_seam = j == 0 && borders.wrap_y;
        // The cells before the first face of a row stand for what is beyond the tank.
        diagonal[c - 1] = borders.wrap_x ? diagonal[c + s.nx - 1] : VelocityOf<SmallFixed>(0);
        // Below the lowest row stands what stood there.
        of_u.lower = j > 0 ? to_was - row : -row;
        of_v.lower = j > 0 ? on_v - 2 * row : -row;
        of_v.before = on_v + (on_seam ? (s.ny - 1) * row : -row);
        packed::blend(of_u, {grid.mass_u + c, s.nx, share, inside});
        packed::blend(of_v, {grid.mass_v + c, s.nx, share, inside && (j > 0 || on_seam)});
    }
    if (work.once(s.border())) {
        extend_velocity(packed::slower(borders, SmallFixed(1) - flip_ratio), s, grid.mass_u,
                        grid.mass_v);
    }
}

}  // namespace weir
