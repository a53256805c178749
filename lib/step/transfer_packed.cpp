#include "step/transfer_packed.hpp"

#include "math/packed_arithmetic.hpp"
#include "solid/collide.hpp"
#include "step/places_packed.hpp"
#include "step/tank_walls.hpp"
#include "step/transfer_m0.hpp"
#include "step/ways_packed.hpp"
#include "step/weights_packed.hpp"

namespace weir {

namespace {

using namespace packed;

/// One component of all particles to its faces, `mass` and `momentum` from the first of which.
/// Both in one loop want more registers than there are. @return how often faces were full.
template <bool OnU>
[[gnu::noinline]] std::int32_t scatter(const Particles<Real>& particles, Speed* mass,
                                       Real* momentum, std::int32_t stride) {
    std::int32_t row = stride * kSpeedBytes;
    // Momenta lie twice as far apart as masses.
    const std::uintptr_t to_momentum = whole(reinterpret_cast<std::uintptr_t>(momentum) -
                                             2 * reinterpret_cast<std::uintptr_t>(mass));
    std::int32_t refused = 0;
#if defined(WEIR_LOOPS_OF_M0)
    const auto* place = reinterpret_cast<const char*>(particles.position);
    const std::ptrdiff_t to_velocity = reinterpret_cast<const char*>(particles.velocity) - place +
                                       (OnU ? 0 : kSpeedBytes);
    const char* const end = place + particles.count * Strip::kStep;
    while (place != end) {
        const bool full = add_particles<OnU>(
            place, end, mass, row, to_velocity, to_momentum);
        refused += full ? 1 : 0;
    }
#else
    const Strip strip(particles);
    const std::uint32_t half = kept(kHalf<OnU>);
    const char* const velocities = whole(strip.velocities + (OnU ? 0 : kSpeedBytes));
    for (std::ptrdiff_t k = strip.first; k != 0; k += Strip::kStep) {
        k = whole(k);
        row = whole(row);
        const std::uint32_t at = strip.word(k) + half;
        Speed* m = first_face(mass, at, row);
        const auto w = weights_at(at);
        if (!add_masses(m, further(m, row), w)) {
            ++refused;
            continue;
        }
        const Speed velocity = *reinterpret_cast<const Speed*>(velocities + k);
        Real* p = reinterpret_cast<Real*>(2 * reinterpret_cast<std::uintptr_t>(m) + to_momentum);
        add_momenta(p, further(p, 2 * row), w, velocity.raw);
    }
#endif
    return refused;
}

/// A velocity in 128ths of a cell a second times `scale` · 2^−shift is a way in 2^−14 cells.
struct Clock {
    std::int32_t scale;  ///< below 2^15
    std::int32_t shift;
};

Clock clock_of(Seconds<Real> dt_s) {
    std::int32_t scale = minimum<std::int32_t>(dt_s.raw, (1 << 30) - 1);
    std::int32_t shift = 23;
    for (; scale >= 0x800000; scale >>= 8) {
        shift -= 8;
    }
    while (scale >= 0x8000) {
        scale >>= 1;
        --shift;
    }
    return {scale, shift};
}

#if defined(WEIR_SHORT_PRODUCTS)
/// How far that is what carries a particle, 2^−15 cells a second.
using Pace = Clock;
inline Pace pace_of(const Clock& clock) {
    return clock;
}
inline std::int32_t way_of(const Pace& pace, std::int32_t along) {
    return (((along + 128) >> 8) * pace.scale) >> pace.shift;
}
#else
/// The same where there are products of 64 bits: their upper half.
using Pace = std::int32_t;
inline Pace pace_of(const Clock& clock) {
    return clock.scale << (24 - clock.shift);
}
inline std::int32_t way_of(Pace pace, std::int32_t along) {
#if defined(__ARM_FEATURE_SIMD32)
    std::int32_t way;
    __asm__("smmul %0, %1, %2" : "=r"(way) : "r"((along + 128) & ~255), "r"(pace));
    return way;
#else
    return static_cast<std::int32_t>((std::int64_t{(along + 128) & ~255} * pace) >> 32);
#endif
}
#endif

/// What gathering asks of all particles.
struct Gather {
    const StaggeredGrid<Real>& grid;
    const Transfer<Real>& transfer;
    Pace pace;
    std::int32_t flip;
    std::uint32_t room;  ///< `room_between_walls`
};

/// Of what the velocity was a share, and what the faces give.
inline void change(std::int16_t& own, std::int32_t flip, std::int32_t gained,
                   std::int32_t& fastest) {
    const std::int32_t now = saturated<16>((flip * own + gained * 64 + kept(1 << 13)) >> 14);
    own = static_cast<std::int16_t>(now);
    if (!kLooksAfter) {
        fastest = maximum(fastest, now * now);
    }
}

/// How far it goes, 256ths: bits that nobody uses decide what is rounded. Along x those of its own
/// velocity, `own`, too: what is carried alike from the same place would stay together for good.
inline std::int32_t moves(const Pace& pace, std::int32_t along, std::uint32_t own = 0) {
    const auto bits = static_cast<std::int32_t>(static_cast<std::uint32_t>(along) + own);
    return (way_of(pace, along) + chance(bits, 6)) >> 6;
}

/// Down to what a velocity can be: rounded up, it would be faster than it may.
inline Real limit_of(const Transfer<Real>& transfer) {
    return Real::of_raw(transfer.limit.raw & -512);
}

/// Not inline: few are too fast.
[[gnu::noinline, gnu::cold]] void limit(Vec2<Speed>& v, Real most, TransferResult<Real>& result) {
    const Vec2<Real> slower = limited(Vec2<Real>{v.x, v.y}, most, result);
    v = {Speed(slower.x), Speed(slower.y)};
}

/// Where there are particles that are too fast.
[[gnu::noinline]] void limit_all(const Particles<Real>& particles, Real most,
                                 TransferResult<Real>& result) {
    for (std::int32_t k = 0; k < particles.count; ++k) {
        limit(particles.velocity[k], most, result);
    }
}

/// A sixteenth towards rest, a unit at least, but for what has just been let go. The share of PIC
/// of a small velocity rounds to 0: below 16 units particles kept for ever what they have beyond
/// the flow. What gravity makes of a slope in a step has to be more, or waves stand at their
/// highest.
[[gnu::noinline]] void settle(const Particles<Real>& particles) {
    const auto slower = [](std::int16_t v) {
        constexpr std::int32_t kSlow = 32;
        const bool slow = absolute(std::int32_t{v}) <= kSlow;
        return static_cast<std::int16_t>(slow ? v - (v + (v > 0 ? 15 : -15)) / 16 : v);
    };
    for (std::int32_t k = 0; k < particles.count; ++k) {
        Vec2<Speed>& v = particles.velocity[k];
        v = {Speed::of_raw(slower(v.x.raw)), Speed::of_raw(slower(v.y.raw))};
    }
}

/// Among solids most only go further than half a cell. False: it is not one of those.
[[gnu::noinline]] bool goes_far(const Gather& gather, Vec2<std::int32_t> way, const Strip& strip,
                                std::ptrdiff_t at, TransferResult<Real>& result) {
    constexpr std::int32_t kNear = kLongWay<Real>.raw >> 8;
    const auto is_far = [](std::int32_t part) { return part < -kNear || part > kNear; };
    result.far += is_far(way.x) || is_far(way.y) ? 1 : 0;
    const std::uint32_t both = both_in_word(way.x, way.y);
    const bool goes = simply_goes(longest_ways(false), gather.room, strip.word(at), both);
    if (goes) {
        put_word(strip.places + at, strip.word(at) + both);
    }
    return goes;
}

/// Those few that come to the tank's walls, or go further than a cell. `way`: 256ths.
[[gnu::noinline]] void meet_rare(const Gather& gather, Vec2<std::int32_t> way,
                                   const Strip& strip, std::ptrdiff_t at,
                                   TransferResult<Real>& result) {
    Vec2<Place>& place = strip.place(at);
    Vec2<Speed>& speed = strip.velocity(at);
    if (kLooksAfter) {
        result.max_speed = maximum(result.max_speed, larger_part(convert<Real>(speed)));
    }
    const GridShape& s = gather.grid.shape;
    constexpr std::int32_t kLongest = 2 * 256;
    Vec2<Real> x{Real(place.x) + Real::of_raw(256 * clamp(way.x, -kLongest, kLongest)),
                 Real(place.y) + Real::of_raw(256 * clamp(way.y, -kLongest, kLongest))};
    Vec2<Real> v{speed.x, speed.y};
    meet_tank({static_cast<Real>(s.nx), static_cast<Real>(s.ny)},
              TankBlow<Real>{gather.transfer, nullptr}, x, v);
    place = {Place(x.x), Place(x.y)};
    speed = {Speed(v.x), Speed(v.y)};
    // A conveyor may have made it faster than whatever comes after knows of.
    const Real most = limit_of(gather.transfer);
    const Real fastest = larger_part(convert<Real>(speed));
    if (fastest > most) {
        limit(speed, most, result);
    }
    result.max_speed = maximum(result.max_speed, minimum(fastest, most));
}

#if defined(WEIR_LOOPS_OF_M0)
/// `first`: the first face. `between`: to the same one of the other field.
GatherTask task_of(const Gather& gather, const Particles<Real>& particles, const void* ways,
                   const Speed* first, std::ptrdiff_t between, std::ptrdiff_t component) {
    const std::int32_t row = gather.grid.shape.stride * kSpeedBytes;
    const auto* place = reinterpret_cast<const char*>(particles.position);
    return {place + particles.count * Strip::kStep,
            first,
            row,
            between - row,
            gather.pace.scale,
            gather.pace.shift,
            gather.flip,
            reinterpret_cast<const char*>(particles.velocity) - place + component,
            static_cast<const char*>(ways) - place,
            kChance};
}
#endif

/// Along x: velocities, and how far each particle goes, 256ths, a word. A pass for each component:
/// both want more registers than there are. @return the square of the fastest, or `fastest`.
[[gnu::noinline]] std::int32_t gather_u(const Gather& gather, const Particles<Real>& particles,
                                        void* ways, std::int32_t fastest) {
#if defined(WEIR_LOOPS_OF_M0)
    const auto* place = reinterpret_cast<const char*>(particles.position);
    return gather_along_u(task_of(gather, particles, ways, gather.grid.u + 1,
                                  bytes_between(gather.grid.u, gather.grid.mass_u), 0),
                          place, fastest);
#else
    const std::int32_t row = gather.grid.shape.stride * kSpeedBytes;
    const Speed* first = whole(gather.grid.u + 1);
    const std::ptrdiff_t to_gained = whole(bytes_between(gather.grid.u, gather.grid.mass_u));
    const Pace pace = gather.pace;
    const std::int32_t flip = gather.flip;
    const std::uint32_t half = kept(kHalf<true>);
    const Strip strip(particles);
    char* way = whole(static_cast<char*>(ways) + particles.count * Strip::kStep);
    for (std::ptrdiff_t k = strip.first; k != 0; k += Strip::kStep) {
        k = whole(k);
        const std::uint32_t at = strip.word(k) + half;
        const auto w = weights_at(at);
        const Speed* along = first_face(first, at, row);
        const std::int32_t carried = weighed(along, further(along, row), w);
        put_word(way + k, static_cast<std::uint32_t>(
                              moves(pace, carried, word_at(strip.velocities + k))));
        const Speed* gained = whole(further(along, to_gained));
        change(strip.velocity(k).x.raw, flip, weighed(gained, further(gained, row), w), fastest);
    }
    return fastest;
#endif
}

/// A Cortex-M0 has one loop for both.
#if defined(WEIR_LOOPS_OF_M0)
constexpr bool kAlwaysKeeps = true;
#else
constexpr bool kAlwaysKeeps = false;
#endif

/// Along y, and there they go. `Keeps`: where they come from takes the place of the ways along x.
template <bool Keeps>
[[gnu::noinline]] std::int32_t gather_v(const Gather& gather, const Particles<Real>& particles,
                                        void* ways, std::int32_t fastest,
                                        TransferResult<Real>& result) {
    const std::int32_t row = gather.grid.shape.stride * kSpeedBytes;
#if defined(WEIR_LOOPS_OF_M0)
    const GatherTask task = task_of(gather, particles, ways, further(gather.grid.v, row),
                                    bytes_between(gather.grid.v, gather.grid.mass_v), kSpeedBytes);
    const bool keeps = gather.transfer.keeps_places;
    const Longest most = longest_ways(keeps);
    const WayBounds bounds{2U * kLowest, gather.room, kHalves, most.most, most.far};
    const Strip strip(particles);
    for (const auto* place = reinterpret_cast<const char*>(particles.position);
         place != task.end;) {
        const Stop stop = gather_along_v(task, bounds, place, fastest);
        if (stop.stops != 0) {
            if (!keeps || !goes_far(gather, stop.way, strip, place - task.end, result)) {
                meet_rare(gather, stop.way, strip, place - task.end, result);
            }
            place += Strip::kStep;
        }
    }
#else
    const Speed* first = whole(further(gather.grid.v, row));
    const std::ptrdiff_t to_gained = whole(bytes_between(gather.grid.v, gather.grid.mass_v));
    const Pace pace = gather.pace;
    const std::int32_t flip = gather.flip;
    const std::uint32_t room = gather.room;
    const Strip strip(particles);
    char* const velocities = whole(strip.velocities + kSpeedBytes);
    char* way = whole(static_cast<char*>(ways) + particles.count * Strip::kStep);
    for (std::ptrdiff_t k = strip.first; k != 0; k += Strip::kStep) {
        k = whole(k);
        const std::uint32_t from = strip.word(k);
        const std::uint32_t at = from + kHalf<false>;
        const auto w = weights_at(at);
        const Speed* along = first_face(first, at, row);
        const std::int32_t way_y = moves(pace, weighed(along, further(along, row), w));
        const Speed* gained = whole(further(along, to_gained));
        change(*reinterpret_cast<std::int16_t*>(velocities + k), flip,
               weighed(gained, further(gained, row), w), fastest);
        const std::uint32_t way_x = word_at(way + k);
        if (Keeps) {
            put_word(way + k, from);
        }
        const std::uint32_t both = both_in_word(static_cast<std::int32_t>(way_x), way_y);
        if (simply_goes(longest_ways(Keeps), room, from, both)) {
            put_word(strip.places + k, from + both);
        } else if (const Vec2<std::int32_t> gone{static_cast<std::int32_t>(way_x), way_y};
                   !Keeps || !goes_far(gather, gone, strip, k, result)) {
            meet_rare(gather, gone, strip, k, result);
        }
    }
#endif
    return fastest;
}

}  // namespace

std::int32_t scatter_packed(const Particles<Real>& particles, StaggeredGrid<Real>& grid) {
    const std::int32_t stride = grid.shape.stride;
    return scatter<true>(particles, grid.mass_u + 1, grid.momentum_u() + 1, stride) +
           scatter<false>(particles, grid.mass_v + stride, grid.momentum_v() + stride, stride);
}

TransferResult<Real> gather_packed(const StaggeredGrid<Real>& grid, const Transfer<Real>& transfer,
                                   Particles<Real>& particles) {
    const Gather gather{grid,
                        transfer,
                        pace_of(clock_of(transfer.dt_s)),
                        transfer.flip_ratio.raw >> 2,
                        room_between_walls(grid.shape)};
    alignas(std::uint32_t) unsigned char own[kStripPacked * Strip::kStep];
    void* const ways = transfer.ways != nullptr ? transfer.ways : static_cast<void*>(own);
    const std::int32_t room = transfer.ways != nullptr ? transfer.room : kStripPacked;
    TransferResult<Real> result;
    const std::int32_t known = transfer.max_speed.raw / 512;
    std::int32_t fastest = known * known;
    for (std::int32_t k = 0; k < particles.count; k += room) {
        const Particles<Real> strip = particles.part(k, minimum(room, particles.count - k));
        fastest = gather_u(gather, strip, ways, fastest);
        fastest = (transfer.keeps_places ? gather_v<true> : gather_v<kAlwaysKeeps>)(
            gather, strip, ways, fastest, result);
    }
#if defined(__ARM_FEATURE_SIMD32)
    fastest = maximum(fastest, fastest_of(particles));
#endif
    result.max_speed = maximum(result.max_speed, transfer.max_speed);
    if (fastest > known * known) {
        const std::uint32_t speed =
            fixed::root_below(static_cast<std::uint32_t>(fastest)).root;
        result.max_speed =
            maximum(result.max_speed, Real::of_raw(512 * static_cast<std::int32_t>(speed)));
    }
    if (result.max_speed > transfer.limit) {
        const Real most = limit_of(transfer);
        limit_all(particles, most, result);
        result.max_speed = most;
    }
    if (transfer.settling) {
        settle(particles);
    }
    return result;
}

}  // namespace weir
