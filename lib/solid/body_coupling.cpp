#include "solid/body_levers.hpp"
#include "solid/films.hpp"

namespace weir {

namespace {

template <class Real>
void add_film(const CoupledSolve<Real>& solve, const Meeting<Real>& meeting,
              Levers<Real>& levers) {
    const auto add = [&](std::uint16_t slot) {
        Impulse<Real>* reach = levers.of(slot);
        if (reach != nullptr) {
            const Impulse<Real> film = felt_by(
                solve.obstacles.bodies, slot, meeting, meeting.film);
            levers.before += flow(film, solve.walls.load[slot].unpressed);
            reach->add(film);
        }
    };
    add(meeting.slot);
    if (meeting.other_is_free) {
        add(meeting.other);
    }
}

/// @param own the body that is asked for.
/// @param films whether to look for films at the cell.
template <class Real>
Levers<Real> levers_of(const CoupledSolve<Real>& solve, std::uint16_t own, std::int32_t i,
                       std::int32_t j, bool films = true) {
    const Walls<Real>& walls = solve.walls;
    const std::int32_t cell = solve.shape.index(i, j);
    Levers<Real> levers;
    for_each_closed_face(solve.shape, walls, i, j, [&](const ClosedFace<Real>& face) {
        if (face.slot != kNoBody && walls.load[face.slot].is_free()) {
            const Impulse<Real> reach = reach_of_face(solve.obstacles.bodies, walls, face);
            levers.of(face.slot)->add(reach);
            levers.before += spun_beyond_face(walls.load[face.slot], face, reach);
            if (face.slot == own) {
                const PressureAtRest<Real> at_rest(solve.shape, walls, cell, solve.cells);
                levers.own.add(reach, at_rest.more_at(walls, face));
            }
        }
    });
    if (!films) {
        return levers;
    }
    Meetings<Real>(solve.obstacles.bodies).for_each_film([&](const Meeting<Real>& meeting) {
        if (meeting.film_cell == cell) {
            add_film(solve, meeting, levers);
        }
    });
    return levers;
}

/// Whether a body's face or a film may be at a cell.
template <class Real>
bool is_pressed(const CoupledSolve<Real>& solve, std::int32_t cell) {
    if (!untouched(solve.walls, cell, cell + solve.shape.stride)) {
        return true;
    }
    bool film = false;
    Meetings<Real>(solve.obstacles.bodies).for_each_film(
        [&](const Meeting<Real>& meeting) { film = film || meeting.film_cell == cell; });
    return film;
}

/// Calls visit(slot, box) for the rectangle of each free body.
template <class Real, class Visit>
void for_each_box(const CoupledSolve<Real>& solve, Visit visit) {
    for (std::int32_t slot = 0; slot < solve.obstacles.bodies.capacity; ++slot) {
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

/// What the pressure that there is makes of the bodies, and where they are stopped. Calls
/// before(load) and after(load) for each.
template <class Real, class Before, class After>
void answer_pressure(const CoupledSolve<Real>& solve, Before before, After after) {
    PressureOnFree<Real> pressure(solve.obstacles.bodies);
    for_each_box(solve, [&](std::uint16_t slot, const NodeBox&) {
        BodyLoad<Real>& load = solve.walls.load[slot];
        before(load);
        Impulse<Real> pressed = pressure.next(solve.shape, solve.obstacles.bodies, solve.walls,
                                              slot, solve.cells);
        pressed.add(film_impulse(solve.obstacles, solve.cells, slot));
        load.change = answer_stopped(load, pressed);
        after(load);
    });
}
template <class Real>
void answer_pressure(const CoupledSolve<Real>& solve) {
    const auto nothing = [](const BodyLoad<Real>&) {};
    answer_pressure(solve, nothing, nothing);
}

/// What the bodies push into a cell, as the pressure has changed their velocities.
template <class Real>
Face<Real> pushed_into(const CoupledSolve<Real>& solve, const Lever<Real>* lever,
                       std::int32_t count, Face<Real> sum) {
    for (std::int32_t k = 0; k < count; ++k) {
        sum += flow(lever[k].reach, solve.walls.load[lever[k].slot].change);
    }
    return sum;
}

/// In the diagonal, as a sum, while cells are gone through: that a cell was met, and that it has a
/// film. To go through the films at each cell takes longer than all that they do.
constexpr std::int32_t kMet = 1;
constexpr std::int32_t kHasFilm = 2;

/// Calls visit(box's slot, i, j, cell, levers, whether it was met before) for the cells of liquid
/// on which free bodies press. Films are in their bodies' rectangles.
template <class Real, class Visit>
void for_each_pressed(const CoupledSolve<Real>& solve, Visit visit) {
    for_each_cell(solve, [&](std::int32_t, std::int32_t, std::int32_t c) {
        solve.diagonal[c] = Real(0);
    });
    Meetings<Real>(solve.obstacles.bodies).for_each_film([&](const Meeting<Real>& meeting) {
        solve.diagonal[meeting.film_cell] = Real(kHasFilm);
    });
    for_each_box(solve, [&](std::uint16_t slot, const NodeBox& box) {
        for (std::int32_t j = box.j0; j <= box.j1; ++j) {
            for (std::int32_t i = box.i0; i <= box.i1; ++i) {
                const std::int32_t c = solve.shape.index(i, j);
                const auto mark = floor_to_int(solve.diagonal[c]);
                const bool film = (mark & kHasFilm) != 0;
                if (solve.cells.level[c] > Real(0) &&
                    (film || !untouched(solve.walls, c, c + solve.shape.stride))) {
                    const Levers<Real> levers = levers_of(solve, slot, i, j, film);
                    visit(slot, i, j, c, levers, (mark & kMet) != 0);
                    solve.diagonal[c] = Real(mark | kMet);
                }
            }
        }
    });
}

/// Adds what the bodies push into their cells to the divergence there.
template <class Real>
void add_flow(const CoupledSolve<Real>& solve, Face<Real> sign) {
    const auto add = [&](std::int32_t c, const Lever<Real>* lever, std::int32_t count,
                         Face<Real> before) {
        solve.divergence[c] +=
            static_cast<Real>(sign * pushed_into(solve, lever, count, before));
    };
    const KeptLevers<Real> kept(solve.obstacles.bodies);
    if (!kept.are_kept()) {
        for_each_pressed(solve, [&](std::uint16_t, std::int32_t, std::int32_t, std::int32_t c,
                                    const Levers<Real>& levers, bool again) {
            if (!again && levers.count > 0) {
                add(c, levers.lever, levers.count, levers.before);
            }
        });
        return;
    }
    for (const LeverCell<Real>* at = kept.begin(); at != kept.end(); at = at->next()) {
        if (!at->again) {
            add(solve.shape.index(at->i, at->j), at->levers(), at->count, at->before);
        }
    }
}

/// The diagonal of a cell, with what its bodies yield.
template <class Real>
Face<Real> yielding_diagonal(const CoupledSolve<Real>& solve, std::int32_t c,
                             const Lever<Real>* lever, std::int32_t count) {
    Face<Real> diagonal = static_cast<Face<Real>>(solve.diagonal[c]);
    for (std::int32_t k = 0; k < count; ++k) {
        const BodyLoad<Real>& load = solve.walls.load[lever[k].slot];
        diagonal += flow(lever[k].reach, answer(load, lever[k].reach));
    }
    return diagonal;
}

/// One cell: its pressure, and at once the velocity of the bodies that feel it. The system with
/// the bodies' velocities eliminated, A + JᵀM⁻¹J, is symmetric and positive, and this is its
/// over-relaxation, cell by cell: it converges however light they are.
template <class Real>
void relax_cell(const CoupledSolve<Real>& solve, Real omega, std::int32_t c,
                const Lever<Real>* lever, std::int32_t count, Face<Real> into,
                Face<Real> diagonal) {
    using Number = Face<Real>;
    const GridShape& s = solve.shape;
    const Walls<Real>& walls = solve.walls;
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
    Number residual = static_cast<Number>(sum - solve.divergence[c]) -
                      static_cast<Number>(solve.diagonal[c]) * static_cast<Number>(p[c]);
    residual -= pushed_into(solve, lever, count, into);
    const Number more = static_cast<Number>(omega) * residual / diagonal;
    const Real before = p[c];
    solve.pressure[c] = before + static_cast<Real>(more);
    const Number done = static_cast<Number>(p[c]) - static_cast<Number>(before);
    for (std::int32_t k = 0; k < count; ++k) {
        BodyLoad<Real>& load = walls.load[lever[k].slot];
        const Twist<Real> kick = answer(load, lever[k].reach);
        load.change.velocity = load.change.velocity + done * kick.velocity;
        load.change.spin += done * kick.spin;
    }
}

/// For the solve that follows, if there is room.
template <class Real>
void keep_levers(const CoupledSolve<Real>& solve) {
    if constexpr (WEIR_PARALLEL == 0) {
        return;
    }
    const KeptLevers<Real> kept(solve.obstacles.bodies);
    const std::byte* const room_end = reinterpret_cast<std::byte*>(kept.first) + kept.room;
    LeverCell<Real>* at = kept.first;
    bool fits = true;
    for_each_pressed(solve, [&](std::uint16_t slot, std::int32_t i, std::int32_t j,
                                std::int32_t, const Levers<Real>& levers, bool again) {
        const auto left = room_end - reinterpret_cast<const std::byte*>(at);
        fits = fits && left >= static_cast<std::ptrdiff_t>(sizeof *at + sizeof levers.lever);
        if (!fits || levers.count == 0) {
            return;
        }
        *at = {i, j, slot, static_cast<std::uint8_t>(levers.count), again, levers.before,
               Face<Real>(0), levers.own, -1};
        Lever<Real>* lever = reinterpret_cast<Lever<Real>*>(at + 1);
        for (std::int32_t k = 0; k < levers.count; ++k) {
            lever[k] = levers.lever[k];
        }
        at = at->next();
    });
    *kept.bytes = fits ? kept.place_of(at) : -1;
}

/// Where levers are not kept.
template <class Real>
void relax_unkept(const CoupledSolve<Real>& solve, Real omega, std::int32_t colour) {
    for_each_box(solve, [&](std::uint16_t, const NodeBox& box) {
        for (std::int32_t j = box.j0; j <= box.j1; ++j) {
            for (std::int32_t i = box.i0 + ((box.i0 + j + colour) & 1); i <= box.i1; i += 2) {
                const std::int32_t c = solve.shape.index(i, j);
                if (solve.diagonal[c] != Real(0)) {
                    const Levers<Real> levers = levers_of(solve, kNoBody, i, j);
                    relax_cell(solve, omega, c, levers.lever, levers.count, levers.before,
                               yielding_diagonal(solve, c, levers.lever, levers.count));
                }
            }
        }
    });
}

}  // namespace

/// Cells on which free bodies press are taken out of the other cells' sweeps. Where two bodies'
/// rectangles overlap a cell is met twice.
template <class Real>
void set_aside(const CoupledSolve<Real>& solve) {
    for_each_cell(solve, [&](std::int32_t, std::int32_t, std::int32_t c) {
        solve.diagonal[c] = Real(0);
    });
    const auto take = [&](std::int32_t c) {
        if (solve.inverse_diagonal[c] != Real(0)) {
            solve.diagonal[c] = over_inverse(Real(1), absolute(solve.inverse_diagonal[c]));
            solve.inverse_diagonal[c] = Real(0);
        }
    };
    const KeptLevers<Real> kept(solve.obstacles.bodies);
    if (kept.are_kept()) {
        std::int32_t* link[2] = {kept.chain, kept.chain + 1};
        for (LeverCell<Real>* at = kept.begin(); at != kept.end(); at = at->next()) {
            const std::int32_t c = solve.shape.index(at->i, at->j);
            take(c);
            if (solve.diagonal[c] != Real(0)) {
                at->diagonal = yielding_diagonal(solve, c, at->levers(), at->count);
                std::int32_t*& last = link[(at->i + at->j) & 1];
                *last = kept.place_of(at);
                last = &at->chained;
            }
        }
        *link[0] = *link[1] = -1;
    } else {
        for_each_cell(solve, [&](std::int32_t i, std::int32_t j, std::int32_t c) {
            if (is_pressed(solve, c) && levers_of(solve, kNoBody, i, j).count > 0) {
                take(c);
            }
        });
    }
    answer_pressure(solve);
}

template <class Real>
void end_coupling(const CoupledSolve<Real>& solve) {
    for_each_cell(solve, [&](std::int32_t, std::int32_t, std::int32_t c) {
        if (solve.diagonal[c] != Real(0)) {
            solve.inverse_diagonal[c] = -stored_inverse(solve.diagonal[c]);
            solve.diagonal[c] = Real(0);
        }
    });
}

template <class Real>
void begin_coupling(const CoupledSolve<Real>& solve) {
    lay_films(solve.obstacles, solve.cells);
    keep_levers(solve);
    answer_pressure(solve);
    stop(solve.obstacles, kRoundsBefore);
    add_flow(solve, Face<Real>(1));
}

template <class Real>
Face<Real> yielding(const CoupledSolve<Real>& solve) {
    add_flow(solve, Face<Real>(-1));
    Face<Real> work = Face<Real>(0);
    Twist<Real> before;
    answer_pressure(
        solve, [&](const BodyLoad<Real>& load) { before = load.change; },
        [&](const BodyLoad<Real>& load) {
            const Wide<Real> velocity = load.change.velocity - before.velocity;
            const Face<Real> spin = load.change.spin - before.spin;
            work += load.mass * dot(velocity, velocity) + load.inertia * (spin * spin);
        });
    return work;
}

template <class Real>
void relax_coupled(const CoupledSolve<Real>& solve, Real omega, std::int32_t colour) {
    const KeptLevers<Real> kept(solve.obstacles.bodies);
    if (kept.are_kept()) {
        for (std::int32_t place = kept.chain[colour & 1]; place >= 0;) {
            const LeverCell<Real>& cell = *kept.at(place);
            place = cell.chained;
            relax_cell(solve, omega, solve.shape.index(cell.i, cell.j), cell.levers(), cell.count,
                       cell.before, cell.diagonal);
        }
    } else {
        relax_unkept(solve, omega, colour);
    }
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
