#include "step/occupied.hpp"

#include "math/lanes.hpp"

namespace weir {

namespace {

/// Rows above the row of the highest particle: one that its mass reaches, one that velocity is
/// extrapolated to, and what stencils of smoothing and mirroring look at beyond.
constexpr std::int32_t kMargin = 5;

template <class Position>
Vec2<Position> furthest(const Vec2<Position>* position, std::int32_t first, std::int32_t count,
                        Vec2<Position> so_far) {
    for (std::int32_t k = first; k < count; ++k) {
        so_far.x = maximum(so_far.x, position[k].x);
        so_far.y = maximum(so_far.y, position[k].y);
    }
    return so_far;
}

template <class Position>
Vec2<Position> furthest(const Vec2<Position>* position, std::int32_t count) {
    return furthest(position, 0, count, {});
}

/// Of packed places the raw numbers tell. Four at a time: the loop costs as much as they do.
template <>
Vec2<PositionOf<SmallFixed>> furthest(const Vec2<PositionOf<SmallFixed>>* position,
                                      std::int32_t first, std::int32_t count,
                                      Vec2<PositionOf<SmallFixed>> so_far) {
    std::uint32_t x = so_far.x.raw;
    std::uint32_t y = so_far.y.raw;
    std::int32_t k = first;
    const auto look = [&](std::int32_t n) {
        x = maximum<std::uint32_t>(x, position[n].x.raw);
        y = maximum<std::uint32_t>(y, position[n].y.raw);
    };
    for (; k + 4 <= count; k += 4) {
        look(k);
        look(k + 1);
        look(k + 2);
        look(k + 3);
    }
    for (; k < count; ++k) {
        look(k);
    }
    return {PositionOf<SmallFixed>::of_raw(static_cast<std::uint16_t>(x)),
            PositionOf<SmallFixed>::of_raw(static_cast<std::uint16_t>(y))};
}

#if WEIR_HAS_LANES
/// Two particles a load, and two loads under way.
template <>
Vec2<float> furthest(const Vec2<float>* position, std::int32_t count) {
    Lanes one = all_lanes(0.0F);
    Lanes other = one;
    std::int32_t k = 0;
    for (; k + 4 <= count; k += 4) {
        one = maximum(one, load_lanes(&position[k].x));
        other = maximum(other, load_lanes(&position[k + 2].x));
    }
    one = maximum(one, other);
    return furthest(position, k, count, {maximum(one[0], one[2]), maximum(one[1], one[3])});
}
#endif

template <class Real>
void empty_row(const GridShape& tank, std::int32_t i0, std::int32_t i1, std::int32_t j,
               PressureFields<Real>& fields) {
    for (std::int32_t i = i0; i < i1; ++i) {
        const std::int32_t c = tank.index(i, j);
        fields.pressure[c] = Real(0);
        fields.density[c] = Real(0);
        fields.level[c] = kEmptyLevel<Real>;
    }
}

}  // namespace

template <class Real>
Vec2<PositionOf<Real>> furthest_of(const Particles<Real>& particles,
                                   Vec2<PositionOf<Real>> so_far) {
    const auto end = furthest(particles.position, particles.count);
    return {maximum(so_far.x, end.x), maximum(so_far.y, end.y)};
}

template <class Real>
GridShape occupied_part(const GridShape& tank, const Borders<Real>& borders,
                        Vec2<PositionOf<Real>> furthest) {
    const Vec2<Real> last{Real(furthest.x), Real(furthest.y)};
    GridShape part = tank;
    if (!borders.wrap_x) {
        part.nx = minimum(tank.nx, static_cast<std::int32_t>(last.x) + kMargin);
    }
    if (!borders.wrap_y) {
        part.ny = minimum(tank.ny, static_cast<std::int32_t>(last.y) + kMargin);
    }
    return part;
}

template <class Real>
bool walls_reach(const GridShape& part, const BodyTable<Real>& bodies, const Walls<Real>& walls) {
    if (walls.thin != nullptr || bodies.load != nullptr) {
        return bodies.used > 0;
    }
    // Distances are known a band around a body; cut cells look one node further.
    const auto reached = [&](const NodeBox& box) {
        return !box.empty() && box.i0 <= part.nx + 1 && box.j0 <= part.ny + 1;
    };
    for (std::int32_t slot = 0; slot < bodies.capacity; ++slot) {
        const Body<Real>& body = bodies.body[slot];
        if (body.kind != BodyKind::free && (reached(body.drawn) || reached(body.left))) {
            return true;
        }
    }
    return false;
}

template <class Real>
void empty_beyond(const GridShape& tank, const GridShape& last, const GridShape& now,
                  PressureFields<Real>& fields, Work work) {
    // The last part's ghost cells lie within the tank, unless it was all of it.
    const std::int32_t columns = minimum(last.nx + 1, tank.nx);
    const std::int32_t all_rows = minimum(last.ny + 1, tank.ny);
    const bool smaller = now.nx < columns || now.ny < all_rows;
    const Part rows = work.take(smaller ? all_rows : 0, columns);
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        empty_row(tank, j < now.ny ? now.nx : 0, columns, j, fields);
    }
}

#define WEIR_INSTANTIATE(Real)                                                               \
    template Vec2<PositionOf<Real>> furthest_of(const Particles<Real>&,                      \
                                                Vec2<PositionOf<Real>>);                     \
    template GridShape occupied_part(const GridShape&, const Borders<Real>&,                 \
                                     Vec2<PositionOf<Real>>);                                \
    template bool walls_reach(const GridShape&, const BodyTable<Real>&, const Walls<Real>&); \
    template void empty_beyond(const GridShape&, const GridShape&, const GridShape&,         \
                               PressureFields<Real>&, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
