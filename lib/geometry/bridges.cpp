#include "geometry/bridges.hpp"

namespace weir {

namespace {

constexpr std::uint16_t kJoined = 0x8000;  // on a hole's rightmost vertex: the hole is joined

/// The rings while they are being joined. Corners 0 … count - 1 are the vertices, the ones behind
/// them copies of bridges' ends.
template <class Real>
struct Joint {
    const Outline<Real>& outline;
    CornerLinks links;
    ArrayView<std::uint16_t> rightmost;  // vertex of each hole
    ArrayView<std::uint16_t> copies;     // vertices of the further corners
    std::int32_t copied = 0;

    std::int32_t vertex_of(std::int32_t corner) const {
        return corner < outline.count
                   ? corner
                   : static_cast<std::int32_t>(copies[corner - outline.count]);
    }
    Vec2<double> at(std::int32_t corner) const {
        return convert<double>(outline.vertex[vertex_of(corner)]);
    }
    std::int32_t copy(std::int32_t corner) {
        copies[copied] = static_cast<std::uint16_t>(vertex_of(corner));
        return outline.count + copied++;
    }
    /// Calls visit(corner) once around the outer ring and what is joined to it.
    template <class Visit>
    void walk(Visit visit) const {
        std::int32_t corner = 0;
        do {
            visit(corner);
            corner = links.next(corner);
        } while (corner != 0);
    }
};

template <class Real>
void link_rings(const Joint<Real>& joint) {
    for (std::int32_t ring = 0; ring < joint.outline.rings; ++ring) {
        const std::int32_t end = joint.outline.end_of(ring);
        std::int32_t from = end - 1;
        for (std::int32_t i = joint.outline.begin_of(ring); i < end; ++i) {
            joint.links.join(from, i);
            from = i;
        }
    }
}

template <class Real>
void find_rightmost(const Joint<Real>& joint) {
    for (std::int32_t ring = 1; ring < joint.outline.rings; ++ring) {
        std::int32_t found = joint.outline.begin_of(ring);
        for (std::int32_t i = found; i < joint.outline.end_of(ring); ++i) {
            found = joint.outline.vertex[i].x > joint.outline.vertex[found].x ? i : found;
        }
        joint.rightmost[ring - 1] = static_cast<std::uint16_t>(found);
    }
}

/// The next hole to join is the one that reaches furthest right: nothing that is not joined yet
/// can then stand between it and what it sees to its right.
template <class Real>
std::int32_t take_next_hole(const Joint<Real>& joint) {
    std::int32_t best = -1;
    for (std::int32_t hole = 0; hole < joint.rightmost.size; ++hole) {
        const std::uint16_t vertex = joint.rightmost[hole];
        if ((vertex & kJoined) == 0 &&
            (best < 0 || joint.outline.vertex[vertex].x >
                             joint.outline.vertex[joint.rightmost[best]].x)) {
            best = hole;
        }
    }
    const std::int32_t corner = joint.rightmost[best];
    joint.rightmost[best] = static_cast<std::uint16_t>(corner | kJoined);
    return corner;
}

/// What a ray to the right meets first.
struct Sight {
    std::int32_t corner = -1;  // of the edge that is met: the one met itself, or the one further on
    Vec2<double> place;
    bool exact = false;        // the ray meets the corner itself
};

/// The solid is to the left of its edges, so a ray to the right leaves it through one that goes up.
template <class Real>
Sight look_right(const Joint<Real>& joint, Vec2<double> m) {
    Sight sight;
    joint.walk([&](std::int32_t k) {
        const std::int32_t l = joint.links.next(k);
        const Vec2<double> p = joint.at(k);
        const Vec2<double> q = joint.at(l);
        if (!(p.y <= m.y && m.y <= q.y && p.y < q.y) || turn(p, q, m) < 0.0) {
            return;
        }
        const bool exact = p.y == m.y || q.y == m.y;
        const double share = (m.y - p.y) / (q.y - p.y);
        const double x = exact ? (p.y == m.y ? p.x : q.x)
                               : maximum(m.x, p.x + share * (q.x - p.x));
        const bool nearer = sight.corner < 0 || x < sight.place.x ||
                            (x == sight.place.x && exact && !sight.exact);
        if (nearer) {
            const bool first = exact ? p.y == m.y : p.x > q.x;
            sight = {first ? k : l, {x, m.y}, exact};
        }
    });
    return sight;
}

bool same_place(Vec2<double> a, Vec2<double> b) { return a.x == b.x && a.y == b.y; }

/// The corner of the met edge is visible unless a hollow corner is in between; then the one at the
/// smallest angle to the ray is.
template <class Real>
std::int32_t find_visible(const Joint<Real>& joint, Vec2<double> m, const Sight& sight) {
    const Vec2<double> far = joint.at(sight.corner);
    const bool above = far.y > m.y;
    std::int32_t best = sight.corner;
    Vec2<double> way = far - m;
    joint.walk([&](std::int32_t k) {
        const Vec2<double> p = joint.at(k);
        const bool between = above ? in_triangle(m, sight.place, far, p)
                                   : in_triangle(m, far, sight.place, p);
        if (!between || same_place(p, far) ||
            turn(joint.at(joint.links.previous(k)), p, joint.at(joint.links.next(k))) > 0.0) {
            return;
        }
        const Vec2<double> other = p - m;
        const double steeper = absolute(other.y) * way.x - absolute(way.y) * other.x;
        if (steeper < 0.0 || (steeper == 0.0 && other.x < way.x)) {
            best = k;
            way = other;
        }
    });
    return best;
}

/// Whether the way from a corner to m starts within the solid there.
template <class Real>
bool opens_to(const Joint<Real>& joint, std::int32_t corner, Vec2<double> m, bool strictly) {
    const Vec2<double> before = joint.at(joint.links.previous(corner));
    const Vec2<double> here = joint.at(corner);
    const Vec2<double> after = joint.at(joint.links.next(corner));
    const double in = turn(before, here, m);
    const double out = turn(here, after, m);
    const bool left_of_in = strictly ? in > 0.0 : in >= 0.0;
    const bool left_of_out = strictly ? out > 0.0 : out >= 0.0;
    return turn(before, here, after) > 0.0 ? left_of_in && left_of_out : left_of_in || left_of_out;
}

/// Where bridges end several corners share a place; each owns a sector of it.
template <class Real>
std::int32_t corner_that_opens(const Joint<Real>& joint, std::int32_t corner, Vec2<double> m) {
    const Vec2<double> place = joint.at(corner);
    std::int32_t found = -1;
    std::int32_t almost = corner;
    joint.walk([&](std::int32_t k) {
        if (same_place(joint.at(k), place)) {
            found = found < 0 && opens_to(joint, k, m, true) ? k : found;
            almost = opens_to(joint, k, m, false) ? k : almost;
        }
    });
    return found < 0 ? almost : found;
}

/// There from p to the hole's corner m, around the hole, and back from a copy of m to one of p.
template <class Real>
void build_bridge(Joint<Real>& joint, std::int32_t p, std::int32_t m) {
    const std::int32_t after_p = joint.links.next(p);
    const std::int32_t before_m = joint.links.previous(m);
    const std::int32_t m_back = joint.copy(m);
    const std::int32_t p_back = joint.copy(p);
    joint.links.join(p, m);
    joint.links.join(before_m, m_back);
    joint.links.join(m_back, p_back);
    joint.links.join(p_back, after_p);
}

template <class Real>
std::int32_t successor(const Outline<Real>& outline, std::int32_t vertex) {
    std::int32_t low = 0;
    std::int32_t high = outline.rings - 1;
    while (low < high) {  // the first ring that ends behind the vertex
        const std::int32_t middle = (low + high) / 2;
        if (outline.end_of(middle) > vertex) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return vertex + 1 < outline.end_of(low) ? vertex + 1 : outline.begin_of(low);
}

template <class Real>
void write_sequence(const Joint<Real>& joint, ArrayView<std::uint16_t> sequence) {
    std::int32_t written = 0;
    joint.walk([&](std::int32_t corner) {
        const std::int32_t vertex = joint.vertex_of(corner);
        const std::int32_t next = joint.vertex_of(joint.links.next(corner));
        const std::int32_t bridge = next == successor(joint.outline, vertex) ? 0 : kBridge;
        sequence[written++] = static_cast<std::uint16_t>(vertex | bridge);
    });
}

}  // namespace

template <class Real>
bool join_holes(const Outline<Real>& outline, CornerLinks links, ArrayView<std::uint16_t> scratch,
                ArrayView<std::uint16_t> sequence) {
    if (outline.rings == 1) {
        for (std::int32_t k = 0; k < outline.count; ++k) {
            sequence[k] = static_cast<std::uint16_t>(k);
        }
        return true;
    }
    const std::int32_t holes = outline.rings - 1;
    Joint<Real> joint{outline, links, {scratch.data, holes}, {scratch.data + holes, 2 * holes}};
    link_rings(joint);
    find_rightmost(joint);
    for (std::int32_t hole = 0; hole < holes; ++hole) {
        const std::int32_t corner = take_next_hole(joint);
        const Vec2<double> m = joint.at(corner);
        const Sight sight = look_right(joint, m);
        if (sight.corner < 0) {
            return false;
        }
        const std::int32_t visible = sight.exact ? sight.corner : find_visible(joint, m, sight);
        build_bridge(joint, corner_that_opens(joint, visible, m), corner);
    }
    write_sequence(joint, sequence);
    return true;
}

#define WEIR_INSTANTIATE(Real)                                                            \
    template bool join_holes(const Outline<Real>&, CornerLinks, ArrayView<std::uint16_t>, \
                             ArrayView<std::uint16_t>);
WEIR_FOR_EACH_NUMBER(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
