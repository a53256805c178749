// The drift of packed liquid between the cells of a patch, and what it pays for it, in whole
// numbers.
#pragma once

#include "grid/borders.hpp"
#include "math/packed_arithmetic.hpp"
#include "math/quotient_packed.hpp"
#include "math/sum_of_products.hpp"
#include "pressure/patches.hpp"
#include "solid/walls.hpp"

namespace weir {

namespace packed {

/// In place of its mean excess: a patch that is all solid.
inline constexpr std::int32_t kSolidPatch = 0x1000;

inline std::int32_t rise(std::int32_t from, std::int32_t to) {
    return from == kSolidPatch || to == kSolidPatch ? 0 : to - from;
}

/// Between which two patches' centres a face lies, as `rises` says.
inline void rises_between(const VelocityOf<SmallFixed>* excess, std::int32_t q, std::int32_t step,
                          std::int32_t* on_face) {
    const std::int32_t before = rise(excess[q - step].raw, excess[q].raw);
    const std::int32_t after = rise(excess[q].raw, excess[q + step].raw);
    on_face[0] = before;
    on_face[1] = before;
    on_face[2] = (before + after) / 2;
    on_face[3] = after;
}

/// Sums of squares of a patch's excess, 2^−14, from which on it pays, and so much more from which
/// on it pays in full: a lattice that a wave passes has less.
inline constexpr std::int32_t kOrderly = 32;
inline constexpr std::int32_t kStirred = 128;
inline constexpr std::int32_t kMostDisorder = kOrderly + kStirred;  ///< more tells nothing

/// Over a patch's velocity, the most that it pays of it, and the most that comes back, for a drift:
/// twice what others do in a substep (drift_price.hpp), since it drifts every other one. It pays
/// for two of them at once.
inline constexpr std::int32_t kMostPrice = 16;
inline constexpr std::int32_t kMostRefund = 76;

/// Mean excess from which on a patch is crowded. While there is such a one packed liquid is not led
/// to rest: what a body had stamped on would stay up to 12 % too dense for good.
inline constexpr std::int32_t kCrowded = 20;

inline bool is_crowded(std::int32_t mean, std::int32_t least) {
    return mean >= least && mean != kSolidPatch;
}

/// What gravity gives, 128ths of a cell/s: so that 32 products with rises of the excess fit.
inline std::int32_t pull_of(SmallFixed fall) {
    constexpr std::int32_t kMostPull = (1 << 13) - 1;
    return clamp(fall.raw >> 9, -kMostPull, kMostPull);
}

/// The x of `share_of_falling`, 64ths: y has the rest.
inline std::int32_t falling_along_x(std::int32_t pull_x, std::int32_t pull_y) {
    const auto x = static_cast<std::uint32_t>(pull_x * pull_x);
    const std::uint32_t square = x + static_cast<std::uint32_t>(pull_y * pull_y);
    return static_cast<std::int32_t>(quotient_of(64 * x, square | 1U));
}

/// What a patch's drift does.
struct Deeds {
    std::int32_t raised = 0;  ///< rises of the excess × gravity's share, 2^−25
    SumOfProducts moving;  ///< squares of velocities, 2^−14

    /// Part of its velocity that the patch gives for it, or gets if negative, 2^−14.
    std::int32_t price(std::int32_t speed, std::int32_t disorder) const {
        constexpr std::int32_t kMostWork = 1 << 20;
        std::int32_t lift = raised;
        std::int64_t energy = moving.whole();
        while (energy >= 1 << 25 || lift >= 1 << 25 || -lift >= 1 << 25) {
            energy >>= 4;
            lift >>= 4;
        }
        const std::int32_t own = static_cast<std::int32_t>(energy);
        const std::int32_t stirred = minimum(disorder - kOrderly, kStirred);
        const std::int32_t done = scaled(stirred, lift);
        const std::int32_t work = clamp(scaled(speed >> 2, done) >> 2, -kMostWork, kMostWork);
        if (work > 0) {
            return 2 * share(work, own + kMostPrice * work);
        }
        return own > -kMostRefund * work ? -2 * share(-work, own) : 0;
    }

