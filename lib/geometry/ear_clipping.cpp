#include "geometry/ear_clipping.hpp"

namespace weir {

namespace {

constexpr std::uint16_t kListed = 0x8000;  // on the shelf: the corner is in its cell's list
constexpr std::int32_t kNone = 0x7FFF;     // end of a list

struct Range {
    std::int32_t first;
    std::int32_t last;
};

std::int32_t cell_along(double offset, double per_length, std::int32_t cells) {
    return clamp(floor_to_int(clamp(offset * per_length, 0.0, 65536.0)), 0, cells - 1);
}

template <class Real>
std::int32_t cell_of(const EarClipper<Real>& clipper, std::int32_t corner) {
    const Vec2<double> offset = clipper.ring.at(corner) - clipper.low;
    return cell_along(offset.y, clipper.cells_per_length.y, clipper.rows) * clipper.columns +
           cell_along(offset.x, clipper.cells_per_length.x, clipper.columns);
}

template <class Real>
bool is_hollow(const EarClipper<Real>& clipper, std::int32_t corner) {
    return !(clipper.ring.turn_at(clipper.links.previous(corner), corner,
                                  clipper.links.next(corner)) > 0.0);
}

template <class Real>
void put_on_list(EarClipper<Real>& clipper, std::int32_t corner) {
    const std::int32_t cell = cell_of(clipper, corner);
    clipper.shelf[corner] = static_cast<std::uint16_t>(clipper.cells[cell] | kListed);
    clipper.cells[cell] = static_cast<std::uint16_t>(corner);
}

template <class Real>
void take_off_list(EarClipper<Real>& clipper, std::int32_t corner) {
    std::uint16_t* link = &clipper.cells[cell_of(clipper, corner)];
    std::uint16_t mark = 0;  // links on the shelf carry it, the cell's own does not
    while ((*link & kNone) != corner) {
        link = &clipper.shelf[*link & kNone];
        mark = kListed;
    }
    *link = static_cast<std::uint16_t>((clipper.shelf[corner] & kNone) | mark);
    clipper.shelf[corner] = 0;
}

/// Lists a corner if it is hollow, or takes it off the list.
template <class Real>
void refresh(EarClipper<Real>& clipper, std::int32_t corner, bool hollow) {
    const bool listed = (clipper.shelf[corner] & kListed) != 0;
    if (hollow && !listed) {
        put_on_list(clipper, corner);
    } else if (!hollow && listed) {
        take_off_list(clipper, corner);
    }
}

/// A grid of about square cells over the ring, no more of them than there are places or corners.
template <class Real>
void lay_grid(EarClipper<Real>& clipper) {
    Vec2<double> low = clipper.ring.at(0);
    Vec2<double> high = low;
    for (std::int32_t k = 1; k < clipper.ring.count(); ++k) {
        const Vec2<double> p = clipper.ring.at(k);
        low = {minimum(low.x, p.x), minimum(low.y, p.y)};
        high = {maximum(high.x, p.x), maximum(high.y, p.y)};
    }
    const Vec2<double> size = high - low;
    const std::int32_t most = minimum(clipper.cells.size, clipper.ring.count());
    std::int32_t columns = 1;
    while (columns < most && static_cast<double>(columns) * static_cast<double>(columns) * size.y <
                                 static_cast<double>(most) * size.x) {
        ++columns;
    }
    clipper.low = low;
    clipper.columns = columns;
    clipper.rows = maximum(1, most / columns);
    const auto per_length = [](std::int32_t cells, double length) {
        return length > 0.0 ? static_cast<double>(cells) / length : 0.0;
    };
    clipper.cells_per_length = {per_length(columns, size.x), per_length(clipper.rows, size.y)};
    clipper.cells.size = columns * clipper.rows;
    for (std::uint16_t& cell : clipper.cells) {
        cell = kNone;
    }
}

Range range_of(double p, double q, double r, double low, double per_length, std::int32_t cells) {
    const double least = minimum(p, minimum(q, r));
    const double most = maximum(p, maximum(q, r));
    return {cell_along(least - low, per_length, cells), cell_along(most - low, per_length, cells)};
}

/// Whether two corners are the same vertex, where a bridge ends.
template <class Real>
bool same_vertex(const CornerRing<Real>& ring, std::int32_t a, std::int32_t b) {
    return ring.vertex_of(a) == ring.vertex_of(b);
}

/// Whether the triangle at a corner can be cut off: a left turn with no other corner in it. One on
/// its rim blocks too, so that no later triangle is a mere line.
template <class Real>
bool is_ear(const EarClipper<Real>& clipper, std::int32_t corner) {
    const std::int32_t before = clipper.links.previous(corner);
    const std::int32_t after = clipper.links.next(corner);
    const Vec2<double> a = clipper.ring.at(before);
    const Vec2<double> tip = clipper.ring.at(corner);
    const Vec2<double> c = clipper.ring.at(after);
    if (!(turn(a, tip, c) > 0.0)) {
        return false;
    }
    const auto blocks = [&](std::int32_t other) {
        return in_triangle(a, tip, c, clipper.ring.at(other)) &&
               !same_vertex(clipper.ring, other, before) &&
               !same_vertex(clipper.ring, other, corner) &&
               !same_vertex(clipper.ring, other, after);
    };
    const Range i = range_of(a.x, tip.x, c.x, clipper.low.x, clipper.cells_per_length.x,
                             clipper.columns);
    const Range j = range_of(a.y, tip.y, c.y, clipper.low.y, clipper.cells_per_length.y,
                             clipper.rows);
    for (std::int32_t row = j.first; row <= j.last; ++row) {
        for (std::int32_t column = i.first; column <= i.last; ++column) {
            std::int32_t at = clipper.cells[row * clipper.columns + column];
            while (at != kNone) {
                if (blocks(at)) {
                    return false;
                }
                at = clipper.shelf[at] & kNone;
            }
        }
    }
    return true;
}

/// The next ear from `start` on, or -1. A corner is tested again only after a neighbour went.
template <class Real>
std::int32_t search(const EarClipper<Real>& clipper) {
    std::int32_t corner = clipper.start;
    for (std::int32_t tried = 0; tried < clipper.left; ++tried) {
        if (!clipper.links.marked(corner)) {
            if (is_ear(clipper, corner)) {
                return corner;
            }
            clipper.links.mark(corner);
        }
        corner = clipper.links.next(corner);
    }
    return -1;
}

/// No proper ear: rounding has made the ring touch or cross itself. The flattest corner goes, which
/// moves the outline least: not at all for a doubled vertex or the tip of a spike.
template <class Real>
std::int32_t flattest(const EarClipper<Real>& clipper) {
    std::int32_t found = clipper.start;
    double least = -1.0;
    std::int32_t corner = clipper.start;
    for (std::int32_t tried = 0; tried < clipper.left; ++tried) {
        const double area = absolute(clipper.ring.turn_at(clipper.links.previous(corner), corner,
                                                          clipper.links.next(corner)));
        if (least < 0.0 || area < least) {
            found = corner;
            least = area;
        }
        corner = clipper.links.next(corner);
    }
    return found;
}

template <class Real>
std::int32_t find_ear(const EarClipper<Real>& clipper) {
    std::int32_t found = search(clipper);
    if (found >= 0) {
        return found;
    }
    // A makeshift cut may have freed corners anywhere.
    std::int32_t corner = clipper.start;
    for (std::int32_t tried = 0; tried < clipper.left; ++tried) {
        clipper.links.unmark(corner);
        corner = clipper.links.next(corner);
    }
    found = search(clipper);
    return found >= 0 ? found : flattest(clipper);
}

}  // namespace

template <class Real>
EarClipper<Real> start_clipping(const CornerRing<Real>& ring, CornerLinks links,
                                ArrayView<std::uint16_t> shelf, ArrayView<std::uint16_t> cells) {
    EarClipper<Real> clipper{ring, links, shelf, cells, {}, {}, 1, 1, ring.count(), 0};
    lay_grid(clipper);
    std::int32_t from = ring.count() - 1;
    for (std::int32_t k = 0; k < ring.count(); ++k) {
        links.join(from, k);
        shelf[k] = 0;
        from = k;
    }
    for (std::int32_t k = 0; k < ring.count(); ++k) {
        refresh(clipper, k, is_hollow(clipper, k));
    }
    return clipper;
}

template <class Real>
Ear clip_ear(EarClipper<Real>& clipper) {
    const std::int32_t tip = clipper.left > 3 ? find_ear(clipper) : clipper.start;
    const std::int32_t a = clipper.links.previous(tip);
    const std::int32_t c = clipper.links.next(tip);
    refresh(clipper, tip, false);
    const bool has_area = clipper.ring.turn_at(a, tip, c) > 0.0;
    clipper.links.join(a, c);
    clipper.links.unmark(a);
    --clipper.left;
    clipper.start = c;
    refresh(clipper, a, is_hollow(clipper, a));
    refresh(clipper, c, is_hollow(clipper, c));
    return {a, tip, c, has_area};
}

#define WEIR_INSTANTIATE(Real)                                                                     \
    template EarClipper<Real> start_clipping(const CornerRing<Real>&, CornerLinks,                 \
                                              ArrayView<std::uint16_t>, ArrayView<std::uint16_t>); \
    template Ear clip_ear(EarClipper<Real>&);
WEIR_FOR_EACH_NUMBER(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
