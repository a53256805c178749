#include "contour/raster.hpp"

#include "contour/raster_lanes.hpp"

namespace weir {

namespace {

/// A node this near to the outline lies on it, cells: a body that ends on a grid line, or on the
/// tank's wall, leaves no crack there by rounding.
template <class Real>
constexpr Real kOnTheOutline = Real(1.0 / 16384.0);

/// Larger than any distance within a tank, cells.
template <class Real>
constexpr Real kDeepest = Real(1.0e6);

/// Edges flatter than this meet a row everywhere at once.
template <class Real>
constexpr Real kFlat = Real(1.0 / 64.0);

/// The box, and the polygon's own distances at its nodes.
template <class Real>
struct Sheet {
    NodeBox box;
    Real* value;
    std::int32_t origin;
    std::int32_t stride;

    Real* row(std::int32_t j) const { return value + origin + j * stride; }
};

/// First and last whole number of an interval, within limits.
struct Span {
    std::int32_t first;
    std::int32_t last;
};

/// Limited before the conversion: a body may be far outside.
template <class Real>
Span whole_numbers(Real from, Real to, std::int32_t first, std::int32_t last) {
    const Real low = static_cast<Real>(first);
    const Real high = static_cast<Real>(last);
    return {from > low ? ceil_to_int(minimum(from, high + Real(1))) : first,
            to < high ? floor_to_int(maximum(to, low - Real(1))) : last};
}

/// Distance from the nodes of one row to one edge, where it is the least so far.
template <class Real>
struct EdgeRow {
    Vec2<Real> from;
    Vec2<Real> edge;
    Vec2<Real> along;  ///< unit
    Real size;

