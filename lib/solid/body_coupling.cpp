#include "solid/body_coupling.hpp"

#include "solid/obstacles.hpp"

namespace weir {

namespace {

template <class Real>
Face<Real> flow(const Impulse<Real>& reach, const Twist<Real>& twist) {
    return dot(reach.linear, twist.velocity) + reach.angular * twist.spin;
}

/// Of a body's closed faces on one cell: what the body's twist pushes into the cell. The bodies of
/// a cell's four faces may be four.
template <class Real>
struct Lever {
    std::uint16_t slot = kNoBody;
    Impulse<Real> reach;  ///< flow = reach · twist
};

template <class Real>
struct Levers {
    Lever<Real> lever[6];
    std::int32_t count = 0;
    Face<Real> before = Face<Real>(0);  ///< what goes into films, as bodies are before the pressure

    Impulse<Real>* of(std::uint16_t slot) {
        std::int32_t k = 0;
        while (k < count && lever[k].slot != slot) {
            ++k;
        }
        if (k == 6) {
            return nullptr;
        }
        count = maximum(count, k + 1);
        lever[k].slot = slot;
        return &lever[k].reach;
    }
};

template <class Real>
void add_film(const CoupledSolve<Real>& solve, const Meeting<Real>& meeting,
              Levers<Real>& levers) {
    Impulse<Real>* reach = levers.of(meeting.slot);
    if (reach != nullptr) {
        const BodyLoad<Real>& load = solve.walls.load[meeting.slot];
        const Impulse<Real> film = meeting.pushes(load, Face<Real>(1));
        levers.before += flow(film, load.unpressed);
        reach->add(film);
    }
}

template <class Real>
Levers<Real> levers_of(const CoupledSolve<Real>& solve, std::int32_t i, std::int32_t j) {
    const Walls<Real>& walls = solve.walls;
    Levers<Real> levers;
    for_each_closed_face(solve.shape, walls, i, j, [&](const ClosedFace<Real>& face) {
        if (face.slot != kNoBody && walls.load[face.slot].is_free()) {
            levers.of(face.slot)->add(convert<Face<Real>>(face.outward),
                                      convert<Face<Real>>(face.centre) -
                                          walls.load[face.slot].at);
        }
    });
    const std::int32_t cell = solve.shape.index(i, j);
    Meetings<Real>(solve.obstacles.bodies).for_each_film([&](const Meeting<Real>& meeting) {
        if (meeting.film_cell == cell && meeting.is_wet(solve.cells)) {
            add_film(solve, meeting, levers);
        }
    });
    return levers;
}

/// Whether a body's face or a film may be at a cell.
template <class Real>
bool is_pressed(const CoupledSolve<Real>& solve, std::int32_t cell) {
    bool film = false;
    Meetings<Real>(solve.obstacles.bodies).for_each_film(
        [&](const Meeting<Real>& meeting) { film = film || meeting.film_cell == cell; });
    return film || !untouched(solve.walls, cell, cell + solve.shape.stride);
}

/// Calls visit(slot, box) for the rectangle of each free body.
template <class Real, class Visit>
void for_each_box(const CoupledSolve<Real>& solve, Visit visit) {
    for (std::int32_t slot = 0; slot < solve.walls.bodies; ++slot) {
        if (solve.walls.load[slot].is_free()) {
            visit(static_cast<std::uint16_t>(slot),
                  cells_of(solve.shape, solve.walls.body[slot].drawn));
        }
    }
}

/// Calls visit(i, j, cell) for the cells of the free bodies' rectangles.
template <class Real, class Visit>
void for_each_cell(const CoupledSolve<Real>& solve, Visit visit) {
    for_each_box(solve, [&](std::uint16_t, const NodeBox& box) {
        for (std::int32_t j = box.j0; j <= box.j1; ++j) {
            for (std::int32_t i = box.i0; i <= box.i1; ++i) {
                visit(i, j, solve.shape.index(i, j));
            }
        }
    });
}

/// What the pressure that there is makes of the bodies, and where they are stopped.
template <class Real>
void answer_pressure(const CoupledSolve<Real>& solve, std::uint16_t slot) {
    BodyLoad<Real>& load = solve.walls.load[slot];
    Impulse<Real> pressed = pressure_impulse(solve.shape, solve.walls, slot, solve.cells);
    pressed.add(film_impulse(solve.obstacles, solve.cells, slot));
    load.change = answer_stopped(load, pressed);
}
template <class Real>
void answer_pressure(const CoupledSolve<Real>& solve) {
    for_each_box(solve,
                 [&](std::uint16_t slot, const NodeBox&) { answer_pressure(solve, slot); });
}

/// What the bodies push into a cell, as the pressure has changed their velocities.
template <class Real>
Face<Real> pushed_into(const CoupledSolve<Real>& solve, const Levers<Real>& levers) {
    Face<Real> sum = levers.before;
    for (std::int32_t k = 0; k < levers.count; ++k) {
        sum += flow(levers.lever[k].reach, solve.walls.load[levers.lever[k].slot].change);
    }
    return sum;
}

/// Adds what the bodies push into their cells to the divergence there. The diagonal serves as a
/// mark for cells that were met.
template <class Real>
void add_flow(const CoupledSolve<Real>& solve, Face<Real> sign) {
    for_each_cell(solve, [&](std::int32_t, std::int32_t, std::int32_t c) {
        solve.diagonal[c] = Real(0);
    });
    for_each_cell(solve, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
        if (solve.diagonal[c] == Real(0) &&
            is_pressed(solve, c)) {
            const Levers<Real> levers = levers_of(solve, i, j);
            solve.divergence[c] += static_cast<Real>(sign * pushed_into(solve, levers));
            solve.diagonal[c] = Real(1);
        }
    });
}

/// One cell: its pressure, and at once the velocity of the bodies that feel it. The system with
/// the bodies' velocities eliminated, A + JᵀM⁻¹J, is symmetric and positive, and this is its
/// over-relaxation, cell by cell: it converges however light they are.
template <class Real>
void relax_cell(const CoupledSolve<Real>& solve, Real omega, std::int32_t i, std::int32_t j) {
    using Number = Face<Real>;
    const GridShape& s = solve.shape;
    const Walls<Real>& walls = solve.walls;
    const std::int32_t c = s.index(i, j);
    const std::int32_t up = c + s.stride;
    const auto weight = [&](const ShareOf<Real>* open, const VelocityOf<Real>* light,
                            std::int32_t face) -> Real {
        return light == nullptr ? open[face] : open[face] * light[face];
    };
    const Real* p = solve.pressure;
    const Real sum = (weight(walls.open_u, solve.light_u, c) * p[c - 1] +
                      weight(walls.open_u, solve.light_u, c + 1) * p[c + 1]) +
                     (weight(walls.open_v, solve.light_v, c) * p[c - s.stride] +
                      weight(walls.open_v, solve.light_v, up) * p[up]);
    const Levers<Real> levers = levers_of(solve, i, j);
    Number diagonal = static_cast<Number>(solve.diagonal[c]);
    Number residual = static_cast<Number>(sum - solve.divergence[c]) -
                      diagonal * static_cast<Number>(p[c]);
    for (std::int32_t k = 0; k < levers.count; ++k) {
        const Lever<Real>& lever = levers.lever[k];
        const BodyLoad<Real>& load = walls.load[lever.slot];
        diagonal += flow(lever.reach, answer(load, lever.reach));
    }
    residual -= pushed_into(solve, levers);
    const Number more = static_cast<Number>(omega) * residual / diagonal;
    const Real before = p[c];
    solve.pressure[c] = before + static_cast<Real>(more);
    const Number done = static_cast<Number>(p[c]) - static_cast<Number>(before);
    for (std::int32_t k = 0; k < levers.count; ++k) {
        BodyLoad<Real>& load = walls.load[levers.lever[k].slot];
        const Twist<Real> kick = answer(load, levers.lever[k].reach);
        load.change.velocity = load.change.velocity + done * kick.velocity;
        load.change.spin += done * kick.spin;
    }
}

}  // namespace

