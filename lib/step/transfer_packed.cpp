#include "step/transfer_packed.hpp"

#include "math/packed_arithmetic.hpp"
#include "step/tank_walls.hpp"

namespace weir {

namespace {

using Real = SmallFixed;
using Speed = VelocityOf<Real>;
using Place = PositionOf<Real>;

static_assert(sizeof(Place) == 2 && sizeof(Speed) == 2, "the loops below know these formats");
static_assert(Real(Place::of_raw(1)).raw == 256, "places are 256ths");
static_assert(Real(Speed::of_raw(1)).raw == 512, "velocities are 128ths");
static_assert(Stored<Real>::particle_mass == 2, "256 units of mass a particle");

/// Mass of 32 particles: 8 times what a full cell's faces hold.
constexpr std::uint32_t kFull = 0x2000;

/// A point among the faces of a kind, in 256ths.
struct Point {
    std::int32_t base;
    std::int32_t fx;
    std::int32_t fy;
};

inline Point point_of(std::int32_t stride, std::int32_t x, std::int32_t y, std::int32_t origin) {
    return {(y >> 8) * stride + (x >> 8) + origin, x & 255, y & 255};
}
inline Point on_u(std::int32_t stride, std::int32_t x, std::int32_t y) {
    return point_of(stride, x, y + 128, 1);
}
inline Point on_v(std::int32_t stride, std::int32_t x, std::int32_t y) {
    return point_of(stride, x + 128, y, stride);
}

/// What the four faces around a point get, 256ths that add up to 256.
struct Weights {
    std::int32_t lower_left;
    std::int32_t lower_right;
    std::int32_t upper_left;
    std::int32_t upper_right;
};

inline Weights weights_of(const Point& at) {
    const std::int32_t both = (at.fx * at.fy + 128) >> 8;
    const std::int32_t upper = at.fy - both;
    return {256 - at.fx - upper, at.fx - both, upper, both};
}

/// Adds to the masses of four faces. False: one of them is full.
inline bool add_masses(Speed* low, Speed* high, const Weights& w) {
#if defined(__ARM_FEATURE_UNALIGNED) && defined(__ARMEL__)
    // Two in a word: they are not negative, and the sums have room.
    std::uint32_t lower = 0;
    std::uint32_t upper = 0;
    __builtin_memcpy(&lower, low, sizeof lower);
    __builtin_memcpy(&upper, high, sizeof upper);
    if (((lower | upper) & (0x10000U - kFull) * 0x10001U) != 0) {
        return false;
    }
    lower += static_cast<std::uint32_t>(w.lower_left + w.lower_right * 0x10000);
    upper += static_cast<std::uint32_t>(w.upper_left + w.upper_right * 0x10000);
    __builtin_memcpy(static_cast<void*>(low), &lower, sizeof lower);
    __builtin_memcpy(static_cast<void*>(high), &upper, sizeof upper);
#else
    const std::int32_t m0 = low[0].raw;
    const std::int32_t m1 = low[1].raw;
    const std::int32_t m2 = high[0].raw;
    const std::int32_t m3 = high[1].raw;
    if (static_cast<std::uint32_t>(m0 | m1 | m2 | m3) >= kFull) {
        return false;
    }
    low[0].raw = static_cast<std::int16_t>(m0 + w.lower_left);
    low[1].raw = static_cast<std::int16_t>(m1 + w.lower_right);
    high[0].raw = static_cast<std::int16_t>(m2 + w.upper_left);
    high[1].raw = static_cast<std::int16_t>(m3 + w.upper_right);
#endif
    return true;
}

/// One component of all particles to its faces, `mass` and `momentum` from the first of which.
/// Both in one loop want more registers than there are. @return how often faces were full.
template <bool OnU>
std::int32_t scatter(const Particles<Real>& particles, Speed* mass, Real* momentum,
                     std::int32_t stride) {
    const Vec2<Place>* place = particles.position;
    const Vec2<Place>* end = place + particles.count;
    const Vec2<Speed>* velocity = particles.velocity;
    std::int32_t refused = 0;
    for (; place != end; ++place, ++velocity) {
        const std::int32_t x = place->x.raw + (OnU ? 0 : 128);
        const std::int32_t y = place->y.raw + (OnU ? 128 : 0);
        const Point at = point_of(stride, x, y, 0);
        const Weights w = weights_of(at);
        Speed* m = mass + at.base;
        if (!add_masses(m, m + stride, w)) {
            ++refused;
            continue;
        }
        const std::int32_t v = (OnU ? velocity->x.raw : velocity->y.raw) * 4;  // 512ths
        Real* p = momentum + at.base;
        p[0].raw += w.lower_left * v;
        p[1].raw += w.lower_right * v;
        p += stride;
        p[0].raw += w.upper_left * v;
        p[1].raw += w.upper_right * v;
    }
    return refused;
}

/// Of a field in 128ths.
struct PackedSample {
    std::int32_t value;    ///< 2^−15
    std::int32_t slope_x;  ///< per cell, 128ths
    std::int32_t slope_y;
};

inline PackedSample sample(const Speed* field, std::int32_t stride, const Point& at) {
    const Speed* p = field + at.base;
    const std::int32_t low_left = p[0].raw;
    const std::int32_t low_slope = p[1].raw - low_left;
    p += stride;
    const std::int32_t high_left = p[0].raw;
    const std::int32_t high_slope = p[1].raw - high_left;
    const std::int32_t low = low_left * 256 + at.fx * low_slope;
    const std::int32_t rise = high_left * 256 + at.fx * high_slope - low;
    return {low + ((at.fy * (rise >> 2)) >> 6),
            low_slope + ((at.fy * (high_slope - low_slope)) >> 8), rise >> 8};
}

/// One component's velocities: of what they were a share, and what the faces give. A pass for
/// itself: what carries particles wants all registers. `change`: from its first face on.
/// @return the fastest, 128ths of a cell a second.
template <bool OnU>
[[gnu::noinline]] std::int32_t gather_change(const Particles<Real>& particles, const Speed* change,
                                             std::int32_t stride, std::int32_t flip) {
    const Vec2<Place>* place = particles.position;
    const Vec2<Place>* end = place + particles.count;
    Vec2<Speed>* velocity = particles.velocity;
    std::int32_t fastest = 0;
    for (; place != end; ++place, ++velocity) {
        const std::int32_t x = place->x.raw + (OnU ? 0 : 128);
        const std::int32_t y = place->y.raw + (OnU ? 128 : 0);
        const std::int32_t gained = sample(change, stride, point_of(stride, x, y, 0)).value;
        std::int16_t& own = OnU ? velocity->x.raw : velocity->y.raw;
        const std::int32_t now =
            saturated<16>((flip * own + gained * 64 + (1 << 13)) >> 14);
        own = static_cast<std::int16_t>(now);
        fastest = maximum(fastest, absolute(now));
    }
    return fastest;
}

/// Where there are particles that are too fast.
[[gnu::noinline]] void limit_all(const Particles<Real>& particles, Real limit,
                                 TransferResult<Real>& result) {
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<Speed> v = particles.velocity[k];
        const Vec2<Real> slower = limited(Vec2<Real>{v.x, v.y}, limit, result);
        particles.velocity[k] = {Speed(slower.x), Speed(slower.y)};
    }
}

/// A unit towards rest. The share of PIC of a small velocity rounds to 0: below 16 units particles
/// kept for ever what they have beyond the flow.
[[gnu::noinline]] void settle(const Particles<Real>& particles) {
    const auto slower = [](std::int16_t v) {
        return static_cast<std::int16_t>(v - (v > 0 ? 1 : 0) + (v < 0 ? 1 : 0));
    };
    for (std::int32_t k = 0; k < particles.count; ++k) {
        Vec2<Speed>& v = particles.velocity[k];
        v = {Speed::of_raw(slower(v.x.raw)), Speed::of_raw(slower(v.y.raw))};
    }
}

/// A velocity in 128ths of a cell a second times `scale` · 2^−shift is a way in 2^−14 cells.
struct Clock {
    std::int32_t scale;  ///< below 2^15
    std::int32_t shift;
};

Clock clock_of(Seconds<Real> dt_s) {
    std::int32_t scale = dt_s.raw;
    std::int32_t shift = 23;
    while (scale >= 0x8000) {
        scale >>= 1;
        --shift;
    }
    return {scale, shift};
}

inline std::int32_t first_way(const Clock& clock, std::int32_t value) {
    return (((value + 128) >> 8) * clock.scale) >> clock.shift;
}

/// What the second order adds to the way along an axis, ½ dt² ∇u · u, in 2^−14 cells. Of ways
/// longer than a cell nobody uses it, so that it may overflow.
inline std::int32_t turn(const Clock& clock, const PackedSample& at, std::int32_t way_x,
                         std::int32_t way_y) {
    const auto product = [](std::int32_t a, std::int32_t b) {
        return static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b);
    };
    const auto sum = static_cast<std::int32_t>(product(at.slope_x, way_x >> 4) +
                                               product(at.slope_y, way_y >> 4) + (1U << 11));
    return static_cast<std::int32_t>(product(sum >> 12, clock.scale)) >> (clock.shift - 1);
}

