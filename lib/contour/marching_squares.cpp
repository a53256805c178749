// Marching squares by table: each case names the cell edges that its lines cross.
#include "contour/marching_squares.hpp"

namespace weir {

namespace {

enum Edge : std::uint8_t { kBottom, kRight, kTop, kLeft };

/// The two nodes of each edge, from lower to higher coordinate in every cell, so that the two
/// cells at an edge compute the same crossing.
struct EdgeNodes {
    std::uint8_t low;
    std::uint8_t high;
};
constexpr EdgeNodes kEdgeNodes[4] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}};

/// The horizontal and the vertical edge that meet at each node.
struct NodeEdges {
    Edge horizontal;
    Edge vertical;
};
constexpr NodeEdges kNodeEdges[4] = {
    {kBottom, kLeft}, {kBottom, kRight}, {kTop, kRight}, {kTop, kLeft}};

struct Crossing {
    Edge from;
    Edge to;
};
struct CaseLines {
    std::uint8_t lines;
    Crossing crossing[2];
};

// Solid on the right of from → to. Saddles stand here with separate solids.
constexpr CaseLines kCases[16] = {
    {0, {}},
    {1, {{kLeft, kBottom}}},
    {1, {{kBottom, kRight}}},
    {1, {{kLeft, kRight}}},
    {1, {{kRight, kTop}}},
    {2, {{kLeft, kBottom}, {kRight, kTop}}},
    {1, {{kBottom, kTop}}},
    {1, {{kLeft, kTop}}},
    {1, {{kTop, kLeft}}},
    {1, {{kTop, kBottom}}},
    {2, {{kBottom, kRight}, {kTop, kLeft}}},
    {1, {{kTop, kRight}}},
    {1, {{kRight, kLeft}}},
    {1, {{kRight, kBottom}}},
    {1, {{kBottom, kLeft}}},
    {0, {}},
};
// Joined solids: the lines cut off the two open corners.
constexpr CaseLines kJoined5 = {2, {{kRight, kBottom}, {kLeft, kTop}}};
constexpr CaseLines kJoined10 = {2, {{kBottom, kLeft}, {kTop, kRight}}};

template <class Real>
bool solids_joined(const Real distance[4]) {
    return (distance[0] + distance[2]) + (distance[1] + distance[3]) <= Real(0);
}

const CaseLines& lines_of(std::uint8_t solid_nodes, bool joined) {
    if (joined && solid_nodes == 5) {
        return kJoined5;
    }
    return joined && solid_nodes == 10 ? kJoined10 : kCases[solid_nodes];
}

/// Of two numbers above 0 one over the other, which is no smaller. Those of packed worlds are
/// 256ths: one division of 32 bits.
template <class Real>
Real share_of(Real part, Real whole) {
    return part / whole;
}
template <>
inline SmallFixed share_of(SmallFixed part, SmallFixed whole) {
    if (((part.raw | whole.raw) & ~0xFFFF00) != 0) {
        return part / whole;
    }
    const auto divisor = static_cast<std::uint32_t>(whole.raw >> 8);
    const auto size = (static_cast<std::uint32_t>(part.raw) << 8U) + divisor / 2U;
    return SmallFixed::of_raw(static_cast<std::int32_t>(size / divisor));
}

/// Where the contour crosses an edge whose nodes are on different sides: one distance is positive
/// and the other is not, so the divisor is never 0 and the quotient never beyond 0 … 1.
template <class Real>
Vec2<Real> crossing_point(const Real distance[4], Edge edge) {
    const Real low = distance[kEdgeNodes[edge].low];
    const Real high = distance[kEdgeNodes[edge].high];
    const Real at = low / (low - high);
    switch (edge) {
        case kBottom: return {at, Real(0)};
        case kRight: return {Real(1), at};
        case kTop: return {at, Real(1)};
        default: return {Real(0), at};
    }
}

template <class Real>
Real slope(const Real distance[4], Edge edge) {
    return distance[kEdgeNodes[edge].high] - distance[kEdgeNodes[edge].low];
}

/// Of a vector that is not 0. Packed worlds: to 2^−14, by a root of 32 bits and two divisions.
inline Vec2<SmallFixed> packed_unit(Vec2<SmallFixed> v) {
    std::uint32_t x = fixed::magnitude(v.x.raw);
    std::uint32_t y = fixed::magnitude(v.y.raw);
    for (; (x | y) >= 1U << 14U; y >>= 1U) {
        x >>= 1U;
    }
    for (; (x | y) < 1U << 13U && (x | y) != 0; y <<= 1U) {
        x <<= 1U;
    }
    const std::uint32_t length = maximum(fixed::root_below(4U * (x * x + y * y)).root, 1U);
    const auto part = [length](std::uint32_t of, std::int32_t sign) {
        const auto size = static_cast<std::int32_t>(((of << 17U) + length / 2U) / length);
        return SmallFixed::of_raw(sign < 0 ? -size : size);
    };
    return {part(x, v.x.raw), part(y, v.y.raw)};
}