    void measure(Real* row, const Span& nodes, Real y) const {
        const Real dy = y - from.y;
        const Real along_dy = along.y * dy;
        const Real across_dy = along.x * dy;
        for (std::int32_t i = nodes.first; i <= nodes.last; ++i) {
            const Real dx = static_cast<Real>(i) - from.x;
            const Real at = along.x * dx + along_dy;
            const Real nearest = row[i];
            if (at < Real(0) || at > size) {
                const Vec2<Real> arm = at < Real(0) ? Vec2<Real>{dx, dy}
                                                    : Vec2<Real>{dx - edge.x, dy - edge.y};
                const Real square = dot(arm, arm);
                row[i] = square < nearest * nearest ? square_root(square) : nearest;
            } else {
                row[i] = minimum(nearest, absolute(across_dy - along.y * dx));
            }
        }
    }
};

/// An edge and the nodes within `far` of it.
template <class Real>
void measure_edge(Vec2<Real> from, Vec2<Real> to, Real far, const Sheet<Real>& sheet) {
    const Vec2<Real> edge = to - from;
    const Real size = length(edge);
    if (!(size > Real(0))) {
        return;
    }
    const EdgeRow<Real> measured{from, edge, {edge.x / size, edge.y / size}, size};
    const bool steep = absolute(measured.along.y) > kFlat<Real>;
    const Real run = steep ? measured.along.x / measured.along.y : Real(0);
    const Real reach = steep ? far / absolute(measured.along.y) : Real(0);
    const Real left = minimum(from.x, to.x) - far;
    const Real right = maximum(from.x, to.x) + far;
    const NodeBox& box = sheet.box;
    const Span rows = whole_numbers(minimum(from.y, to.y) - far, maximum(from.y, to.y) + far,
                                    box.j0, box.j1);
    for (std::int32_t j = rows.first; j <= rows.last; ++j) {
        const Real y = static_cast<Real>(j);
        const Real middle = from.x + (y - from.y) * run;
        const Span nodes = whole_numbers(steep ? maximum(left, middle - reach) : left,
                                         steep ? minimum(right, middle + reach) : right,
                                         box.i0, box.i1);
        measured.measure(sheet.row(j), nodes, y);
    }
}

/// Turns the sign of all nodes to the right of an edge.
template <class Real>
void turn_signs(Vec2<Real> from, Vec2<Real> to, const Bounds<Real>& tank,
                const Sheet<Real>& sheet) {
    constexpr Real kMoved = Real(1.0 / 512.0);  // `off_the_border` moves no node by as much
    const NodeBox& box = sheet.box;
    const Span rows = whole_numbers(minimum(from.y, to.y) - kMoved,
                                    maximum(from.y, to.y) + kMoved, box.j0, box.j1);
    for (std::int32_t j = rows.first; j <= rows.last; ++j) {
        const Real y = off_the_border(tank, Vec2<Real>{Real(0), static_cast<Real>(j)}).y;
        if ((from.y <= y) == (to.y <= y)) {
            continue;
        }
        const Real crossing = from.x + ((y - from.y) / (to.y - from.y)) * (to.x - from.x);
        const auto right_of = [&](std::int32_t i) {
            return off_the_border(tank, Vec2<Real>{static_cast<Real>(i), Real(0)}).x >= crossing;
        };
        std::int32_t i = whole_numbers(crossing - kMoved, crossing, box.i0, box.i1).first;
        while (i <= box.i1 && !right_of(i)) {
            ++i;
        }
        Real* row = sheet.row(j);
        for (; i <= box.i1; ++i) {
            row[i] = Real(0) - row[i];  // not -row[i]: no negative zero
        }
    }
}

/// A node that no edge reached is at most a cell deeper than its neighbours.
template <class Real>
Real deep_distance(const RasterPolygon<Real>& polygon, const Sheet<Real>& sheet, std::int32_t i,
                   std::int32_t j) {
    Real bound = kDeepest<Real>;
    if (i > sheet.box.i0 && sheet.row(j)[i - 1] < Real(0)) {
        bound = minimum(bound, Real(1.001) - sheet.row(j)[i - 1]);
    }
    if (j > sheet.box.j0 && sheet.row(j - 1)[i] < Real(0)) {
        bound = minimum(bound, Real(1.001) - sheet.row(j - 1)[i]);
    }
    const Vec2<Real> point{static_cast<Real>(i), static_cast<Real>(j)};
    const Real depth = distance_to_outline(polygon.outline, point, bound, polygon.tank);
    return Real(0) - (depth < bound ? depth : kDeepest<Real>);
}

template <class Real>
void measure(const RasterPolygon<Real>& polygon, Real far, const Sheet<Real>& sheet) {
    const NodeBox& box = sheet.box;
    for (std::int32_t j = box.j0; j <= box.j1; ++j) {
        for (std::int32_t i = box.i0; i <= box.i1; ++i) {
            sheet.row(j)[i] = far;
        }
    }
    for_each_edge(polygon.outline, [&](Vec2<Real> from, Vec2<Real> to) {
        if (!beyond(polygon.tank, from, to)) {
            measure_edge(from, to, far, sheet);
        }
    });
    for_each_edge(polygon.outline, [&](Vec2<Real> from, Vec2<Real> to) {
        turn_signs(from, to, polygon.tank, sheet);
    });
}

template <class Real>
void merge_node(const RasterPolygon<Real>& polygon, const Sheet<Real>& sheet, bool binary,
                Real far, std::int32_t i, std::int32_t j, const NodeField<Real>& field) {
    Real* row = sheet.row(j);
    if (!(row[i] < kOnTheOutline<Real>)) {
        row[i] = binary ? Real(0.5) : row[i];
    } else if (binary) {
        row[i] = Real(-0.5);
    } else {
        row[i] = row[i] <= Real(0) - far ? deep_distance(polygon, sheet, i, j)
                                         : minimum(row[i], Real(0));
    }
    const std::int32_t node = field.origin + j * field.stride + i;
    // Of two equally near the lower name, whichever was drawn first.
    const Real stored = field.distance[node];
    const bool named = has_names<Real>(field.nearest);
    if (row[i] < stored || (named && row[i] == stored && row[i] < far &&
                            polygon.name < field.nearest[node])) {
        field.distance[node] = row[i];
        if (named) {
            field.nearest[node] = polygon.name;
        }
    }
}

#if WEIR_HAS_LANES

constexpr RasterLoops kRasterByFour{4, prepare_edges<FourLanes>, measure_nodes<FourLanes>,
                                    turn_nodes<FourLanes>, merge_nodes<FourLanes>};

const RasterLoops& raster_loops() {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        return raster_by_eight;
    }
#endif
    return kRasterByFour;
}

/// Rows of groups that hold a box; none if the rows that are stored are shorter than one.
Span columns_of_groups(const NodeBox& box, std::int32_t lanes, const NodeField<float>& field) {
    if (box.i1 - box.i0 + 1 >= lanes) {
        return {box.i0, box.i1};
    }
    const std::int32_t last = maximum(box.i1, minimum(box.i0 + lanes - 1, field.last_column));
    const std::int32_t first = last + 1 - lanes;
    return {first, field.last_column < 0 || first < field.first_column ? first - 1 : last};
}

/// visit(edges) for all edges of an outline, so many at a time.
template <class Visit>
void for_some_edges(const RasterPolygon<float>& polygon, const RasterLoops& loops,
                    const RasterTask& task, RasterEdges& edges, const Visit& visit) {
    const Outline<float>& outline = polygon.outline;
    for (std::int32_t ring = 0; ring < outline.rings; ++ring) {
        const std::int32_t end = outline.end_of(ring);
        const std::int32_t first = outline.begin_of(ring);
        Vec2<float> corner = outline.vertex[end - 1];
        for (std::int32_t at = first; at < end; at += edges.count) {
            edges.count = minimum(RasterEdges::kMost, end - at);
            edges.x[0] = corner.x;
            edges.y[0] = corner.y;
            for (std::int32_t k = 0; k < edges.count; ++k) {
                corner = outline.vertex[at + k];
                edges.x[k + 1] = corner.x;
                edges.y[k + 1] = corner.y;
            }
            for (std::int32_t k = edges.count + 1; k % 8 != 1; ++k) {
                edges.x[k] = corner.x;
                edges.y[k] = corner.y;
            }
            loops.prepare(task, edges);
            visit();
        }
    }
}

/// The polygon's own distances. Those of few edges are prepared once.
void measure_in_lanes(const RasterPolygon<float>& polygon, const RasterLoops& loops,
                      const RasterTask& task) {
    RasterEdges edges;
    bool anew = true;
    for_some_edges(polygon, loops, task, edges, [&] {
        loops.measure(task, edges, anew);
        anew = false;
    });
    if (polygon.outline.count == edges.count) {
        loops.turn(task, edges);
        return;
    }
    for_some_edges(polygon, loops, task, edges, [&] { loops.turn(task, edges); });
}

/// As the plain loops. False: the box is too narrow.
bool rasterize_in_lanes(const RasterPolygon<float>& polygon, float far,
                        const Sheet<float>& sheet, const NodeField<float>& field) {
    const RasterLoops& loops = raster_loops();
    const NodeBox& box = sheet.box;
    const Span columns = columns_of_groups(box, loops.lanes, field);
    if (columns.last < columns.first) {
        return false;
    }
    const Vec2<float> low = off_the_border(polygon.tank, polygon.tank.low);
    const Vec2<float> high = off_the_border(polygon.tank, polygon.tank.high);
    const Bounds<float> wall = walls_of(polygon.tank);
    const RasterTask task{box.i0, box.j0, box.i1, box.j1, columns.first, columns.last + 1,
                          low.x, low.y, high.x, high.y,
                          wall.low.x, wall.low.y, wall.high.x, wall.high.y,
                          far, kFlat<float>, kOnTheOutline<float>, polygon.name,
                          sheet.value + field.origin, field.distance + field.origin,
                          field.nearest + field.origin, field.stride};
    measure_in_lanes(polygon, loops, task);
    for (RasterPlace at{task.first, box.j0}; loops.merge(task, at); at.i += loops.lanes) {
        const std::int32_t first = minimum(at.i, task.end - loops.lanes);
        const std::int32_t last = minimum(first + loops.lanes - 1, box.i1);
        for (std::int32_t i = maximum(first, box.i0); i <= last; ++i) {
            merge_node(polygon, sheet, false, far, i, at.j, field);
        }
    }
    return true;
}

#endif

}  // namespace

