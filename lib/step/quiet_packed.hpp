// What quiets leaning surfaces in packed worlds, in whole numbers.
#pragma once

#include "math/quotient_packed.hpp"
#include "step/weights_packed.hpp"

namespace weir {

namespace packed {

/// Whether the surface around a cell leans to the grid by more than one in `run`.
inline bool leans(const LevelOf<SmallFixed>* level, std::int32_t stride, std::int32_t run) {
    const std::int32_t along_x = absolute(std::int32_t{level[1].raw} - level[-1].raw);
    const std::int32_t along_y = absolute(std::int32_t{level[stride].raw} - level[-stride].raw);
    return run * minimum(along_x, along_y) > maximum(along_x, along_y);
}

/// Share of PIC by a cell's velocity: a half where all is at rest, 0 from a speed on.
struct SlowShare {
    std::int32_t shift = 0;
    std::int32_t most;  ///< of a sum of two velocities times 2^−shift, below 2^8
    std::uint32_t inverse;

    explicit SlowShare(SmallFixed speed) : most(maximum(speed.raw >> 8, 1)) {
        while (most >= 0x100) {
            most >>= 1;
            ++shift;
        }
        inverse = quotient_of(64U << 16U, static_cast<std::uint32_t>(most * most));
    }

    /// Of the velocities of a cell's faces, 128ths.
    std::int32_t of(const Speed* u, const Speed* v, std::int32_t stride) const {
        const std::int32_t x = absolute(std::int32_t{u[0].raw} + u[1].raw) >> shift;
        const std::int32_t y = absolute(std::int32_t{v[0].raw} + v[stride].raw) >> shift;
        if (x >= most || y >= most) {
            return 0;
        }
        const auto squares = static_cast<std::uint32_t>(x * x + y * y);
        return maximum(64 - static_cast<std::int32_t>((squares * inverse) >> 16U), 0);
    }
};

/// By `share`, 128ths, towards the grid's velocity, 2^−15, or as near as a quarter more of its own
/// allows.
inline void draw(Speed& own, std::int32_t grid, std::int32_t share) {
    const std::int32_t v = own.raw;
    const std::int32_t most = absolute(v) + (absolute(v) >> 2);
    const std::int32_t towards = clamp(rounded_shift(grid, 8), -most, most);
    own.raw = short_of(v + rounded_shift(share * (towards - v), 7));
}

/// Particles in cells that have a share, of rows first … end − 1.
inline void quiet(const StaggeredGrid<SmallFixed>& grid, const Speed* share, const Part& rows,
                  const Particles<SmallFixed>& particles) {
    const std::int32_t row = grid.shape.stride * kSpeedBytes;
    const Speed* const first_share = share + grid.shape.stride + 1;
    const Speed* const first_u = grid.mass_u + 1;
    const Speed* const first_v = grid.mass_v + grid.shape.stride;
    const auto lowest = static_cast<std::uint32_t>(rows.first) << 24U;
    const auto height = (static_cast<std::uint32_t>(rows.end - rows.first) << 24U) - 1U;
    const Strip strip(particles);
    for (std::ptrdiff_t k = strip.first; k != 0; k += Strip::kStep) {
        const std::uint32_t at = strip.word(k);
        if (at - lowest > height) {
            continue;
        }
        const std::int32_t its = first_face(first_share, at, row)->raw;
        if (its > 0) {
            const auto mean = [&](const Speed* first, std::uint32_t on_faces) {
                const Speed* low = first_face(first, on_faces, row);
                return weighed(low, further(low, row), weights_at(on_faces));
            };
            Vec2<Speed>& velocity = strip.velocity(k);
            draw(velocity.x, mean(first_u, at + kHalf<true>), its);
            draw(velocity.y, mean(first_v, at + kHalf<false>), its);
        }
    }
}

}  // namespace packed

}  // namespace weir