/// Scaled by the larger part first: the squares of tiny distances would vanish.
template <class Real>
Vec2<Real> unit(Vec2<Real> v) {
    if constexpr (Stored<Real>::coarse) {
        return packed_unit(v);
    }
    const Real larger = larger_part(v);
    const Vec2<Real> scaled{v.x / larger, v.y / larger};
    const Real size = length(scaled);
    return {scaled.x / size, scaled.y / size};
}

constexpr bool is_horizontal(Edge edge) { return edge == kBottom || edge == kTop; }

/// From a line that begins at `from` into the liquid, of any length. Across a corner the line is as
/// short as it likes, down to a point when the node is at 0. The slopes of the distance along the
/// two crossed edges are perpendicular to the same line (similar triangles), point into the liquid,
/// and are never 0.
template <class Real>
Vec2<Real> out_of_line(const Real distance[4], Crossing crossing, Vec2<Real> from) {
    const bool horizontal_first = is_horizontal(crossing.from);
    if (horizontal_first == is_horizontal(crossing.to)) {
        const Vec2<Real> along = crossing_point(distance, crossing.to) - from;
        return {-along.y, along.x};
    }
    return {slope(distance, horizontal_first ? crossing.from : crossing.to),
            slope(distance, horizontal_first ? crossing.to : crossing.from)};
}

template <class Real>
ContourLine<Real> contour_line(const Real distance[4], Crossing crossing) {
    const Vec2<Real> from = crossing_point(distance, crossing.from);
    return {from, crossing_point(distance, crossing.to),
            unit(out_of_line(distance, crossing, from))};
}

/// Open part of an edge of a cell.
template <class Real>
Real open_part(const Real distance[4], Edge edge) {
    return open_fraction(distance[kEdgeNodes[edge].low], distance[kEdgeNodes[edge].high]);
}

/// Open area where every line cuts off a corner: triangles of solid off a full cell, or, with
/// three solid nodes or joined solids, triangles of liquid alone.
template <class Real>
Real corner_area(const Real distance[4], std::uint32_t solid_nodes) {
    const bool saddle = solid_nodes == 5 || solid_nodes == 10;
    const bool one_solid = (solid_nodes & (solid_nodes - 1U)) == 0;
    const bool open_corners = saddle ? solids_joined(distance) : !one_solid;
    Real area = open_corners ? Real(0) : Real(1);
    for (std::uint32_t node = 0; node < 4; ++node) {
        if ((((solid_nodes >> node) & 1U) != 0) == open_corners) {
            continue;
        }
        const Real across = open_part(distance, kNodeEdges[node].horizontal);
        const Real up = open_part(distance, kNodeEdges[node].vertical);
        area = open_corners ? area + Real(0.5) * (across * up)
                            : area - Real(0.5) * ((Real(1) - across) * (Real(1) - up));
    }
    return area;
}

/// By Green's theorem an integral over the liquid is one along its rim, over y, of what is
/// integrated over x from the cell's left edge on. Upper and lower edge give nothing, nor does the
/// left one.
template <class Real>
OpenMoments<Real> right_edge(Real low, Real high) {
    const auto square = [](Real y) { return Real(0.5) * (y * y); };
    const Real way = high - low;
    const Real up = square(high) - square(low);
    const Real above = square(maximum(high, Real(0))) - square(maximum(low, Real(0)));
    const Real none = Real(0);
    const Real eighth = Real(0.125);
    return {way, {none, up}, {eighth * way, above}, none, eighth * up, none};
}

/// A straight piece that lies in one quadrant: Simpson's rule is exact.
template <class Real>
void add_piece(Vec2<Real> p, Vec2<Real> q, OpenMoments<Real>& sums) {
    const Vec2<Real> m = Real(0.5) * (p + q);
    const Real way = q.y - p.y;
    const auto along = [&](Real at_p, Real at_m, Real at_q) {
        return way * ((at_p + at_q + Real(4) * at_m) * Real(1.0 / 6.0));
    };
    const auto half = [](Real x) { return Real(0.5) * (x * x) - Real(0.125); };
    const Real half_p = half(p.x);
    const Real half_m = half(m.x);
    const Real half_q = half(q.x);
    const Real x = along(half_p, half_m, half_q);
    const auto wide = [](Vec2<Real> at) { return (at.x + Real(0.5)) * at.y; };
    const Real y = along(wide(p), wide(m), wide(q));
    const Real xy = along(half_p * p.y, half_m * m.y, half_q * q.y);
    sums.area += way * (m.x + Real(0.5));
    sums.first.x += x;
    sums.first.y += y;
    sums.product += xy;
    if (m.x > Real(0)) {
        sums.upper.x += x + Real(0.125) * way;
        sums.y_right += xy + Real(0.125) * (way * m.y);
    }
    if (m.y > Real(0)) {
        sums.upper.y += y;
        sums.x_above += xy;
    }
}

/// Where on its way from `from` to `to` a coordinate passes 0; 1 if it does not.
template <class Real>
Real passes_zero(Real from, Real to) {
    const bool passes = (from > Real(0)) != (to > Real(0));
    return passes ? from / (from - to) : Real(1);
}

