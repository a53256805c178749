// Where liquid may part from a wall.
#pragma once

#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

/// Air that may come between liquid and a wall is in a cell that shows so much of its full density
/// when all around it is full: its centre is clear of the wall. Slivers without liquid do not
/// count: they come and go under any film.
template <class Real>
inline constexpr Real kRoomForAir = Real(0.75);

/// Whether there is air in one of the eight cells around a cell, as far as they are in the tank.
template <class Real>
WEIR_ALWAYS_INLINE bool has_air_around(const PressureFields<Real>& fields,
                                       const ShareOf<Real>* full_density,
                                       const GridShape& s, std::int32_t c) {
    const std::int32_t from_first = c - s.index(0, 0);
    const std::int32_t j = from_first / s.stride;
    const std::int32_t i = from_first - j * s.stride;
    for (std::int32_t y = j > 0 ? j - 1 : j; y <= j + 1 && y < s.ny; ++y) {
        for (std::int32_t x = i > 0 ? i - 1 : i; x <= i + 1 && x < s.nx; ++x) {
            const std::int32_t n = c + (y - j) * s.stride + (x - i);
            if (!(Real(fields.level[n]) > Real(0)) &&
                Real(full_density[n]) >= kRoomForAir<Real>) {
                return true;
            }
        }
    }
    return false;
}

/// Whether liquid may part from walls at all: with surface tension, which packed worlds have none
/// of, it clings to them.
template <class Real>
inline bool may_part(const PressureFields<Real>& fields) {
    return Stored<Real>::coarse || !fields.on_surface;
}

/// Whether liquid in a cell may part from a wall that the cell touches, as its mark says.
template <class Real>
WEIR_ALWAYS_INLINE bool parts_from_wall(const PressureFields<Real>& fields,
                                        const ShareOf<Real>* full_density,
                                        const GridShape& s, std::int32_t c) {
    return fields.inverse_diagonal[c] < VelocityOf<Real>(0) && may_part(fields) &&
           has_air_around(fields, full_density, s, c);
}

/// Pressure of no larger size neither holds liquid to a wall nor pulls at it: there is none but for
/// what a solve leaves. Below 0: no liquid may part.
template <class Real>
inline Real most_slack(const PressureFields<Real>& fields) {
    return may_part(fields) ? kHold<Real> * fields.cell_weight : Real(-1);
}

}  // namespace weir
