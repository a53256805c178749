#include "step/occupied.hpp"

#include "fluid/extent_lanes.hpp"
#include "step/places_packed.hpp"

namespace weir {

namespace {

template <class Real>
Extent<Real> extent(const Particles<Real>& particles) {
    Extent<Real> found = Extent<Real>::of_first(particles);
    for (std::int32_t k = 1; k < particles.count; ++k) {
        found.add({particles.position[k], particles.position[k]});
    }
    return found;
}

/// Of packed places the raw numbers tell, both in a word: the highest of words has the highest y.
/// Of x all bits together mostly tell that particles reach as far as matters.
Extent<SmallFixed> extent_of_words(const Particles<SmallFixed>& particles, std::int32_t columns) {
    using Position = PositionOf<SmallFixed>;
    const Vec2<Position>* position = particles.position;
    std::uint32_t highest = 0;
    std::uint32_t bits = 0;
    std::int32_t k = 0;
    const auto look = [&](std::int32_t n) {
        const std::uint32_t word = word_at(position + n);
        bits |= word;
        if (word > highest) {
            highest = whole(word);  // seldom: a branch costs less than a choice
        }
    };
    for (; k + 4 <= particles.count; k += 4) {
        look(k);
        look(k + 1);
        look(k + 2);
        look(k + 3);
    }
    for (; k < particles.count; ++k) {
        look(k);
    }
    std::uint32_t x = bits & 0xFFFFU;
    const std::uint32_t enough = static_cast<std::uint32_t>(maximum(columns, 0)) * 256U;
    if (x < 2U * enough) {  // of what the highest bit alone makes, half is sure
        x = 0;
        for (k = 0; k < particles.count && x < enough; ++k) {
            x = maximum<std::uint32_t>(x, position[k].x.raw);
        }
    }
    x = minimum(x, enough);
    return {{}, {Position::of_raw(static_cast<std::uint16_t>(x)),
                 Position::of_raw(static_cast<std::uint16_t>(highest >> 16U))}};
}

#if WEIR_HAS_LANES
template <>
Extent<float> extent(const Particles<float>& particles) {
    return particles.count > 0 ? extent_of_places(particles.position, particles.count)
                               : Extent<float>{};
}
#else
/// Places are not negative: they compare as whole numbers do. Few lie outside what those before
/// them span.
template <>
Extent<float> extent(const Particles<float>& particles) {
    const Vec2<float>* position = particles.position;
    struct Range {
        std::uint32_t low;
        std::uint32_t span = 0;
        void add(std::uint32_t key) {
            if (WEIR_SELDOM(key - low > span)) {  // a branch costs less than choices
                span = key < low ? span + (low - key) : key - low;
                low = minimum(low, key);
            }
        }
        float lowest() const { return of_bound_key(static_cast<std::int32_t>(low)); }
        float highest() const { return of_bound_key(static_cast<std::int32_t>(low + span)); }
    };
    Range x{static_cast<std::uint32_t>(bound_key(position->x))};
    Range y{static_cast<std::uint32_t>(bound_key(position->y))};
    const Vec2<float>* const end = position + particles.count;
    const auto look = [&](std::int32_t k) {
        auto one = static_cast<std::uint32_t>(bound_key(position[k].x));
        auto other = static_cast<std::uint32_t>(bound_key(position[k].y));
        together(one, other);
        x.add(one);
        y.add(other);
    };
    for (; end - position >= 4; position += 4) {
        look(0);
        look(1);
        look(2);
        look(3);
    }
    for (; position != end; ++position) {
        look(0);
    }
    return {{x.lowest(), y.lowest()}, {x.highest(), y.highest()}};
}
#endif

/// Cells first … end − 1 along an axis of so many.
Part span_of(std::int32_t cells, std::int32_t low, std::int32_t high, std::int32_t at_once,
             std::int32_t above) {
    return {maximum(0, low - kMargin) / at_once * at_once, minimum(cells, high + above + 1)};
}

/// Empties columns first … end − 1 of a row of the tank.
template <class Real>
void empty_row(const GridShape& tank, std::int32_t first, std::int32_t end, std::int32_t j,
               PressureFields<Real>& fields) {
    for (std::int32_t i = first; i < end; ++i) {
        const std::int32_t c = tank.index(i, j);
        fields.pressure[c] = Real(0);
        fields.density[c] = Real(0);
        fields.level[c] = kEmptyLevel<Real>;
    }
}

/// Cells along an axis of a part and its ghost cells, as far as they are the tank's.
Part with_ghosts(std::int32_t first, std::int32_t cells, std::int32_t tank) {
    return {maximum(0, first - 1), minimum(tank, first + cells + 1)};
}

}  // namespace

template <class Real>
Extent<Real> extent_of(const Particles<Real>& particles,
                       [[maybe_unused]] std::int32_t columns) {
    if constexpr (Stored<Real>::coarse) {
        return extent_of_words(particles, columns);
    } else {
        return extent<Real>(particles);
    }
}

template <class Real>
GridShape occupied_part(const GridShape& tank, const Borders<Real>& borders,
                        const Extent<Real>& extent, bool from_corner) {
    const auto cell = [](PositionOf<Real> place) { return static_cast<std::int32_t>(Real(place)); };
    constexpr std::int32_t kAbove = Stored<Real>::coarse ? kMarginPacked : kMargin;
    GridShape part = tank;
    if (!borders.wrap_x) {
        const Part columns = span_of(tank.nx, from_corner ? 0 : cell(extent.low.x),
                                     cell(extent.high.x), kWindowColumns, kAbove);
        part.i0 = columns.first;
        part.nx = columns.end - columns.first;
    }
    if (!borders.wrap_y) {
        const Part rows = span_of(tank.ny, from_corner ? 0 : cell(extent.low.y),
                                  cell(extent.high.y), kWindowRows, kAbove);
        part.j0 = rows.first;
        part.ny = rows.end - rows.first;
    }
    return part;
}

template <class Real>
bool walls_reach(const GridShape& part, const BodyTable<Real>& bodies) {
    if (bodies.load != nullptr) {
        return bodies.used > 0;
    }
    // Distances are known a band around a body; cut cells look one node further. A thin wall that
    // has gone beyond met nobody on its way: none is followed further than the part's margin.
    const auto reached = [&](const NodeBox& box) {
        return !box.empty() && box.i0 <= part.i0 + part.nx + 1 &&
               box.j0 <= part.j0 + part.ny + 1 && box.i1 >= part.i0 - 1 && box.j1 >= part.j0 - 1;
    };
    for (std::int32_t slot = 0; slot < bodies.capacity; ++slot) {
        const Body<Real>& body = bodies.body[slot];
        if (body.kind != BodyKind::free && reached(body.drawn)) {
            return true;
        }
    }
    return false;
}

template <class Real>
void empty_beyond(const GridShape& tank, const GridShape& last, const GridShape& now,
                  PressureFields<Real>& fields, Work work) {
    const Part columns = with_ghosts(last.i0, last.nx, tank.nx);
    const Part rows = with_ghosts(last.j0, last.ny, tank.ny);
    const std::int32_t i1 = now.i0 + now.nx;
    const std::int32_t j1 = now.j0 + now.ny;
    const bool left = now.i0 > columns.first || i1 < columns.end || now.j0 > rows.first ||
                      j1 < rows.end;
    const Part part = work.take(left ? rows.end - rows.first : 0, columns.end - columns.first);
    for (std::int32_t j = rows.first + part.first; j < rows.first + part.end; ++j) {
        const bool beside = j >= now.j0 && j < j1;
        empty_row(tank, columns.first, beside ? minimum(now.i0, columns.end) : columns.end, j,
                  fields);
        empty_row(tank, beside ? maximum(i1, columns.first) : columns.end, columns.end, j, fields);
    }
}

#define WEIR_INSTANTIATE(Real)                                                               \
    template Extent<Real> extent_of(const Particles<Real>&, std::int32_t);                   \
    template GridShape occupied_part(const GridShape&, const Borders<Real>&,                 \
                                     const Extent<Real>&, bool);                              \
    template bool walls_reach(const GridShape&, const BodyTable<Real>&);                     \
    template void empty_beyond(const GridShape&, const GridShape&, const GridShape&,         \
                               PressureFields<Real>&, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