template <class Real>
void add_line(Vec2<Real> from, Vec2<Real> to, OpenMoments<Real>& sums) {
    const Real on_x = passes_zero(from.x, to.x);
    const Real on_y = passes_zero(from.y, to.y);
    const Real parts[] = {minimum(on_x, on_y), maximum(on_x, on_y), Real(1)};
    Vec2<Real> p = from;
    for (const Real part : parts) {
        const Vec2<Real> q = part < Real(1) ? from + part * (to - from) : to;
        if (q.y != p.y) {
            add_piece(p, q, sums);
        }
        p = q;
    }
}

template <class Real>
Vec2<Real> about_centre(Vec2<Real> p) {
    return {p.x - Real(0.5), p.y - Real(0.5)};
}

}  // namespace

template <class Real>
std::uint8_t contour_case(const Real distance[4]) {
    std::uint32_t solid_nodes = 0;
    for (std::uint32_t node = 0; node < 4; ++node) {
        solid_nodes |= (distance[node] <= Real(0) ? 1U : 0U) << node;
    }
    return static_cast<std::uint8_t>(solid_nodes);
}

template <class Real>
ContourCell<Real> contour_cell(const Real distance[4]) {
    const std::uint8_t solid_nodes = contour_case(distance);
    const bool joined = solids_joined(distance);
    const CaseLines& table = lines_of(solid_nodes, joined);
    ContourCell<Real> cell;
    cell.lines = table.lines;
    cell.both_needed = table.lines == 2 ? joined : solid_nodes == 15;
    for (std::int32_t i = 0; i < cell.lines; ++i) {
        cell.line[i] = contour_line(distance, table.crossing[i]);
    }
    return cell;
}

template <class Real>
ContourHit<Real> contour_hit(const Real distance[4], Vec2<Real> p) {
    const std::uint8_t solid_nodes = contour_case(distance);
    const bool joined = solids_joined(distance);
    const CaseLines& table = lines_of(solid_nodes, joined);
    if (table.lines == 0) {
        return {solid_nodes == 15 ? Real(-1) : Real(1), {}};
    }
    ContourHit<Real> hit{};
    for (std::int32_t i = 0; i < table.lines; ++i) {
        const Vec2<Real> from = crossing_point(distance, table.crossing[i].from);
        const Vec2<Real> normal = unit(out_of_line(distance, table.crossing[i], from));
        const Real depth = dot(p - from, normal);
        // Behind both: the shallower line is the way out. Behind any: the deeper one is.
        if (i == 0 || (joined ? depth > hit.distance : depth < hit.distance)) {
            hit = {depth, normal};
        }
    }
    return hit;
}

template <class Real>
Real open_fraction(Real distance_0, Real distance_1) {
    const bool solid_0 = distance_0 <= Real(0);
    const bool solid_1 = distance_1 <= Real(0);
    if (solid_0 == solid_1) {
        return solid_0 ? Real(0) : Real(1);
    }
    const Real outside = solid_0 ? distance_1 : distance_0;
    const Real inside = solid_0 ? distance_0 : distance_1;
    return share_of(outside, outside - inside);
}

template <class Real>
Real open_area(const Real distance[4]) {
    const auto half_of = [&](Edge one, Edge other) {
        return Real(0.5) * (open_part(distance, one) + open_part(distance, other));
    };
    const std::uint8_t solid_nodes = contour_case(distance);
    switch (solid_nodes) {
        case 0: return Real(1);
        case 15: return Real(0);
        case 3:
        case 12: return half_of(kLeft, kRight);
        case 6:
        case 9: return half_of(kBottom, kTop);
        default: return corner_area(distance, solid_nodes);
    }
}

template <class Real>
OpenMoments<Real> open_moments(const Real distance[4]) {
    const std::uint8_t solid_nodes = contour_case(distance);
    const bool low_solid = (solid_nodes & 2U) != 0;
    const bool high_solid = (solid_nodes & 4U) != 0;
    const Real half = Real(0.5);
    const Real crossing =
        low_solid != high_solid ? crossing_point(distance, kRight).y - half : half;
    OpenMoments<Real> sums =
        right_edge(low_solid ? crossing : -half, high_solid ? crossing : half);
    const CaseLines& table = lines_of(solid_nodes, solids_joined(distance));
    for (std::int32_t i = 0; i < table.lines; ++i) {
        add_line(about_centre(crossing_point(distance, table.crossing[i].from)),
                 about_centre(crossing_point(distance, table.crossing[i].to)), sums);
    }
    return sums;
}

#define WEIR_INSTANTIATE(Real)                                                        \
    template std::uint8_t contour_case(const Real*);                                  \
    template ContourCell<Real> contour_cell(const Real*);                             \
    template ContourHit<Real> contour_hit(const Real*, Vec2<Real>);                   \
    template Real open_fraction(Real, Real);                                          \
    template Real open_area(const Real*);                                             \
    template OpenMoments<Real> open_moments(const Real*);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
