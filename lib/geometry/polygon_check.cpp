// Outline checks, in whole numbers (geometry/rings.hpp).
#include "geometry/convex_decomposition.hpp"
#include "geometry/edge_walk.hpp"
#include "geometry/polygon.hpp"
#include "weir/config.hpp"

namespace weir {

namespace {

/// Edges that are held while all others pass by: 24 bytes each on the stack.
constexpr std::int32_t kEdgesHeld = 16;

/// Smallest area of a ring over the square of its bounding box's diagonal, as a power of two: a
/// sliver thinner than this has a width made of a float's rounding; a wall of 1 mm by 100 m still
/// passes.
constexpr std::int32_t kMinRelativeArea = -20;

int sign_of_turn(GridVertex a, GridVertex b, GridVertex c) {
    const std::int64_t t = turn(a, b, c);
    return t > 0 ? 1 : (t < 0 ? -1 : 0);
}

enum class Meeting { crossing, touching };

/// Whether two edges whose boxes overlap cross, or at least share a point. Edges on one line whose
/// boxes overlap do share one, which is the case of four zeros.
bool edges_meet(const Edge& e, const Edge& f, Meeting meeting) {
    const int most = meeting == Meeting::touching ? 0 : -1;
    return sign_of_turn(e.a, e.b, f.a) * sign_of_turn(e.a, e.b, f.b) <= most &&
           sign_of_turn(f.a, f.b, e.a) * sign_of_turn(f.a, f.b, e.b) <= most;
}

/// Whether the way turns back on itself where edge e ends.
bool folds(const Edge& e, const Edge& f) {
    return sign_of_turn(e.a, e.b, f.b) == 0 && dot(way(e.a, e.b), way(f.a, f.b)) < 0;
}

/// Whether two edges meet where they must not: neighbours do share a vertex.
bool clash(const RingsOnGrid& rings, const Edge& e, const Edge& f, Meeting meeting) {
    if (!overlap(box_of(e), box_of(f)) || !edges_meet(e, f, meeting)) {
        return false;
    }
    if (follows(rings, e, f)) {
        return folds(e, f);
    }
    return follows(rings, f, e) ? folds(f, e) : true;
}

/// The first pair of edges that clash. All edges are taken in groups; a group that another one
/// passes without overlap of their boxes is not looked at edge by edge.
bool find_clash(const RingsOnGrid& rings, std::int32_t first_ring, std::int32_t last_ring,
                Meeting meeting, Edge* e, Edge* f) {
    Edge held[kEdgesHeld];
    EdgeWalk walk(rings, first_ring, last_ring);
    while (true) {
        const std::int32_t count = walk.take(held, kEdgesHeld);
        if (count == 0) {
            return false;
        }
        const EdgeBox box = box_of(held, count);
        for (std::int32_t i = 0; i < count; ++i) {
            for (std::int32_t j = i + 1; j < count; ++j) {
                if (clash(rings, held[i], held[j], meeting)) {
                    *e = held[i];
                    *f = held[j];
                    return true;
                }
            }
        }
        EdgeWalk others = walk;
        while (!others.done()) {
            EdgeWalk group = others;
            if (!overlap(box, others.skip(kEdgesHeld))) {
                continue;
            }
            for (std::int32_t j = 0; j < kEdgesHeld && group.next(f); ++j) {
                if (!overlap(box, box_of(*f))) {
                    continue;
                }
                for (std::int32_t i = 0; i < count; ++i) {
                    if (clash(rings, held[i], *f, meeting)) {
                        *e = held[i];
                        return true;
                    }
                }
            }
        }
    }
}

std::int64_t squared_diagonal(const RingsOnGrid& rings, std::int32_t ring) {
    const GridVertex first = rings.place(rings[ring][0]);
    EdgeBox box{first, first};
    for (const Vec2f vertex : rings[ring]) {
        const GridVertex place = rings.place(vertex);
        box = unite(box, {place, place});
    }
    const Vec2<std::int64_t> diagonal = way(box.low, box.high);
    return dot(diagonal, diagonal);
}

/// What is told of a fault. Who does not ask where edges meet does not link what finds it.
struct Finding : PolygonFault {
    Vec2f (*meeting_place)(const RingsOnGrid& rings, const Edge& e, const Edge& f) =
        [](const RingsOnGrid&, const Edge&, const Edge&) { return Vec2f{}; };
};

Vec2<double> meeting_on_grid(const Edge& e, const Edge& f) {
    const Vec2<double> a = convert<double>(e.a);
    const Vec2<double> along_e = convert<double>(e.b) - a;
    const Vec2<double> along_f = convert<double>(f.b) - convert<double>(f.a);
    const double both = cross(along_e, along_f);
    if (both != 0.0) {
        const double share = cross(convert<double>(f.a) - a, along_f) / both;
        return a + clamp(share, 0.0, 1.0) * along_e;
    }
    // On one line: an end of one lies on the other.
    if (overlap(box_of(e), {f.a, f.a})) {
        return convert<double>(f.a);
    }
    return overlap(box_of(e), {f.b, f.b}) ? convert<double>(f.b) : a;
}

Vec2f meeting_place(const RingsOnGrid& rings, const Edge& e, const Edge& f) {
    const double m_per_step = 1.0 / static_cast<double>(rings.steps_per_m);
    return convert<float>(m_per_step * meeting_on_grid(e, f));
}

void blame(PolygonFault& fault, std::int32_t ring, std::int32_t edge, Vec2f place) {
    fault.ring_a = ring;
    fault.edge_a = edge;
    fault.place_m = place;
}

void blame(Finding& fault, const RingsOnGrid& rings, const Edge& e, const Edge& f) {
    blame(fault, e.ring, e.index, fault.meeting_place(rings, e, f));
    fault.ring_b = f.ring;
    fault.edge_b = f.index;
}

Status check_sizes(const PolygonRings& rings, PolygonFault& fault) {
    if (rings.holes.size < 0 || (rings.holes.size > 0 && rings.holes.data == nullptr)) {
        return Status::polygon_missing;
    }
    constexpr std::int64_t kMostHoles = kMaxBodyVertices / places_for(3, 1);
    std::int64_t needed = 0;
    const std::int32_t counted =
        rings.holes.size > kMostHoles ? 1 : rings.count();  // no table is that long
    for (std::int32_t ring = 0; ring < counted; ++ring) {
        blame(fault, ring, -1, {});
        if (rings[ring].data == nullptr) {
            return Status::polygon_missing;
        }
        if (rings[ring].size < 3) {
            return Status::polygon_too_few_vertices;
        }
        needed += rings[ring].size;
    }
    needed += std::int64_t{places_for(counted == 1 ? 3 : 0, 1)} * rings.holes.size;
    fault.vertices_needed =
        static_cast<std::int32_t>(needed < 0x7FFFFFFF ? needed : std::int64_t{0x7FFFFFFF});
    blame(fault, -1, -1, {});
    return needed > kMaxBodyVertices ? Status::polygon_too_many_vertices : Status::ok;
}

Status check_vertices(const PolygonRings& rings, PolygonFault& fault) {
    for (std::int32_t ring = 0; ring < rings.count(); ++ring) {
        for (std::int32_t i = 0; i < rings[ring].size; ++i) {
            if (!is_finite(rings[ring][i])) {
                blame(fault, ring, i, {});
                return Status::polygon_not_finite;
            }
        }
    }
    return Status::ok;
}

Status check_areas(const RingsOnGrid& rings, Finding& fault) {
    for (std::int32_t ring = 0; ring < rings.count(); ++ring) {
        if (absolute(twice_area(rings, ring)) >
            squared_diagonal(rings, ring) >> (-kMinRelativeArea - 1)) {
            continue;
        }
        // The halves of a bow tie cancel; flatness is not what its author has to mend.
        Edge e;
        Edge f;
        if (find_clash(rings, ring, ring, Meeting::crossing, &e, &f)) {
            blame(fault, rings, e, f);
            return Status::polygon_crosses_itself;
        }
        blame(fault, ring, -1, rings[ring][0]);
        return Status::polygon_zero_area;
    }
    return Status::ok;
}

/// Whether a place is within a ring, either way round: how often a ray from it meets the ring.
bool surrounds(const RingsOnGrid& rings, std::int32_t ring, GridVertex place) {
    bool inside = false;
    Edge edge;
    for (EdgeWalk walk(rings, ring, ring); walk.next(&edge);) {
        const bool rises = edge.b.y > edge.a.y;
        if ((edge.a.y > place.y) != (edge.b.y > place.y) &&
            (turn(edge.a, edge.b, place) > 0) == rises) {
            inside = !inside;
        }
    }
    return inside;
}

Status check_nesting(const RingsOnGrid& rings, PolygonFault& fault) {
    for (std::int32_t hole = 1; hole < rings.count(); ++hole) {
        const Vec2f vertex = rings[hole][0];
        blame(fault, hole, -1, vertex);
        for (std::int32_t other = 0; other < rings.count(); ++other) {
            if (other != hole &&
                surrounds(rings, other, rings.place(vertex)) != (other == 0)) {
                fault.ring_b = other;
                return Status::polygon_hole_outside;
            }
        }
    }
    blame(fault, -1, -1, {});
    return Status::ok;
}

Status check_rings(const PolygonRings& given, Finding& fault) {
    Status status = check_sizes(given, fault);
    if (status == Status::ok) {
        status = check_vertices(given, fault);
    }
    if (status != Status::ok) {
        return status;
    }
    const RingsOnGrid rings(given);
    status = check_areas(rings, fault);
    if (status != Status::ok) {
        return status;
    }
    Edge e;
    Edge f;
    if (find_clash(rings, 0, rings.count() - 1, Meeting::touching, &e, &f)) {
        blame(fault, rings, e, f);
        return e.ring == f.ring ? Status::polygon_crosses_itself : Status::polygon_hole_crosses;
    }
    return check_nesting(rings, fault);
}

}  // namespace

Status check_polygon(View<Vec2f> polygon, View<View<Vec2f>> holes) {
    Finding ignored;
    return check_rings({polygon, holes}, ignored);
}

Status check_polygon(View<Vec2f> polygon, View<View<Vec2f>> holes, PolygonFault* fault) {
    if (fault == nullptr) {
        return check_polygon(polygon, holes);
    }
    Finding found;
    found.meeting_place = meeting_place;
    const Status status = check_rings({polygon, holes}, found);
    *fault = found;
    return status;
}

}  // namespace weir
