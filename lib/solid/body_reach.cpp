#include "solid/body_reach.hpp"

#include "geometry/outline.hpp"

namespace weir {

namespace {

/// A contour is no further than this from the outline that it is of, cells.
constexpr double kFurthestOff = 0.75;

/// The point of an edge that is nearest to x.
template <class Number>
Vec2<Number> nearest_of_edge(Vec2<Number> from, Vec2<Number> to, Vec2<Number> x) {
    const Vec2<Number> way = to - from;
    const Number square = dot(way, way);
    if (!(square > Number(0))) {
        return from;
    }
    return from + clamp(dot(x - from, way) / square, Number(0), Number(1)) * way;
}

/// The point of a body's outline that is nearest to x; x itself, if none is near.
template <class Real>
Vec2<Face<Real>> on_outline(const BodyTable<Real>& table, std::uint16_t slot, Vec2<Real> x) {
    using Number = Face<Real>;
    constexpr Real kOff = Real(kFurthestOff);
    const Vec2<Number> wide = convert<Number>(x);
    Vec2<Number> nearest = wide;
    Number least = Number(kFurthestOff * kFurthestOff);
    for_each_edge(table.outline(table.body[slot]), [&](Vec2<Real> from, Vec2<Real> to) {
        if (minimum(from.x, to.x) - kOff < x.x && x.x < maximum(from.x, to.x) + kOff &&
            minimum(from.y, to.y) - kOff < x.y && x.y < maximum(from.y, to.y) + kOff) {
            const Vec2<Number> at =
                nearest_of_edge(convert<Number>(from), convert<Number>(to), wide);
            const Number square = dot(at - wide, at - wide);
            if (square < least) {
                least = square;
                nearest = at;
            }
        }
    });
    return nearest;
}

}  // namespace

template <class Real>
Impulse<Real> reach_of_face(const BodyTable<Real>& table, const Walls<Real>& walls,
                            const ClosedFace<Real>& face) {
    using Number = Face<Real>;
    const Vec2<Number> centre = table.load[face.slot].at;
    const bool upright = (face.bit & 3) != 0;
    const Vec2<Real> half =
        upright ? Vec2<Real>{Real(0), Real(0.5)} : Vec2<Real>{Real(0.5), Real(0)};
    const Real closed = absolute(face.outward.x) + absolute(face.outward.y);
    const Vec2<Real> low = face.centre - half;
    const Vec2<Real> high = face.centre + half;
    const auto end = [&](std::int32_t node, Vec2<Real> own, Vec2<Real> other) {
        return Real(walls.distance[node]) > Real(0)
                   ? on_outline(table, face.slot, other + closed * (own - other))
                   : convert<Number>(own);
    };
    const Vec2<Number> from = end(face.node, low, high) - centre;
    const Vec2<Number> to = end(face.next, high, low) - centre;
    const Number twice = dot(to - from, to + from);
    const bool turns_right = face.outward.x > Real(0) || face.outward.y < Real(0);
    return {convert<Number>(face.outward), (turns_right ? Number(-0.5) : Number(0.5)) * twice};
}

template <class Real>
Impulse<Real> closed_by_free(const BodyTable<Real>& table, const GridShape& shape,
                             const Walls<Real>& walls, std::uint16_t slot, std::uint16_t other,
                             std::int32_t i, std::int32_t j) {
    using Number = Face<Real>;
    Impulse<Real> own;
    Impulse<Real> its;
    Impulse<Real> all;
    std::uint16_t met[4];
    std::int32_t bodies = 0;
    bool here = false;
    bool its_here = other == kNoBody;
    for_each_closed_face(shape, walls, i, j, [&](const ClosedFace<Real>& face) {
        if (face.slot == kNoBody || !walls.load[face.slot].is_free()) {
            return;
        }
        std::int32_t k = 0;
        while (k < bodies && met[k] != face.slot) {
            ++k;
        }
        met[k] = face.slot;
        bodies = maximum(bodies, k + 1);
        Impulse<Real> reach = reach_of_face(table, walls, face);
        reach.angular += cross(table.load[face.slot].at - table.load[slot].at, reach.linear);
        all.add(reach);
        if (face.slot == slot) {
            own.add(reach);
            here = true;
        } else if (face.slot == other) {
            its.add(reach);
            its_here = true;
        }
    });
    if (bodies < 2 || !here || !its_here) {
        return {};
    }
    const Number share = Number(1) / static_cast<Number>(bodies);
    if (other == kNoBody) {
        return {own.linear - share * all.linear, own.angular - share * all.angular};
    }
    return {share * (own.linear - its.linear), share * (own.angular - its.angular)};
}

template <class Real>
Impulse<Real> impulse_on_free(const GridShape& shape, const BodyTable<Real>& table,
                              const Walls<Real>& walls, std::uint16_t slot,
                              const PressedCells<Real>& cells) {
    Impulse<Real> impulse;
    for_each_beside(shape, walls, slot, cells, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
        const PressureAtRest<Real> at_rest(shape, walls, c, cells);
        CellReach<Real> cell;
        for_each_closed_face(shape, walls, i, j, [&](const ClosedFace<Real>& face) {
            if (face.slot == slot) {
                cell.add(reach_of_face(table, walls, face), at_rest.more_at(walls, face));
            }
        });
        if (cell.any) {
            impulse.add(cell.impulse(cells.pressure[c]));
        }
    });
    return impulse;
}

#define WEIR_INSTANTIATE(Real)                                                              \
    template Impulse<Real> reach_of_face(const BodyTable<Real>&, const Walls<Real>&,        \
                                         const ClosedFace<Real>&);                          \
    template Impulse<Real> closed_by_free(const BodyTable<Real>&, const GridShape&,         \
                                          const Walls<Real>&, std::uint16_t, std::uint16_t, \
                                          std::int32_t, std::int32_t);                      \
    template Impulse<Real> impulse_on_free(const GridShape&, const BodyTable<Real>&,        \
                                           const Walls<Real>&, std::uint16_t,               \
                                           const PressedCells<Real>&);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
