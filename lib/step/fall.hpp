// What gravity gives in a substep.
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/scalar.hpp"
#include "math/vec2.hpp"

namespace weir {

/// dt · gravity; in `Fixed` not to the nearest unit, but rounded up from an eighth of one on,
/// three, five, seven in turn. What gravity gives is all that drives a viscous flow: two fifths of
/// a unit in 2,000 too little is a flow that is as much too slow.
template <class Real>
Vec2<Real> fall_in_turn(Seconds<Real> dt_s, Vec2<Real> gravity,
                        [[maybe_unused]] std::uint32_t turn) {
    if constexpr (std::is_same<Real, Fixed>::value) {
        const auto along = [&](Fixed part) {
            constexpr int kShift = Seconds<Fixed>::fraction;
            const auto size = static_cast<std::int32_t>(fixed::magnitude(part.raw));
            const std::int64_t upwards = std::int64_t{7 - 2 * static_cast<int>(turn & 3U)}
                                         << (kShift - 3);
            const std::int32_t units =
                fixed::saturate((fixed::wide_product(dt_s.raw, size) + upwards) >> kShift);
            return Fixed::of_raw(part.raw < 0 ? -units : units);
        };
        return {along(gravity.x), along(gravity.y)};
    } else {  // packed velocities are owed what is less than a unit, by Fall
        return dt_s * gravity;
    }
}

template <class Real, bool Units = Stored<Real>::coarse>
struct Fall {
    static Vec2<Real> of(Vec2<Real> exact, Real) { return exact; }
    static void give(Vec2<Real>, Real) {}
};

/// Packed velocities are known in units, of which a short substep gives few. What is less than one
/// is owed to the next substep: rounded, it would be another gravity, and liquid that falls by more
/// than its weight gains energy each time that it turns.
template <class Real>
struct Fall<Real, true> {
    Vec2<Real> owed;  ///< cells/s, less than a unit

    /// `most`: a fall of that much or more is rounded by itself, so that it is always the same.
    Vec2<Real> of(Vec2<Real> exact, Real most) const {
        return {whole_units(exact.x, owed.x, most), whole_units(exact.y, owed.y, most)};
    }
    /// After it was given.
    void give(Vec2<Real> exact, Real most) {
        owed = {rest(exact.x, owed.x, most), rest(exact.y, owed.y, most)};
    }

private:
    static constexpr std::int32_t kUnit = 1 << 9;

    /// What is to be given, with what is owed if that is the same way.
    static std::int32_t due(Real exact, Real more) {
        return (exact.raw ^ more.raw) < 0 ? exact.raw : (exact + more).raw;
    }
    static Real whole_units(Real exact, Real more, Real most) {
        return absolute(exact) < most ? Real::of_raw(due(exact, more) / kUnit * kUnit)
                                      : Real(VelocityOf<Real>(exact));
    }
    static Real rest(Real exact, Real more, Real most) {
        return Real::of_raw(absolute(exact) < most ? due(exact, more) % kUnit : 0);
    }
};

}  // namespace weir
