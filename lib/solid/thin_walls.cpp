#include "solid/thin_walls.hpp"

#include <cstring>
#include <new>

namespace weir {

namespace {

/// A record's cell is passed by its edge, or as near to it as this, cells: no gap at corners.
template <class Real>
constexpr Real kMargin = Real(1.0 / 64.0);

/// Calls visit(from, to, span) with the places in the pool of all edges of a body.
template <class Real, class Visit>
void for_each_edge_of(const BodyTable<Real>& table, std::int32_t slot, Visit visit) {
    const Body<Real>& body = table.body[slot];
    const Outline<Real> outline = table.outline(body);
    const bool open = body.open;
    for (std::int32_t ring = 0; ring < body.rings; ++ring) {
        const std::int32_t begin = outline.begin_of(ring);
        const std::int32_t end = outline.end_of(ring);
        for (std::int32_t k = begin; k < (open ? end - 1 : end); ++k) {
            visit(body.first_vertex + k, body.first_vertex + (k + 1 < end ? k + 1 : begin));
        }
    }
}

/// Length of the way from a point along `way` to where it meets the edge a b, as a part of it;
/// 2 if it does not.
template <class Real>
Real part_to_edge(Vec2<Real> point, Vec2<Real> way, Vec2<Real> a, Vec2<Real> b) {
    const Product<Real> zero{};
    const Product<Real> side_a = cross(way, a - point);
    const Product<Real> side_b = cross(way, b - point);
    if ((side_a < zero) == (side_b < zero)) {
        return Real(2);
    }
    const Real ahead = cross(a - point, b - a);
    const Real slope = cross(way, b - a);
    if (slope == Real(0) || (ahead < Real(0)) != (slope < Real(0)) ||
        absolute(slope) < absolute(ahead)) {
        return Real(2);
    }
    return ahead / slope;
}

/// Whether the inside behind a point of an edge is narrow: the next edge is less than kThin away.
template <class Real>
bool narrow_at(const BodyTable<Real>& table, std::int32_t slot, std::int32_t from,
               Vec2<Real> point, Vec2<Real> inwards) {
    bool narrow = false;
    for_each_edge_of(table, slot, [&](std::int32_t a, std::int32_t b) {
        narrow = narrow || (a != from && part_to_edge(point, inwards, table.local[a],
                                                      table.local[b]) <= Real(1));
    });
    return narrow;
}

/// Samples an edge every half cell. A thin place in the middle counts from the nearer end on. A
/// corner that is thin for one sample only is as sharp as a contour shows it.
template <class Real>
ThinSpan span_of(const BodyTable<Real>& table, std::int32_t slot, std::int32_t from,
                 std::int32_t to) {
    const Vec2<Real> a = table.local[from];
    const Vec2<Real> way = table.local[to] - a;
    const Real size = length(way);
    if (!(size > Real(0))) {
        return {};
    }
    const Vec2<Real> inwards = (kThin<Real> / size) * Vec2<Real>{Real(0) - way.y, way.x};
    const std::int32_t samples = minimum(floor_to_int(size + size) + 1, 127);
    std::int32_t head = 0;
    std::int32_t tail = samples;
    for (std::int32_t k = 0; k < samples; ++k) {
        const Real part = static_cast<Real>(2 * k + 1) / static_cast<Real>(2 * samples);
        if (!narrow_at(table, slot, from, a + part * way, inwards)) {
            continue;
        }
        if (2 * k + 1 <= samples) {
            head = k + 1;
        } else {
            tail = minimum(tail, k);
        }
    }
    if (head < tail) {
        head = head > 1 ? head : 0;
        tail = samples - tail > 1 ? tail : samples;
    }
    return {static_cast<std::uint8_t>((255 * head + samples - 1) / samples),
            static_cast<std::uint8_t>(255 * tail / samples)};
}

/// The blunt end of a plate lies between edges that are thin up to it.
template <class Real>
void close_ends(ThinWalls<Real>& thin, const BodyTable<Real>& table, std::int32_t slot) {
    for_each_edge_of(table, slot, [&](std::int32_t from, std::int32_t to) {
        const Vec2<Real> way = table.local[to] - table.local[from];
        if (thin.span[from].whole() || !(length(way) < kThin<Real>)) {
            return;
        }
        bool before = false;
        for_each_edge_of(table, slot, [&](std::int32_t a, std::int32_t b) {
            before = before || (b == from && thin.span[a].tail < 255);
        });
        if (before && thin.span[to].head > 0) {
            thin.span[from] = {255, 0};
        }
    });
}

template <class Real>
void link(ThinWalls<Real>& thin, std::int32_t slot, std::int32_t cell, std::int32_t from,
          std::int32_t to) {
    ThinBody<Real>& body = thin.body[slot];
    if (body.count == body.room) {
        return;  // never: records_needed is an upper bound
    }
    const std::int32_t record = body.first + body.count++;
    thin.edge[record] = {cell, from, to, static_cast<std::uint16_t>(slot), thin.first[cell]};
    thin.first[cell] = static_cast<std::uint16_t>(record);
}

/// The part of an interval's way from a to b during which the other coordinate is low … high.
template <class Real>
void clip(Real a, Real b, Real low, Real high, Real& begin, Real& end) {
    const Real way = b - a;
    if (absolute(way) < kMargin<Real>) {
        return;
    }
    const Real at_low = clamp((low - a) / way, Real(0), Real(1));
    const Real at_high = clamp((high - a) / way, Real(0), Real(1));
    begin = minimum(at_low, at_high);
    end = maximum(at_low, at_high);
}

/// Visits every cell of the tank that the segment passes, row by row.
template <class Real, class Visit>
void for_each_cell(const GridShape& s, Vec2<Real> a, Vec2<Real> b, Visit visit) {
    const auto cell = [](Real value, std::int32_t last) {
        return floor_to_int(clamp(value, Real(-1), static_cast<Real>(last + 1)));
    };
    const std::int32_t low = maximum(0, cell(minimum(a.y, b.y) - kMargin<Real>, s.ny));
    const std::int32_t high = minimum(s.ny - 1, cell(maximum(a.y, b.y) + kMargin<Real>, s.ny));
    for (std::int32_t j = low; j <= high; ++j) {
        Real begin = Real(0);
        Real end = Real(1);
        clip(a.y, b.y, static_cast<Real>(j) - kMargin<Real>,
             static_cast<Real>(j + 1) + kMargin<Real>, begin, end);
        const Real x0 = a.x + begin * (b.x - a.x);
        const Real x1 = a.x + end * (b.x - a.x);
        const std::int32_t left = maximum(0, cell(minimum(x0, x1) - kMargin<Real>, s.nx));
        const std::int32_t right = minimum(s.nx - 1, cell(maximum(x0, x1) + kMargin<Real>, s.nx));
        for (std::int32_t i = left; i <= right; ++i) {
            visit(s.index(i, j));
        }
    }
}

template <class Real>
void unlink(ThinWalls<Real>& thin, std::int32_t slot) {
    ThinBody<Real>& body = thin.body[slot];
    for (std::int32_t record = body.first; record < body.first + body.count; ++record) {
        const WallEdge& gone = thin.edge[record];
        std::uint16_t* link = thin.first + gone.cell;
        while (*link != record) {
            link = &thin.edge[*link].next;
        }
        *link = gone.next;
    }
    body.count = 0;
}

template <class Real, class Visit>
void for_each_passed_cell(const ThinWalls<Real>& thin, const GridShape& shape,
                          const BodyTable<Real>& table, std::int32_t slot, Visit visit) {
    for_each_edge_of(table, slot, [&](std::int32_t from, std::int32_t to) {
        const ThinSpan span = thin.span[from];
        const Vec2<Real> a = table.placed[from];
        const Vec2<Real> b = table.placed[to];
        const auto at = [&](std::uint8_t part) {
            return a + static_cast<Real>(part) / Real(255) * (b - a);
        };
        const auto pass = [&](Vec2<Real> begin, Vec2<Real> end) {
            for_each_cell(shape, begin, end,
                          [&](std::int32_t cell) { visit(cell, from, to); });
        };
        if (span.whole()) {
            pass(a, b);
            return;
        }
        if (span.head > 0) {
            pass(a, at(span.head));
        }
        if (span.tail < 255) {
            pass(at(span.tail), b);
        }
    });
}

template <class Real>
Real thin_length(const ThinWalls<Real>& thin, const BodyTable<Real>& table, std::int32_t slot,
                 std::int32_t& edges) {
    Real sum = Real(0);
    edges = 0;
    for_each_edge_of(table, slot, [&](std::int32_t from, std::int32_t to) {
        if (thin.span[from].any()) {
            sum += length(table.local[to] - table.local[from]);
            edges += 2;  // its two ends are passed one by one
        }
    });
    return sum;
}

/// The same turn within ±π; angles are within ±2π.
template <class Real>
Real half_turn(Real angle) {
    constexpr Real kHalf = Real(3.141592653589793238);
    for (std::int32_t turn = 0; turn < 2 && absolute(angle) > kHalf; ++turn) {
        angle += angle > Real(0) ? Real(0) - (kHalf + kHalf) : kHalf + kHalf;
    }
    return angle;
}

}  // namespace

template <class Real>
void clear_thin_walls(ThinWalls<Real>& thin, const GridShape& shape, std::int32_t bodies) {
    if (thin.capacity == 0) {
        return;
    }
    thin.used = 0;
    thin.any_closed = false;
    thin.reach = Real(0);
    for (std::int32_t slot = 0; slot < bodies; ++slot) {
        new (thin.body + slot) ThinBody<Real>();
    }
    for (std::int32_t cell = 0; cell < shape.size(); ++cell) {
        thin.first[cell] = kNoEdge;
        thin.mark[cell] = 0;
    }
}

template <class Real>
void relink(ThinWalls<Real>& thin, const GridShape& shape, const BodyTable<Real>& table,
            std::int32_t slot) {
    unlink(thin, slot);
    for_each_passed_cell(thin, shape, table, slot,
                         [&](std::int32_t cell, std::int32_t from, std::int32_t to) {
                             link(thin, slot, cell, from, to);
                         });
    thin.any_closed = thin.any_closed || (thin.body[slot].room > 0 && !table.body[slot].open);
}

template <class Real>
bool add_thin_edges(ThinWalls<Real>& thin, const GridShape& shape, const BodyTable<Real>& table,
                    std::int32_t slot) {
    const Body<Real>& body = table.body[slot];
    ThinBody<Real>& added = thin.body[slot];
    added = ThinBody<Real>{};
    const bool open = body.open;
    for_each_edge_of(table, slot, [&](std::int32_t from, std::int32_t to) {
        thin.span[from] = open ? ThinSpan{255, 0} : span_of(table, slot, from, to);
    });
    if (!open) {
        close_ends(thin, table, slot);
    }
    if (body.kind == BodyKind::moving) {
        std::int32_t edges = 0;
        const Real length = thin_length(thin, table, slot, edges);
        added.room = edges > 0 ? records_needed(length, edges) : 0;
    } else {
        for_each_passed_cell(thin, shape, table, slot,
                             [&](std::int32_t, std::int32_t, std::int32_t) { ++added.room; });
    }
    if (added.room > thin.capacity - thin.used) {
        added = ThinBody<Real>{};
        return false;
    }
    added.first = thin.used;
    thin.used += added.room;
    relink(thin, shape, table, slot);
    return true;
}

template <class Real>
bool is_thin_all_over(const ThinWalls<Real>& thin, const BodyTable<Real>& table,
                      std::int32_t slot) {
    bool all = true;
    for_each_edge_of(table, slot, [&](std::int32_t from, std::int32_t) {
        all = all && thin.span[from].whole();
    });
    return all;
}

template <class Real>
void remove_thin_edges(ThinWalls<Real>& thin, const BodyTable<Real>& table, std::int32_t slot) {
    const Body<Real>& gone = table.body[slot];
    const std::int32_t first = thin.body[slot].first;
    const std::int32_t room = thin.body[slot].room;
    for (std::int32_t other = 0; other < table.capacity; ++other) {
        unlink(thin, other);
        ThinBody<Real>& body = thin.body[other];
        body.first -= body.room > 0 && body.first > first ? room : 0;
    }
    thin.body[slot] = ThinBody<Real>{};
    thin.used -= room;
    const std::int32_t behind = gone.first_vertex + gone.room;
    std::memmove(thin.span + gone.first_vertex, thin.span + behind,
                 static_cast<std::size_t>(table.vertices_used - behind) * sizeof thin.span[0]);
}

template <class Real>
void relink_all(ThinWalls<Real>& thin, const GridShape& shape, const BodyTable<Real>& table) {
    thin.any_closed = false;
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (thin.body[slot].room > 0) {
            relink(thin, shape, table, slot);
        }
    }
}