constexpr std::int32_t kCell = 1 << 14;

/// Not further than a cell along either axis.
inline bool is_near(Vec2<std::int32_t> way) {
    return (static_cast<std::uint32_t>(way.x + kCell) | static_cast<std::uint32_t>(way.y + kCell)) <
           2U * kCell;
}

/// What a step of gathering needs to know.
struct Limits {
    Clock clock;
    std::int32_t gap;      ///< nearer to the tank's walls nothing comes, 256ths
    std::int32_t width;    ///< room between, 256ths
    std::int32_t height;
};

Limits limits_of(const GridShape& s, const Transfer<Real>& transfer) {
    const std::int32_t gap = Place(kWallGap<Real>).raw;
    return {clock_of(transfer.dt_s), gap, s.nx * 256 - 2 * gap, s.ny * 256 - 2 * gap};
}

/// What carries a particle.
struct Carried {
    PackedSample u;
    PackedSample v;
    Vec2<std::int32_t> first;  ///< way of the first order
    Vec2<std::int32_t> way;
};

[[gnu::always_inline]] inline Carried carried(const StaggeredGrid<Real>& grid,
                                               const Clock& clock, std::int32_t x,
                                               std::int32_t y) {
    const std::int32_t stride = grid.shape.stride;
    const PackedSample u = sample(grid.u, stride, on_u(stride, x, y));
    const PackedSample v = sample(grid.v, stride, on_v(stride, x, y));
    const Vec2<std::int32_t> first{first_way(clock, u.value), first_way(clock, v.value)};
    return {u, v, first,
            {first.x + turn(clock, u, first.x, first.y),
             first.y + turn(clock, v, first.x, first.y)}};
}

