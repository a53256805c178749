// The volume stage in whole numbers, as volume_correction.cpp says it: excess of a cell in 128ths,
// its mean over a patch in 2048ths.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "pressure/domain.hpp"
#include "pressure/drift_packed.hpp"

namespace weir {

namespace packed {

inline constexpr std::int32_t kWindow = 128;  ///< what a density in a byte can be off at most
inline constexpr std::int32_t kSurfaceSlack = 26;
inline constexpr std::int32_t kCellWindow = 26;
inline constexpr std::int32_t kPatchWindow = 61;
inline constexpr std::int32_t kSubsurfaceSlack = 4;
/// Level of a cell whose faces are all below the surface.
inline constexpr std::int32_t kBelowSurface = 32 - kHeadRaw;
/// Liquid cells of a patch and their mean from which on they are too full.
inline constexpr std::int32_t kLeastOverfull = 8;
inline constexpr std::int32_t kOverfull = 307;

/// Of a cell's excess where liquid is all around, the lowest so high.
[[gnu::noinline]] inline std::int32_t below_surface(std::int32_t e, std::int32_t lowest) {
    const std::int32_t missing = kBelowSurface - lowest;
    const std::int32_t full = e + ((missing * missing + 128) >> 8);
    return full - clamp(full, -kSubsurfaceSlack, kSubsurfaceSlack);
}

/// Of a row's cells, in place of their divergence.
[[gnu::noinline]] inline void find_excess(const GridShape& s, const PressureFields<SmallFixed>& f,
                                          std::int32_t row) {
    const LevelOf<SmallFixed>* at = f.level + row;
    const DensityOf<SmallFixed>* density = f.density + row;
    VelocityOf<SmallFixed>* const excess = f.divergence + row;
    const std::int32_t stride = s.stride;
    std::int32_t left = at[-1].raw;
    std::int32_t own = at[0].raw;
    for (std::int32_t k = 0; k < s.nx; ++k, at = whole(at + 1)) {
        const std::int32_t right = at[1].raw;
        std::int32_t e = density[k].raw - 128;
        // Most liquid cells are deep.
        const std::int32_t lowest = own <= 0 ? own
                                             : minimum(minimum<std::int32_t>(left, right),
                                                       minimum<std::int32_t>(at[-stride].raw,
                                                                             at[stride].raw));
        if (lowest < kBelowSurface) {
            e = lowest <= 0 ? clamp(e - kSurfaceSlack, 0, kWindow) : below_surface(e, lowest);
        }
        excess[k].raw = static_cast<std::int16_t>(e);
        left = own;
        own = right;
    }
}

template <bool Solids>
std::int32_t average(const GridShape& s, const Walls<SmallFixed>& walls, const Patch& patch,
                     const PressureFields<SmallFixed>& f, std::int32_t& overfull) {
    std::int32_t sum = 0;
    std::int32_t count = 0;
    std::int32_t disorder = 0;
    bool open = !Solids;
    for (std::int32_t y = 0; y < patch.height; ++y) {
        for (std::int32_t x = 0; x < patch.width; ++x) {
            const std::int32_t c = s.index(patch.i + x, patch.j + y);
            open = open || walls.full_density[c].raw > 0;
            const std::int32_t e = f.divergence[c].raw;
            disorder += e * e;
            if (f.level[c].raw > 0) {
                sum += clamp(e, -kCellWindow, kCellWindow);
                count += 1;
            }
        }
    }
    f.coarse.residual[patch.q].raw = static_cast<std::int16_t>(minimum(disorder, kMostDisorder));
    if (count == 0) {
        return open ? 0 : kSolidPatch;
    }
    overfull += count >= kLeastOverfull && 16 * sum >= kOverfull * count ? count : 0;
    return clamp(16 * sum / count, -kPatchWindow, kPatchWindow);
}

}  // namespace packed

/// Every other substep twice as far: nothing that was tried tells the difference.
template <bool Solids>
void correct_packed(const Domain<SmallFixed>& domain, SmallFixed gain_per_s,
                    Vec2<SmallFixed> fall, std::int32_t& overfull, Work work) {
    const Borders<SmallFixed>& borders = domain.borders;
    const Walls<SmallFixed>& walls = domain.walls;
    PressureFields<SmallFixed>& fields = domain.fields;
    const GridShape& s = domain.grid.shape;
    const GridShape& big = fields.coarse.shape;
    if (work.once(1)) {
        overfull = maximum(fields.drift_turn - 1, 0);
        fields.drift_turn = fields.drift_turn == 0 ? 1 : 0;
        fields.crowded = fields.crowded && fields.drift_turn == 0;
    }
    if (fields.drift_turn == 0 && !work.foreseeing()) {
        return;
    }
    const std::int32_t speed = clamp(gain_per_s.raw >> 8, 0, 1 << 17);  // of two substeps
    const Part cells = work.take(s.ny, s.nx);
    for (std::int32_t j = cells.first; j < cells.end; ++j) {
        packed::find_excess(s, fields, s.index(0, j));
    }
    if (work.once(s.border())) {
        extend_cells<!Solids>(borders, s, fields.divergence);
    }
    // A column that sound is ten times as fast as is denser by a hundredth under its own weight.
    const std::int32_t least = (fields.elasticity != nullptr ? 2 : 1) * packed::kCrowded;
    for_each_patch(s, big, work, [&](const Patch& patch) {
        const std::int32_t mean = packed::average<Solids>(s, walls, patch, fields, overfull);
        fields.coarse.correction[patch.q].raw = static_cast<std::int16_t>(mean);
        fields.crowded = fields.crowded || packed::is_crowded(mean, least);
    });
    if (work.once(big.border())) {
        fields.drift_turn = static_cast<std::uint16_t>(minimum(overfull + 1, 0xFFFF));
        mirror_cells(borders, big, fields.coarse.correction);
        mirror_cells(borders, big, fields.coarse.residual);
    }
    packed::Drift<Solids> drift{borders, walls, fields, domain.grid, speed,
                                packed::pull_of(fall.x), packed::pull_of(fall.y)};
    const bool pays = fields.cell_weight > SmallFixed(0) && (fields.quiet_turn & 2) != 0;
    for_each_patch(s, big, work, [&](const Patch& patch) { drift.patch(patch, pays); });
}

}  // namespace weir