template <class Real>
void follow_bodies(ThinWalls<Real>& thin, const BodyTable<Real>& table) {
    thin.reach = Real(0);
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        const Body<Real>& body = table.body[slot];
        ThinBody<Real>& at = thin.body[slot];
        if (at.count == 0 || body.kind != BodyKind::moving) {
            continue;
        }
        const Vec2<Real> way = body.position - body.met_position;
        const Real angle = half_turn(body.angle - body.met_angle);
        const Real far = furthest_way(way, angle, body.radius);
        if (!(far > Real(0))) {
            continue;
        }
        at.swept = far <= kLongestSweep<Real>;
        at.turned = rotation(angle);
        thin.reach = maximum(thin.reach, at.swept ? far : Real(0));
    }
}

template <class Real>
void forget_ways(ThinWalls<Real>& thin, BodyTable<Real>& table) {
    thin.reach = Real(0);
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        Body<Real>& body = table.body[slot];
        body.met_position = body.position;
        body.met_angle = body.angle;
        thin.body[slot].swept = false;
    }
}

#define WEIR_INSTANTIATE(Real)                                                               \
    template void clear_thin_walls(ThinWalls<Real>&, const GridShape&, std::int32_t);        \
    template bool add_thin_edges(ThinWalls<Real>&, const GridShape&, const BodyTable<Real>&, \
                                 std::int32_t);                                              \
    template bool is_thin_all_over(const ThinWalls<Real>&, const BodyTable<Real>&,           \
                                   std::int32_t);                                            \
    template void remove_thin_edges(ThinWalls<Real>&, const BodyTable<Real>&, std::int32_t); \
    template void relink(ThinWalls<Real>&, const GridShape&, const BodyTable<Real>&,         \
                         std::int32_t);                                                      \
    template void relink_all(ThinWalls<Real>&, const GridShape&, const BodyTable<Real>&);    \
    template void follow_bodies(ThinWalls<Real>&, const BodyTable<Real>&);                   \
    template void forget_ways(ThinWalls<Real>&, BodyTable<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
