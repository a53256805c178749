#include "pressure/equation_of_state.hpp"

#include "pressure/parting.hpp"

namespace weir {

namespace {

/// Bulk viscosity in units of sound speed × cell.
template <class Real>
constexpr Real kBulkViscosity = Real(0.375);

/// c dt, cells.
template <class Real>
Real way_of_sound(const PressureFields<Real>& fields) {
    return fields.last_dt * fields.sound_speed;
}

/// The flow out of a cell that counts: less of it where the equation is stiff, or the cell thin.
template <class Real>
Real counted_flow(const PressureFields<Real>& fields, std::int32_t c) {
    const Real density = minimum(Real(1), Real(fields.density[c]));
    const Real kept = absolute(Real(fields.inverse_diagonal[c]));
    if constexpr (Stored<Real>::shares_momentum) {  // the diagonal itself
        const Real flow = density * Real(fields.divergence[c]);
        return kept > Real(4) ? Real(4) * flow / kept : flow;
    } else {
        return minimum(Real(1), times_inverse(Real(4), kept)) * density * fields.divergence[c];
    }
}

/// What bulk viscosity makes of a flow out of a cell. It does not hold liquid to a wall that air
/// can come to.
template <class Real>
Real resistance(const Domain<Real>& domain, std::int32_t c, Real flow) {
    const bool parts =
        flow > Real(0) &&
        parts_from_wall(domain.fields, domain.walls.full_density, domain.grid.shape, c);
    return parts ? Real(0) : kBulkViscosity<Real> * flow;
}

/// body(cell) for all that are liquid and not shut in. (Beside liquid diagonals may hold a mark.)
template <class Real, class Body>
void for_each_liquid(const GridShape& s, const Part& rows, const PressureFields<Real>& fields,
                     const Body& body) {
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const std::int32_t end = s.index(s.nx, j);
        for (std::int32_t c = s.index(0, j); c < end; ++c) {
            if (fields.level[c] > LevelOf<Real>(0) &&
                fields.inverse_diagonal[c] != VelocityOf<Real>(0)) {
                body(c);
            }
        }
    }
}

/// A liquid cell's pressure, by what has flown in.
template <class Real>
Real carried(const OpenWeights<Real>& weights, const PressureFields<Real>& fields, std::int32_t i,
             std::int32_t j) {
    const StaggeredGrid<Real>& grid = weights.grid;
    const std::int32_t stride = grid.shape.stride;
    const std::int32_t c = grid.shape.index(i, j);
    const Real here = fields.pressure[c];
    const bool left = weights.has_left(i);
    const bool right = weights.has_right(i);
    const bool below = weights.has_lower(j);
    const bool above = weights.has_upper(j);
    // A wall's face lets nothing through, whatever number stands there.
    const auto mean = [](const VelocityOf<Real>* velocity, std::int32_t first, bool has_first,
                         std::int32_t second, bool has_second) {
        return ((has_first ? Real(velocity[first]) : Real(0)) +
                (has_second ? Real(velocity[second]) : Real(0))) *
               Real(0.5);
    };
    const auto less = [&](bool there, std::int32_t from) {
        return there && fields.level[from] > LevelOf<Real>(0) ? here - fields.pressure[from]
                                                              : Real(0);
    };
    const Real u = mean(grid.u, c, left, c + 1, right);
    const Real v = mean(grid.v, c, below, c + stride, above);
    const Real from_x = u > Real(0) ? less(left, c - 1) : less(right, c + 1);
    const Real from_y = v > Real(0) ? less(below, c - stride) : less(above, c + stride);
    const Real way_x = fields.last_dt * absolute(u);
    const Real way_y = fields.last_dt * absolute(v);
    const Real lost = way_x * from_x + way_y * from_y;
    const Real way = way_x + way_y;
    return here - (way > Real(1) ? lost / way : lost);
}

}  // namespace

template <class Real>
void follow_sound(Real sound_speed, PressureFields<Real>& fields) {
    if (sound_speed < fields.sound_speed) {
        fields.change = fields.change * (sound_speed / fields.sound_speed);
    }
    fields.sound_speed = sound_speed;
}

template <class Real>
void carry_pressure(const OpenWeights<Real>& weights, PressureFields<Real>& fields, Work work) {
    const GridShape& s = weights.grid.shape;
    for (std::int32_t colour = 0; colour < 2; ++colour) {
        if (work.once(s.border())) {
            extend_cells(weights.borders, s, fields.pressure);
        }
        work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
            for (std::int32_t j = rows.first; j < rows.end; ++j) {
                for (std::int32_t i = (j + colour) & 1; i < s.nx; i += 2) {
                    const std::int32_t c = s.index(i, j);
                    if (fields.level[c] > LevelOf<Real>(0)) {
                        fields.pressure[c] = carried(weights, fields, i, j);
                    }
                }
            }
        });
    }
}

template <class Real>
void compress(const Domain<Real>& domain, Work work) {
    const GridShape& shape = domain.grid.shape;
    PressureFields<Real>& fields = domain.fields;
    const Real way = way_of_sound(fields);
    work.share(work.take(shape.ny, shape.nx), shape.nx, 1, [&](const Part& rows, std::int32_t) {
        for_each_liquid(shape, rows, fields, [&](std::int32_t c) {
            const Real flow = way * counted_flow(fields, c);
            fields.pressure[c] = maximum(Real(0), fields.pressure[c] - way * flow) -
                                 resistance(domain, c, flow);
        });
    });
    if (work.once(shape.border())) {
        make_room_at_inlets(domain);
        extend_cells(domain.borders, shape, fields.pressure);
    }
}

template <class Real>
void release_pressure(const Domain<Real>& domain, Work work) {
    const GridShape& shape = domain.grid.shape;
    PressureFields<Real>& fields = domain.fields;
    const Real way = way_of_sound(fields);
    work.share(work.take(shape.ny, shape.nx), shape.nx, 1, [&](const Part& rows, std::int32_t) {
        for_each_liquid(shape, rows, fields, [&](std::int32_t c) {
            const Real flow = way * counted_flow(fields, c);
            fields.pressure[c] += resistance(domain, c, flow);
        });
    });
}

#define WEIR_INSTANTIATE(Real)                                                           \
    template void follow_sound(Real, PressureFields<Real>&);                             \
    template void carry_pressure(const OpenWeights<Real>&, PressureFields<Real>&, Work); \
    template void compress(const Domain<Real>&, Work);                                   \
    template void release_pressure(const Domain<Real>&, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