/// Cells on which free bodies press are taken out of the other cells' sweeps. Where two bodies'
/// rectangles overlap a cell is met twice.
template <class Real>
void set_aside(const CoupledSolve<Real>& solve) {
    for_each_cell(solve, [&](std::int32_t, std::int32_t, std::int32_t c) {
        solve.diagonal[c] = Real(0);
    });
    for_each_cell(solve, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
        if (is_pressed(solve, c) &&
            solve.inverse_diagonal[c] != Real(0) &&
            levers_of(solve, i, j).count > 0) {
            solve.diagonal[c] = Real(1) / absolute(solve.inverse_diagonal[c]);
            solve.inverse_diagonal[c] = Real(0);
        }
    });
    answer_pressure(solve);
}

template <class Real>
void end_coupling(const CoupledSolve<Real>& solve) {
    for_each_cell(solve, [&](std::int32_t, std::int32_t, std::int32_t c) {
        if (solve.diagonal[c] != Real(0)) {
            solve.inverse_diagonal[c] = Real(-1) / solve.diagonal[c];
            solve.diagonal[c] = Real(0);
        }
    });
}

template <class Real>
void begin_coupling(const CoupledSolve<Real>& solve) {
    answer_pressure(solve);
    stop(solve.obstacles, kRoundsBefore);
    add_flow(solve, Face<Real>(1));
}

template <class Real>
Face<Real> yielding(const CoupledSolve<Real>& solve) {
    add_flow(solve, Face<Real>(-1));
    Face<Real> work = Face<Real>(0);
    for_each_box(solve, [&](std::uint16_t slot, const NodeBox&) {
        BodyLoad<Real>& load = solve.walls.load[slot];
        const Twist<Real> before = load.change;
        answer_pressure(solve, slot);
        const Wide<Real> velocity = load.change.velocity - before.velocity;
        const Face<Real> spin = load.change.spin - before.spin;
        work += load.mass * dot(velocity, velocity) + load.inertia * (spin * spin);
    });
    return work;
}

template <class Real>
void relax_coupled(const CoupledSolve<Real>& solve, Real omega, std::int32_t colour) {
    for_each_box(solve, [&](std::uint16_t, const NodeBox& box) {
        for (std::int32_t j = box.j0; j <= box.j1; ++j) {
            for (std::int32_t i = box.i0 + ((box.i0 + j + colour) & 1); i <= box.i1; i += 2) {
                if (solve.diagonal[solve.shape.index(i, j)] != Real(0)) {
                    relax_cell(solve, omega, i, j);
                }
            }
        }
    });
    stop(solve.obstacles, kRoundsBetween);
}

#define WEIR_INSTANTIATE(Real)                                                  \
    template void begin_coupling(const CoupledSolve<Real>&);                    \
    template Face<Real> yielding(const CoupledSolve<Real>&);                    \
    template void set_aside(const CoupledSolve<Real>&);                         \
    template void relax_coupled(const CoupledSolve<Real>&, Real, std::int32_t); \
    template void end_coupling(const CoupledSolve<Real>&);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
