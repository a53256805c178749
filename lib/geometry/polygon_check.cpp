// Outline checks in double: products of floats are exact there and their squares cannot overflow,
// so a touch is told from a near miss and no finite input misbehaves.
#include "geometry/convex_decomposition.hpp"
#include "geometry/edge_walk.hpp"
#include "geometry/polygon.hpp"
#include "weir/config.hpp"

namespace weir {

namespace {

/// Edges that are held while all others pass by: 24 bytes each on the stack.
constexpr std::int32_t kEdgesHeld = 16;

int sign_of_turn(const Vec2f& a, const Vec2f& b, const Vec2f& c) {
    const double t = turn_in_double(a, b, c);
    return t > 0.0 ? 1 : (t < 0.0 ? -1 : 0);
}

enum class Meeting { crossing, touching };

/// Whether two edges whose boxes overlap cross, or at least share a point. Edges on one line whose
/// boxes overlap do share one, which is the case of four zeros.
bool edges_meet(const Edge& e, const Edge& f, Meeting meeting) {
    const int most = meeting == Meeting::touching ? 0 : -1;
    return sign_of_turn(e.a, e.b, f.a) * sign_of_turn(e.a, e.b, f.b) <= most &&
           sign_of_turn(f.a, f.b, e.a) * sign_of_turn(f.a, f.b, e.b) <= most;
}

Vec2<double> along(const Edge& e) { return convert<double>(e.b) - convert<double>(e.a); }

/// Whether the way turns back on itself where edge e ends.
bool folds(const Edge& e, const Edge& f) {
    return sign_of_turn(e.a, e.b, f.b) == 0 && dot(along(e), along(f)) < 0.0;
}

/// Whether two edges meet where they must not: neighbours do share a vertex.
bool clash(const PolygonRings& rings, const Edge& e, const Edge& f, Meeting meeting) {
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
bool find_clash(const PolygonRings& rings, std::int32_t first_ring, std::int32_t last_ring,
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

double squared_diagonal(View<Vec2f> ring) {
    EdgeBox box{ring[0], ring[0]};
    for (const Vec2f v : ring) {
        box = unite(box, {v, v});
    }
    const Vec2<double> diagonal = convert<double>(box.high) - convert<double>(box.low);
    return dot(diagonal, diagonal);
}

/// What is told of a fault. Who does not ask where edges meet does not link what finds it.
struct Finding : PolygonFault {
    Vec2f (*meeting_place)(const Edge& e, const Edge& f) = [](const Edge&, const Edge&) {
        return Vec2f{};
    };
};

Vec2f meeting_place(const Edge& e, const Edge& f) {
    const Vec2<double> a = convert<double>(e.a);
    const double both = cross(along(e), along(f));
    if (both != 0.0) {
        const double share = cross(convert<double>(f.a) - a, along(f)) / both;
        return convert<float>(a + clamp(share, 0.0, 1.0) * along(e));
    }
    // On one line: an end of one lies on the other.
    if (overlap(box_of(e), {f.a, f.a})) {
        return f.a;
    }
    return overlap(box_of(e), {f.b, f.b}) ? f.b : e.a;
}

void blame(PolygonFault& fault, std::int32_t ring, std::int32_t edge, Vec2f place) {
    fault.ring_a = ring;
    fault.edge_a = edge;
    fault.place_m = place;
}

void blame(Finding& fault, const Edge& e, const Edge& f) {
    blame(fault, e.ring, e.index, fault.meeting_place(e, f));
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

[[gnu::noinline]] Status check_areas(const PolygonRings& rings, Finding& fault) {
    for (std::int32_t ring = 0; ring < rings.count(); ++ring) {
        const View<Vec2f> vertices = rings[ring];
        if (absolute(twice_area_in_double(vertices)) >
            2.0 * kMinRelativeArea * squared_diagonal(vertices)) {
            continue;
        }
        // The halves of a bow tie cancel; flatness is not what its author has to mend.
        Edge e;
        Edge f;
        if (find_clash(rings, ring, ring, Meeting::crossing, &e, &f)) {
            blame(fault, e, f);
            return Status::polygon_crosses_itself;
        }
        blame(fault, ring, -1, vertices[0]);
        return Status::polygon_zero_area;
    }
    return Status::ok;
}

Status check_nesting(const PolygonRings& rings, PolygonFault& fault) {
    for (std::int32_t hole = 1; hole < rings.count(); ++hole) {
        const Vec2f vertex = rings[hole][0];
        blame(fault, hole, -1, vertex);
        for (std::int32_t other = 0; other < rings.count(); ++other) {
            if (other != hole && within_ring(rings[other], vertex) != (other == 0)) {
                fault.ring_b = other;
                return Status::polygon_hole_outside;
            }
        }
    }
    blame(fault, -1, -1, {});
    return Status::ok;
}

Status check_rings(const PolygonRings& rings, Finding& fault) {
    Status status = check_sizes(rings, fault);
    if (status == Status::ok) {
        status = check_vertices(rings, fault);
    }
    if (status == Status::ok) {
        status = check_areas(rings, fault);
    }
    Edge e;
    Edge f;
    if (status == Status::ok &&
        find_clash(rings, 0, rings.count() - 1, Meeting::touching, &e, &f)) {
        blame(fault, e, f);
        return e.ring == f.ring ? Status::polygon_crosses_itself : Status::polygon_hole_crosses;
    }
    return status == Status::ok ? check_nesting(rings, fault) : status;
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
