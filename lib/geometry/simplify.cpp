// Douglas & Peucker without recursion: passes over the spans between the vertices that stay, each
// of which keeps the furthest vertex of every span that strays too far, until none does.
#include "geometry/polygon.hpp"
#include "geometry/signed_distance.hpp"

namespace weir {

namespace {

/// The ring and the marks of the vertices that stay.
struct Marked {
    View<Vec2f> ring;
    std::uint8_t* keep;

    std::int32_t after(std::int32_t i) const { return i + 1 < ring.size ? i + 1 : 0; }
    std::int32_t next_kept(std::int32_t i) const {
        std::int32_t at = after(i);
        while (keep[at] == 0) {
            at = after(at);
        }
        return at;
    }
    Vec2<double> at(std::int32_t i) const { return convert<double>(ring[i]); }
};

/// The vertex between two kept ones that is furthest from the edge between them, −1 if there is
/// none further than `limit`.
std::int32_t furthest(const Marked& marked, std::int32_t from, std::int32_t to, double limit) {
    std::int32_t found = -1;
    for (std::int32_t i = marked.after(from); i != to; i = marked.after(i)) {
        const double distance = distance_to_segment(marked.at(i), marked.at(from), marked.at(to));
        if (distance > limit) {
            found = i;
            limit = distance;
        }
    }
    return found;
}

/// One pass; whether a vertex was added.
bool refine(const Marked& marked, double tolerance) {
    bool added = false;
    std::int32_t from = marked.next_kept(marked.ring.size - 1);
    const std::int32_t first = from;
    do {
        const std::int32_t to = marked.next_kept(from);
        const std::int32_t far = furthest(marked, from, to, tolerance);
        if (far >= 0) {
            marked.keep[far] = 1;
            added = true;
        }
        from = to;
    } while (from != first);
    return added;
}

std::int32_t write_kept(const Marked& marked, Vec2f* out) {
    std::int32_t count = 0;
    for (std::int32_t i = 0; i < marked.ring.size; ++i) {
        if (marked.keep[i] != 0) {
            out[count++] = marked.ring[i];
        }
    }
    return count;
}

std::int32_t nth_kept(const Marked& marked, std::int32_t n) {
    std::int32_t i = marked.next_kept(marked.ring.size - 1);
    for (; n > 0; --n) {
        i = marked.next_kept(i);
    }
    return i;
}

/// Puts a vertex back into the n-th edge. False if it has none.
bool bend_edge(const Marked& marked, std::int32_t n) {
    if (n < 0) {
        return false;
    }
    const std::int32_t from = nth_kept(marked, n);
    const std::int32_t far = furthest(marked, from, marked.next_kept(from), -1.0);
    if (far >= 0) {
        marked.keep[far] = 1;
    }
    return far >= 0;
}

/// Where the ring has become no polygon: both edges that meet get a vertex back, and if it has no
/// area, every edge does.
void bend_back(const Marked& marked, const PolygonFault& fault) {
    // The later one first: a vertex in the earlier one would shift its number.
    const bool bent_later = bend_edge(marked, maximum(fault.edge_a, fault.edge_b));
    const bool bent_earlier = bend_edge(marked, minimum(fault.edge_a, fault.edge_b));
    if (!bent_later && !bent_earlier) {
        refine(marked, -1.0);
    }
}

}  // namespace

Status simplify_ring(View<Vec2f> ring, float tolerance_m, std::uint8_t* keep, Vec2f* out,
                     std::int32_t* count) {
    if (keep == nullptr || out == nullptr || count == nullptr) {
        return Status::output_missing;
    }
    Status status = check_polygon(ring);
    if (status != Status::ok) {
        return status;
    }
    const Marked marked{ring, keep};
    for (std::int32_t i = 0; i < ring.size; ++i) {
        keep[i] = 0;
    }
    keep[0] = 1;  // the first span goes all around
    const double tolerance = tolerance_m > 0.0F ? static_cast<double>(tolerance_m) : 0.0;
    while (refine(marked, tolerance)) {
    }
    // Each turn keeps at least one vertex more; with all of them it is the ring that was checked.
    PolygonFault fault;
    std::int32_t written = write_kept(marked, out);
    while (check_polygon({out, written}, {}, &fault) != Status::ok) {
        bend_back(marked, fault);
        written = write_kept(marked, out);
    }
    *count = written;
    return Status::ok;
}

}  // namespace weir