/// Those few that go far, or come to the tank's walls.
[[gnu::noinline]] void advect_rare(const StaggeredGrid<Real>& grid, const Transfer<Real>& transfer,
                                   const Clock& clock, Vec2<Place>& place, Vec2<Speed>& speed,
                                   TransferResult<Real>& result) {
    const GridShape& s = grid.shape;
    const Carried by = carried(grid, clock, place.x.raw, place.y.raw);
    const Vec2<std::int32_t> way = is_near(by.first) ? by.way : by.first;
    result.far += is_near(way) ? 0 : 1;
    constexpr std::int32_t kLongest = 2 * kCell;
    Vec2<Real> x{Real(place.x) + Real::of_raw(4 * clamp(way.x, -kLongest, kLongest)),
                 Real(place.y) + Real::of_raw(4 * clamp(way.y, -kLongest, kLongest))};
    Vec2<Real> v{speed.x, speed.y};
    meet_tank({static_cast<Real>(s.nx), static_cast<Real>(s.ny)},
              TankBlow<Real>{transfer, nullptr}, x, v);
    place = {Place(x.x), Place(x.y)};
    speed = {Speed(v.x), Speed(v.y)};
    result.max_speed = maximum(result.max_speed, maximum(absolute(v.x), absolute(v.y)));
}

}  // namespace

std::int32_t scatter_packed(const Particles<Real>& particles, StaggeredGrid<Real>& grid) {
    const std::int32_t stride = grid.shape.stride;
    return scatter<true>(particles, grid.mass_u + 1, grid.momentum_u() + 1, stride) +
           scatter<false>(particles, grid.mass_v + stride, grid.momentum_v() + stride, stride);
}

TransferResult<Real> gather_packed(const StaggeredGrid<Real>& grid, const Transfer<Real>& transfer,
                                   Particles<Real>& particles) {
    const std::int32_t stride = grid.shape.stride;
    const std::int32_t flip = transfer.flip_ratio.raw >> 2;
    TransferResult<Real> result;
    result.max_speed = Real::of_raw(
        512 * maximum(gather_change<true>(particles, grid.mass_u + 1, stride, flip),
                      gather_change<false>(particles, grid.mass_v + stride, stride, flip)));
    if (result.max_speed > transfer.limit) {
        limit_all(particles, transfer.limit, result);
        result.max_speed = transfer.limit;
    }
    if (transfer.settling) {
        settle(particles);
    }
    const Limits limits = limits_of(grid.shape, transfer);
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const std::int32_t x = particles.position[k].x.raw;
        const std::int32_t y = particles.position[k].y.raw;
        const Carried by = carried(grid, limits.clock, x, y);
        const std::int32_t thrown = chance(by.u.value ^ by.v.value, 12);
        const std::int32_t to_x = x + ((by.way.x + (thrown & 63)) >> 6);
        const std::int32_t to_y = y + ((by.way.y + (thrown >> 6)) >> 6);
        if (is_near(by.way) &&
            static_cast<std::uint32_t>(to_x - limits.gap) <=
                static_cast<std::uint32_t>(limits.width) &&
            static_cast<std::uint32_t>(to_y - limits.gap) <=
                static_cast<std::uint32_t>(limits.height)) {
            particles.position[k] = {Place::of_raw(static_cast<std::uint16_t>(to_x)),
                                     Place::of_raw(static_cast<std::uint16_t>(to_y))};
        } else {
            advect_rare(grid, transfer, limits.clock, particles.position[k],
                        particles.velocity[k], result);
        }
    }
    return result;
}

}  // namespace weir
