#include "solid/way_out.hpp"

#include "solid/contour_hit.hpp"

namespace weir {

namespace {

/// The places of a cell along one axis, as parts of its edge: near its rim, but off it, so that
/// rounding keeps them in it, and where the particle is in its own cell, so that particles that go
/// out side by side do not meet.
template <class Real>
struct Places {
    Real part[3];

    explicit Places(Real from)
        : part{kOffRim, clamp(from - static_cast<Real>(static_cast<std::int32_t>(from)), kOffRim,
                              Real(1) - kOffRim),
               Real(1) - kOffRim} {}

private:
    static constexpr Real kOffRim = Real(0.0625);
};

template <class Real>
struct Nearest {
    Vec2<Real> place;
    Product<Real> square{};  ///< of its distance
    bool found = false;
};

/// `Whole`: all of the tank is stored.
template <bool Whole, class Real>
void look_into(const GridShape& s, const Walls<Real>& walls, std::int32_t i, std::int32_t j,
               Vec2<Real> from, const Places<Real>& along_x, const Places<Real>& along_y,
               Nearest<Real>& nearest) {
    const std::uint8_t which =
        Whole ? walls.cell_case[s.index(i, j)] : case_in_window(s, walls, i, j);
    if (which == kCellInside) {
        return;
    }
    for (const Real part_y : along_y.part) {
        for (const Real part_x : along_x.part) {
            const Vec2<Real> place{static_cast<Real>(i) + part_x, static_cast<Real>(j) + part_y};
            const Vec2<Real> way = place - from;
            const Product<Real> square = dot(way, way);
            if (nearest.found && !(square < nearest.square)) {
                continue;
            }
            const auto is_inside = [&] {
                return Whole ? is_inside_in(s, walls, place)
                             : standing(s, walls, place).inside;
            };
            if (which == kCellOutside || !is_inside()) {
                nearest = {place, square, true};
            }
        }
    }
}

template <bool Whole, class Real>
bool search(const GridShape& s, const Walls<Real>& walls, Vec2<Real> point, std::int32_t reach,
            Vec2<Real>& place) {
    const auto ci = static_cast<std::int32_t>(point.x);
    const auto cj = static_cast<std::int32_t>(point.y);
    const Places<Real> along_x(point.x);
    const Places<Real> along_y(point.y);
    Nearest<Real> nearest;
    for (std::int32_t ring = 0; ring <= reach; ++ring) {
        // Cells of a ring are at least ring − 1 cells away.
        const Product<Real> least = static_cast<Product<Real>>((ring - 1) * (ring - 1));
        if (nearest.found && ring > 0 && nearest.square <= least) {
            break;
        }
        const std::int32_t low = maximum(cj - ring, 0);
        const std::int32_t high = minimum(cj + ring, s.ny - 1);
        for (std::int32_t j = low; j <= high; ++j) {
            const bool whole_row = j == cj - ring || j == cj + ring;
            const std::int32_t step = whole_row || ring == 0 ? 1 : 2 * ring;
            for (std::int32_t i = ci - ring; i <= ci + ring; i += step) {
                if (i >= 0 && i < s.nx) {
                    look_into<Whole>(s, walls, i, j, point, along_x, along_y, nearest);
                }
            }
        }
    }
    place = nearest.place;
    return nearest.found;
}

}  // namespace

template <class Real>
bool nearest_free_place(const GridShape& s, const Walls<Real>& walls, Vec2<Real> point,
                        std::int32_t reach, Vec2<Real>& place) {
    if constexpr (kHasWindow<Real>) {
        if (!all_stored(walls)) {
            return search<false>(s, walls, point, reach, place);
        }
    }
    return search<true>(s, walls, point, reach, place);
}

#define WEIR_INSTANTIATE(Real)                                                         \
    template bool nearest_free_place(const GridShape&, const Walls<Real>&, Vec2<Real>, \
                                     std::int32_t, Vec2<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