    /// Of a number that is many times as large, or 0.
    static std::int32_t share(std::int32_t part, std::int32_t of) {
        while (of >= 0x10000) {
            of >>= 2;
            part >>= 2;
        }
        return part == 0 ? 0
                         : static_cast<std::int32_t>(
                               quotient_of(static_cast<std::uint32_t>(part) << 14U,
                                           static_cast<std::uint32_t>(of)));
    }
};

template <bool Solids>
struct Drift {
    const Borders<SmallFixed>& borders;
    const Walls<SmallFixed>& walls;
    const PressureFields<SmallFixed>& fields;
    StaggeredGrid<SmallFixed>& grid;
    std::int32_t speed;  ///< where the excess rises by 1 from cell to cell, 128ths of a cell/s
    std::int32_t pull_x;  ///< `pull_of`
    std::int32_t pull_y;
    std::int32_t falling_x = falling_along_x(pull_x, pull_y);
    std::int32_t falling_y = 64 - falling_x;
    std::int32_t along_x[kCoarseEdge] = {};
    std::int32_t along_y[kCoarseEdge] = {};

    void patch(const Patch& patch, bool pays) {
        rises_between(fields.coarse.correction, patch.q, 1, along_x);
        rises_between(fields.coarse.correction, patch.q, fields.coarse.shape.stride, along_y);
        if (still(patch.q)) {
            return;
        }
        const std::int32_t disorder = disorder_of(patch.q);
        const std::int32_t price =
            pays && disorder > kOrderly ? deeds(patch).price(speed, disorder) : 0;
        const std::int32_t of_u = (price * falling_x) >> 6;
        const std::int32_t of_v = (price * falling_y) >> 6;
        for_each_face(
            patch,
            [&](std::int32_t face, std::int32_t more) {
                push(grid.u[face], grid.mass_u[face], more, of_u);
            },
            [&](std::int32_t face, std::int32_t more) {
                push(grid.v[face], grid.mass_v[face], more, of_v);
            });
    }

private:
    using Speed = VelocityOf<SmallFixed>;

    /// on_u(face, rise), on_v(face, rise) for the open faces of a patch, by row, of every so many.
    template <std::int32_t Every = 1, class OnU, class OnV>
    WEIR_ALWAYS_INLINE void for_each_face(const Patch& patch, const OnU& on_u,
                                          const OnV& on_v) const {
        const GridShape& s = grid.shape;
        const std::int32_t first_x = patch.i > 0 || (!Solids && borders.wrap_x) ? 0 : 1;
        for (std::int32_t y = Every - 1; y < patch.height; y += Every) {
            const std::int32_t c = s.index(patch.i, patch.j + y);
            const Speed* e = fields.divergence + c;
            for (std::int32_t x = first_x; x < patch.width; ++x) {
                if (!Solids || walls.open_u[c + x].raw > 0) {
                    on_u(c + x, 16 * (e[x].raw - e[x - 1].raw) + along_x[x]);
                }
            }
            if (patch.j + y == 0 && (Solids || !borders.wrap_y)) {
                continue;
            }
            const Speed* below = e - s.stride;
            for (std::int32_t x = 0; x < patch.width; ++x) {
                if (!Solids || walls.open_v[c + x].raw > 0) {
                    on_v(c + x, 16 * (e[x].raw - below[x].raw) + along_y[y]);
                }
            }
        }
    }

    /// The price is taken out of what particles gain in the step.
    void push(Speed& velocity, Speed& gained, std::int32_t more, std::int32_t price) const {
        const std::int32_t now = velocity.raw;
        if (price != 0) {
            gained.raw = short_of(gained.raw - rounded_shift(price * now, 14));
        }
        if (more != 0) {
            velocity.raw = short_of(now - rounded_shift(speed * more, 11));
        }
    }

    std::int32_t disorder_of(std::int32_t q) const { return fields.coarse.residual[q].raw; }

    /// Whether nothing drifts: no excess in the patch, before it and below it, nor a rise.
    bool still(std::int32_t q) const {
        return (disorder_of(q) | disorder_of(q - 1) |
                disorder_of(q - fields.coarse.shape.stride) | along_x[0] | along_x[3] |
                along_y[0] | along_y[3]) == 0;
    }

    /// Of every other row: a sample tells as well.
    [[gnu::noinline]] Deeds deeds(const Patch& patch) const {
        Deeds sums;
        const auto add = [&](const Speed& velocity, std::int32_t more, std::int32_t pull,
                             std::int32_t counts) {
            sums.raised += more * pull;
            sums.moving.add(velocity.raw, (counts * velocity.raw) >> 6);
        };
        for_each_face<2>(
            patch,
            [&](std::int32_t face, std::int32_t more) {
                add(grid.u[face], more, pull_x, falling_x);
            },
            [&](std::int32_t face, std::int32_t more) {
                add(grid.v[face], more, pull_y, falling_y);
            });
        return sums;
    }
};

}  // namespace packed

}  // namespace weir
