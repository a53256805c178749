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
constexpr std::int32_t kFull = 0x2000;

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

/// `velocity`: of the particle, in 512ths. False: the faces are full.
inline bool scatter(Speed* mass, Real* momentum, std::int32_t stride, const Point& at,
                    std::int32_t velocity) {
    Speed* m = mass + at.base;
    Speed* m_above = m + stride;
    const std::int32_t m0 = m[0].raw;
    const std::int32_t m1 = m[1].raw;
    const std::int32_t m2 = m_above[0].raw;
    const std::int32_t m3 = m_above[1].raw;
    if ((m0 | m1 | m2 | m3) >= kFull) {
        return false;
    }
    const std::int32_t w3 = (at.fx * at.fy + 128) >> 8;
    const std::int32_t w1 = at.fx - w3;
    const std::int32_t w2 = at.fy - w3;
    const std::int32_t w0 = 256 - at.fx - w2;
    m[0].raw = static_cast<std::int16_t>(m0 + w0);
    m[1].raw = static_cast<std::int16_t>(m1 + w1);
    m_above[0].raw = static_cast<std::int16_t>(m2 + w2);
    m_above[1].raw = static_cast<std::int16_t>(m3 + w3);
    Real* p = momentum + at.base;
    p[0].raw += w0 * velocity;
    p[1].raw += w1 * velocity;
    p += stride;
    p[0].raw += w2 * velocity;
    p[1].raw += w3 * velocity;
    return true;
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

/// The way of second order along an axis, u dt + ½ dt² ∇u · u, in 2^−14 cells.
inline std::int32_t way_along(const Clock& clock, std::int32_t way, const PackedSample& at,
                              std::int32_t way_x, std::int32_t way_y) {
    const std::int32_t turn_x = (at.slope_x * clock.scale) >> (clock.shift + 5);
    const std::int32_t turn_y = (at.slope_y * clock.scale) >> (clock.shift + 5);
    return way + ((turn_x * (way_x >> 4) + turn_y * (way_y >> 4)) >> 6);
}

constexpr std::int32_t kCell = 1 << 14;

/// Not further than a cell along either axis.
inline bool is_near(Vec2<std::int32_t> way) {
    return static_cast<std::uint32_t>(way.x + kCell) <= 2U * kCell &&
           static_cast<std::uint32_t>(way.y + kCell) <= 2U * kCell;
}

/// What a step of gathering needs to know.
struct Limits {
    Clock clock;
    std::int32_t flip;     ///< 2^−14
    std::int32_t fastest;  ///< 128ths of a cell a second
    std::int32_t gap;      ///< nearer to the tank's walls nothing comes, 256ths
    std::int32_t width;    ///< room between, 256ths
    std::int32_t height;
};

Limits limits_of(const GridShape& s, const Transfer<Real>& transfer) {
    const std::int32_t gap = Place(kWallGap<Real>).raw;
    return {clock_of(transfer.dt_s), transfer.flip_ratio.raw >> 2, transfer.limit.raw >> 9, gap,
            s.nx * 256 - 2 * gap,    s.ny * 256 - 2 * gap};
}

/// Those few that are too fast, go far, or come to the tank's walls.
[[gnu::noinline]] void gather_rare(const GridShape& s, const Transfer<Real>& transfer,
                                   Vec2<std::int32_t> way, Vec2<std::int32_t> velocity,
                                   Vec2<Place>& place, Vec2<Speed>& speed,
                                   TransferResult<Real>& result) {
    result.far += is_near(way) ? 0 : 1;
    constexpr std::int32_t kLongest = 2 * kCell;
    Vec2<Real> x{Real(place.x) + Real::of_raw(4 * clamp(way.x, -kLongest, kLongest)),
                 Real(place.y) + Real::of_raw(4 * clamp(way.y, -kLongest, kLongest))};
    Vec2<Real> v = limited({Real::of_raw(512 * velocity.x), Real::of_raw(512 * velocity.y)},
                           transfer.limit, result);
    meet_tank({static_cast<Real>(s.nx), static_cast<Real>(s.ny)},
              TankBlow<Real>{transfer, nullptr}, x, v);
    place = {Place(x.x), Place(x.y)};
    speed = {Speed(v.x), Speed(v.y)};
    result.max_speed = maximum(result.max_speed, maximum(absolute(v.x), absolute(v.y)));
}

}  // namespace

