#include "solid/thin_sight.hpp"

namespace weir {

namespace {

/// The faces of a particle's two stencils: where they begin, and the box that holds them.
template <class Real>
struct FacesAround {
    Vec2<Real> first_u;
    Vec2<Real> first_v;
    Vec2<Real> low;
    Vec2<Real> high;

    explicit FacesAround(Vec2<Real> point) {
        constexpr Real kHalf = Real(0.5);
        const Vec2<Real> cell{static_cast<Real>(static_cast<std::int32_t>(point.x)),
                              static_cast<Real>(static_cast<std::int32_t>(point.y))};
        const Vec2<Real> middle{
            static_cast<Real>(static_cast<std::int32_t>(point.x + kHalf)) - kHalf,
            static_cast<Real>(static_cast<std::int32_t>(point.y + kHalf)) - kHalf};
        first_u = {cell.x, middle.y};
        first_v = {middle.x, cell.y};
        low = {minimum(cell.x, middle.x), minimum(cell.y, middle.y)};
        high = low + Vec2<Real>{Real(1.5), Real(1.5)};
    }
    bool misses(Vec2<Real> a, Vec2<Real> b) const {
        return maximum(a.x, b.x) < low.x || minimum(a.x, b.x) > high.x ||
               maximum(a.y, b.y) < low.y || minimum(a.y, b.y) > high.y;
    }
    bool holds(Vec2<Real> a) const {
        return low.x <= a.x && a.x <= high.x && low.y <= a.y && a.y <= high.y;
    }
    Vec2<Real> place(std::uint32_t bit) const {
        return (bit < 4 ? first_u : first_v) +
               Vec2<Real>{static_cast<Real>(static_cast<std::int32_t>(bit & 1U)),
                          static_cast<Real>(static_cast<std::int32_t>(bit >> 1U & 1U))};
    }
};

/// Not on the tank's walls.
template <class Real>
bool is_within_tank(const GridShape& s, Vec2<Real> point) {
    return point.x > Real(0) && point.x < static_cast<Real>(s.nx) && point.y > Real(0) &&
           point.y < static_cast<Real>(s.ny);
}

/// Which of four faces lie on the left of an edge, from the cross product of the edge and the way
/// to the first one.
template <class Number>
std::uint32_t on_left(Number first, Number right, Number up) {
    const Number zero{};
    return (first >= zero ? 1U : 0U) | (first + right >= zero ? 2U : 0U) |
           (first + up >= zero ? 4U : 0U) | (first + right + up >= zero ? 8U : 0U);
}

}  // namespace

template <class Real>
std::uint32_t seen_faces(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> point) {
    const FacesAround<Real> faces(point);
    std::uint32_t seen = 0xFFU;
    const auto look = [&](const WallEdge& one) {
        const Vec2<Real> a = thin.vertex[one.from];
        const Vec2<Real> b = thin.vertex[one.to];
        if (faces.misses(a, b)) {
            return;
        }
        const Vec2<Real> edge = b - a;
        const Product<Real> right = product(Real(0) - edge.y, Real(1));
        const Product<Real> up = product(edge.x, Real(1));
        const std::uint32_t left = on_left(cross(edge, faces.first_u - a), right, up) |
                                   on_left(cross(edge, faces.first_v - a), right, up) << 4U;
        std::uint32_t beyond = (is_left_of(point, a, b) ? ~left : left) & seen;
        // What goes all through the box parts it, and what ends at the tank's wall does, too.
        if ((faces.holds(a) && is_within_tank(s, a)) || (faces.holds(b) && is_within_tank(s, b))) {
            for (std::uint32_t bit = 0; bit < 8; ++bit) {
                if ((beyond >> bit & 1U) != 0 && !cross_edge(point, faces.place(bit), a, b).found) {
                    beyond &= ~(1U << bit);
                }
            }
        }
        seen &= ~beyond;
    };
    for_each_edge_around(thin, s, static_cast<std::int32_t>(point.x),
                         static_cast<std::int32_t>(point.y), look);
    return seen;
}

template <class Real>
Vec2<Real> centre_seen(const GridShape& s, const Walls<Real>& walls, Vec2<Real> place) {
    const auto centre_of = [](Real at) {
        return static_cast<Real>(static_cast<std::int32_t>(at)) + Real(0.5);
    };
    const Vec2<Real> own{centre_of(place.x), centre_of(place.y)};
    if (walls.thin == nullptr || (mark_at(*walls.thin, s, place) & kTouching) == 0) {
        return own;
    }
    const Vec2<Real> beside{place.x < own.x ? own.x - Real(1) : own.x + Real(1), own.y};
    const Vec2<Real> along{own.x, place.y < own.y ? own.y - Real(1) : own.y + Real(1)};
    const bool nearer = absolute(place.x - own.x) > absolute(place.y - own.y);
    const Vec2<Real> cells[] = {own, nearer ? beside : along, nearer ? along : beside,
                                {beside.x, along.y}};
    for (const Vec2<Real> centre : cells) {
        if (is_within_tank(s, centre) && !hidden(*walls.thin, s, place, centre)) {
            return centre;
        }
    }
    return own;
}

#define WEIR_INSTANTIATE(Real)                                                               \
    template std::uint32_t seen_faces(const ThinWalls<Real>&, const GridShape&, Vec2<Real>); \
    template Vec2<Real> centre_seen(const GridShape&, const Walls<Real>&, Vec2<Real>);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