template <class Real>
NodeBox nodes_near(const Vec2<Real>* ring, std::int32_t count, Real margin, std::int32_t last_i,
                   std::int32_t last_j) {
    Vec2<Real> low = ring[0];
    Vec2<Real> high = ring[0];
    for (std::int32_t k = 1; k < count; ++k) {
        low = {minimum(low.x, ring[k].x), minimum(low.y, ring[k].y)};
        high = {maximum(high.x, ring[k].x), maximum(high.y, ring[k].y)};
    }
    // Limited to the grid before the conversion: a body may be far outside.
    const auto node = [](Real value, std::int32_t last) {
        return floor_to_int(clamp(value, Real(-1), static_cast<Real>(last + 1)));
    };
    return {maximum(0, node(low.x - margin, last_i) + 1),
            maximum(0, node(low.y - margin, last_j) + 1),
            minimum(last_i, node(high.x + margin, last_i)),
            minimum(last_j, node(high.y + margin, last_j))};
}

template <class Real>
std::int32_t rasterize(const RasterPolygon<Real>& polygon, const NodeBox& box, bool binary,
                       Real far, Real* scratch, const NodeField<Real>& field) {
    const Sheet<Real> sheet{box, scratch, field.origin, field.stride};
    const std::int32_t nodes = (box.i1 - box.i0 + 1) * (box.j1 - box.j0 + 1);
#if WEIR_HAS_LANES
    if constexpr (kHasLanes<Real>) {
        if (!binary && rasterize_in_lanes(polygon, far, sheet, field)) {
            return nodes;
        }
    }
#endif
    measure(polygon, far, sheet);
    for (std::int32_t j = box.j0; j <= box.j1; ++j) {
        for (std::int32_t i = box.i0; i <= box.i1; ++i) {
            merge_node(polygon, sheet, binary, far, i, j, field);
        }
    }
    return nodes;
}

#define WEIR_INSTANTIATE(Real)                                                              \
    template NodeBox nodes_near(const Vec2<Real>*, std::int32_t, Real, std::int32_t,        \
                                std::int32_t);                                              \
    template std::int32_t rasterize(const RasterPolygon<Real>&, const NodeBox&, bool, Real, \
                                    Real*, const NodeField<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