std::int32_t scatter_packed(const Particles<Real>& particles, StaggeredGrid<Real>& grid) {
    const std::int32_t stride = grid.shape.stride;
    const std::int32_t count = particles.count;
    Real* momentum_u = grid.momentum_u();
    Real* momentum_v = grid.momentum_v();
    std::int32_t refused = 0;
    for (std::int32_t k = 0; k < count; ++k) {
        const std::int32_t x = particles.position[k].x.raw;
        const std::int32_t y = particles.position[k].y.raw;
        refused += scatter(grid.mass_u, momentum_u, stride, on_u(stride, x, y),
                           particles.velocity[k].x.raw * 4)
                       ? 0
                       : 1;
        refused += scatter(grid.mass_v, momentum_v, stride, on_v(stride, x, y),
                           particles.velocity[k].y.raw * 4)
                       ? 0
                       : 1;
    }
    return refused;
}

TransferResult<Real> gather_packed(const StaggeredGrid<Real>& grid, const Transfer<Real>& transfer,
                                   Particles<Real>& particles) {
    const std::int32_t stride = grid.shape.stride;
    const Limits limits = limits_of(grid.shape, transfer);
    const Clock clock = limits.clock;
    TransferResult<Real> result;
    std::int32_t fastest = 0;
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const std::int32_t x = particles.position[k].x.raw;
        const std::int32_t y = particles.position[k].y.raw;
        const Point at_u = on_u(stride, x, y);
        const Point at_v = on_v(stride, x, y);
        const std::int32_t change_u = sample(grid.mass_u, stride, at_u).value;
        const std::int32_t change_v = sample(grid.mass_v, stride, at_v).value;
        const Vec2<std::int32_t> velocity{
            (limits.flip * particles.velocity[k].x.raw + change_u * 64 + (1 << 13)) >> 14,
            (limits.flip * particles.velocity[k].y.raw + change_v * 64 + (1 << 13)) >> 14};
        const PackedSample u = sample(grid.u, stride, at_u);
        const PackedSample v = sample(grid.v, stride, at_v);
        const std::int32_t way_x = (((u.value + 128) >> 8) * clock.scale) >> clock.shift;
        const std::int32_t way_y = (((v.value + 128) >> 8) * clock.scale) >> clock.shift;
        Vec2<std::int32_t> way{way_x, way_y};
        if (is_near(way)) {
            way = {way_along(clock, way_x, u, way_x, way_y),
                   way_along(clock, way_y, v, way_x, way_y)};
        }
        const std::int32_t thrown = chance(u.value ^ v.value, 12);
        const std::int32_t to_x = x + ((way.x + (thrown & 63)) >> 6);
        const std::int32_t to_y = y + ((way.y + (thrown >> 6)) >> 6);
        const std::int32_t speed = maximum(absolute(velocity.x), absolute(velocity.y));
        if (is_near(way) && speed <= limits.fastest &&
            static_cast<std::uint32_t>(to_x - limits.gap) <=
                static_cast<std::uint32_t>(limits.width) &&
            static_cast<std::uint32_t>(to_y - limits.gap) <=
                static_cast<std::uint32_t>(limits.height)) {
            fastest = maximum(fastest, speed);
            particles.position[k] = {Place::of_raw(static_cast<std::uint16_t>(to_x)),
                                     Place::of_raw(static_cast<std::uint16_t>(to_y))};
            particles.velocity[k] = {Speed::of_raw(static_cast<std::int16_t>(velocity.x)),
                                     Speed::of_raw(static_cast<std::int16_t>(velocity.y))};
        } else {
            gather_rare(grid.shape, transfer, way, velocity, particles.position[k],
                        particles.velocity[k], result);
        }
    }
    result.max_speed = maximum(result.max_speed, Real::of_raw(512 * fastest));
    return result;
}

}  // namespace weir
