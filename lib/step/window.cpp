#include "step/window.hpp"

#include <cstring>

#include "step/substep.hpp"

namespace weir {

namespace {

template <class T>
void move_back(T*& pointer, std::int32_t entries) {
    pointer = numbered_from(pointer, entries);
}

/// Of the tank's numbering, the first entry of the arrays: a ghost cell's.
std::int32_t first_entry(const GridShape& window) { return window.index(-1, -1); }

std::int32_t rounded_up(std::int32_t cells, std::int32_t at_once) {
    return (cells + at_once - 1) / at_once * at_once;
}

/// A part and what has to be stored around it: what cut cells next to it are is told by the nodes
/// around those. On the left and below the window's ghosts suffice.
template <class Real>
GridShape with_rim(const Simulation<Real>& simulation, const GridShape& part) {
    const GridShape& tank = simulation.layers.shape;
    GridShape wider = part;
    if (simulation.bodies.capacity > 0) {
        wider.nx = minimum(part.nx + 1, tank.nx - part.i0);
        wider.ny = minimum(part.ny + 1, tank.ny - part.j0);
    }
    return wider;
}

/// The least window around a part.
GridShape window_around(const GridShape& tank, const GridShape& part) {
    GridShape window = part;
    window.nx = minimum(tank.nx - part.i0, rounded_up(part.nx, kWindowColumns));
    window.ny = minimum(tank.ny - part.j0, rounded_up(part.ny, kWindowRows));
    window.stride = window.nx + 2;
    return window;
}

/// The least part that holds both.
GridShape united(const GridShape& a, const GridShape& b) {
    GridShape both = a;
    both.i0 = minimum(a.i0, b.i0);
    both.j0 = minimum(a.j0, b.j0);
    both.nx = maximum(a.i0 + a.nx, b.i0 + b.nx) - both.i0;
    both.ny = maximum(a.j0 + a.ny, b.j0 + b.ny) - both.j0;
    return both;
}

/// Moves the entries that two windows share, and empties all others. Rows keep their order: those
/// that go up are moved from the highest on, the others from the lowest.
template <class Field>
void carry(const GridShape& from, const GridShape& to, std::int32_t entries, Field* first) {
    const Part columns{maximum(from.i0, to.i0) - 1,
                       minimum(from.i0 + from.nx, to.i0 + to.nx) + 1};
    const Part rows{maximum(from.j0, to.j0) - 1, minimum(from.j0 + from.ny, to.j0 + to.ny) + 1};
    const std::int32_t width = columns.end - columns.first;
    const auto at = [&](const GridShape& window, std::int32_t i, std::int32_t j) {
        return first + (window.index(i - window.i0, j - window.j0) - first_entry(window));
    };
    const auto move = [&](std::int32_t j, bool upwards) {
        const Field* source = at(from, columns.first, j);
        Field* target = at(to, columns.first, j);
        if ((target > source) == upwards) {
            std::memmove(static_cast<void*>(target), source,
                         static_cast<std::size_t>(width) * sizeof(Field));
        }
    };
    for (std::int32_t j = rows.end - 1; width > 0 && j >= rows.first; --j) {
        move(j, true);
    }
    for (std::int32_t j = rows.first; width > 0 && j < rows.end; ++j) {
        move(j, false);
    }
    const auto clear = [&](Field* begin, const Field* end) {
        std::memset(static_cast<void*>(begin), 0,
                    static_cast<std::size_t>(end - begin) * sizeof(Field));
    };
    for (std::int32_t j = to.j0 - 1; j <= to.j0 + to.ny; ++j) {
        const bool kept = width > 0 && j >= rows.first && j < rows.end;
        Field* begin = at(to, to.i0 - 1, j);
        const Field* end = begin + to.stride;
        clear(begin, kept ? at(to, columns.first, j) : end);
        if (kept) {
            clear(at(to, columns.end, j), end);
        }
    }
    clear(at(to, to.i0 - 1, to.j0 + to.ny + 1), first + entries);
}

/// Particles counted along an axis, in groups of as many cells as a window's sides move by.
struct Groups {
    std::int32_t* count;
    std::int32_t at_once;
    std::int32_t cells;  ///< of the tank
    std::int32_t rim;    ///< cells beyond a part that have to be stored
    Part kept = {};

    std::int32_t of(std::int32_t cell) const { return maximum(0, cell - kMargin) / at_once; }
    bool keeps(std::int32_t cell) const {
        return kept.first <= of(cell) && of(cell) < kept.end;
    }
    void begin() {
        kept = {0, of(cells - 1) + 1};
        for (std::int32_t k = 0; k < kept.end; ++k) {
            count[k] = 0;
        }
    }
    /// Cells of a window that holds what is kept.
    std::int32_t width() const {
        return minimum(cells - kept.first * at_once,
                       rounded_up((kept.end - kept.first) * at_once + 2 * kMargin + rim, at_once));
    }
};

/// Takes the side with the fewest particles away, and of equal ones that with more cells.
void cut(Groups& columns, Groups& rows) {
    struct Side {
        Groups* of;
        std::int32_t group;
        std::int32_t cells;
    };
    const std::int32_t column = columns.at_once * rows.width();
    const std::int32_t row = rows.at_once * columns.width();
    const Side sides[] = {{&columns, columns.kept.first, column},
                          {&columns, columns.kept.end - 1, column},
                          {&rows, rows.kept.first, row},
                          {&rows, rows.kept.end - 1, row}};
    const Side* best = nullptr;
    for (const Side& side : sides) {
        if (side.of->kept.end - side.of->kept.first == 1) {
            continue;
        }
        const std::int32_t count = side.of->count[side.group];
        const std::int32_t least = best != nullptr ? best->of->count[best->group] : 0;
        if (best == nullptr || count < least || (count == least && side.cells > best->cells)) {
            best = &side;
        }
    }
    if (best != nullptr) {
        Part& kept = best->of->kept;
        kept = best->group == kept.first ? Part{kept.first + 1, kept.end}
                                         : Part{kept.first, kept.end - 1};
    }
}

template <class Real>
Vec2<std::int32_t> cell_of(const Particles<Real>& particles, std::int32_t k) {
    return {static_cast<std::int32_t>(Real(particles.position[k].x)),
            static_cast<std::int32_t>(Real(particles.position[k].y))};
}

/// Puts those that are not kept before the others. Returns how many they are.
template <class Real>
std::int32_t part_pool(const Groups& columns, const Groups& rows, Particles<Real>& particles) {
    std::int32_t beyond = 0;
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<std::int32_t> cell = cell_of(particles, k);
        if (!columns.keeps(cell.x) || !rows.keeps(cell.y)) {
            particles.swap(k, beyond++);
        }
    }
    return beyond;
}

/// Lets the pool begin so many particles later.
template <class Real>
void begin_pool(std::int32_t later, Simulation<Real>& simulation) {
    simulation.particles.begin_later(later);
    simulation.window.beyond += later;
}

}  // namespace

/// The picture of the solids goes along.
template <class Real>
void number_walls(const GridShape& window, std::int32_t on, Layers<Real>& layers) {
    Walls<Real>& walls = layers.walls;
    move_back(layers.static_distance, on);
    move_back(layers.static_nearest, on);
    move_back(layers.nodes, on);
    move_back(layers.scratch, on);
    move_back(walls.distance, on);
    move_back(walls.nearest, on);
    move_back(walls.cell_case, on);
    move_back(walls.open_u, on);
    move_back(walls.open_v, on);
    move_back(walls.full_density, on);
    const GridShape before = stored_part(walls, layers.shape);
    move_back(walls.near, first_near_word(window) - first_near_word(before));
}

template <class Real>
void number_cells(const GridShape& window, Simulation<Real>& simulation) {
    StaggeredGrid<Real>& grid = simulation.grid;
    PressureFields<Real>& fields = simulation.pressure;
    const std::int32_t origin = first_entry(window);
    const std::int32_t on = origin - grid.origin;
    if (kHasWindow<Real> && on != 0) {
        VelocityOf<Real>** const faces[] = {&grid.u, &grid.v, &grid.mass_u, &grid.mass_v,
                                            &fields.divergence, &fields.inverse_diagonal};
        for (VelocityOf<Real>** field : faces) {
            move_back(*field, on);
        }
        if (grid.inverse_density_u != nullptr) {
            move_back(grid.inverse_density_u, on);
            move_back(grid.inverse_density_v, on);
        }
        move_back(grid.pairs, 2 * on);
        move_back(fields.pressure, on);
        move_back(fields.density, on);
        move_back(fields.level, on);
    }
    if constexpr (kHasWindow<Real>) {
        number_walls(window, on, simulation.layers);
    }
    grid.origin = origin;
    if constexpr (kHasWindow<Real>) {
        simulation.layers.walls.stored.at = window;
    }
    simulation.layers.shape.stride = window.stride;
    const std::int32_t coarse = coarse_cells(window.nx);
    fields.coarse.shape = {coarse, coarse_cells(window.ny), coarse + 2};
}

template <class Real>
bool fits_window(const Simulation<Real>& simulation, const GridShape& part) {
    const GridShape window =
        window_around(simulation.layers.shape, with_rim(simulation, part));
    return window.size() <= simulation.window.cells;
}

template <class Real>
bool is_window(const Simulation<Real>& simulation, const GridShape& part) {
    const GridShape& tank = simulation.layers.shape;
    const Borders<Real>& borders = simulation.settings.borders;
    const GridShape window = window_around(tank, part);
    return part.i0 % kWindowColumns == 0 && part.j0 % kWindowRows == 0 &&
           part.i0 < tank.nx && part.j0 < tank.ny && window.nx == part.nx &&
           window.ny == part.ny && (!borders.wrap_x || part.nx == tank.nx) &&
           (!borders.wrap_y || part.ny == tank.ny) && window.size() <= simulation.window.cells;
}

template <class Real>
GridShape hide_beyond(Simulation<Real>& simulation) {
    const GridShape& tank = simulation.layers.shape;
    const Borders<Real>& borders = simulation.settings.borders;
    Particles<Real>& particles = simulation.particles;
    // Velocity and mass are not yet in use.
    auto* room = reinterpret_cast<std::int32_t*>(simulation.grid.u + simulation.grid.origin);
    const std::int32_t rim = simulation.bodies.capacity > 0 ? 1 : 0;
    Groups columns{room, borders.wrap_x ? tank.nx : kWindowColumns, tank.nx, rim};
    columns.begin();
    Groups rows{room + columns.kept.end, borders.wrap_y ? tank.ny : kWindowRows, tank.ny, rim};
    rows.begin();
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<std::int32_t> cell = cell_of(particles, k);
        ++columns.count[columns.of(cell.x)];
        ++rows.count[rows.of(cell.y)];
    }
    while (entries_of(columns.width(), rows.width()) > simulation.window.cells) {
        cut(columns, rows);
    }
    std::int32_t beyond = part_pool(columns, rows, particles);
    if (beyond == particles.count) {  // sides were cut that had been all that there is
        const Vec2<std::int32_t> cell = cell_of(particles, 0);
        columns.kept = {columns.of(cell.x), columns.of(cell.x) + 1};
        rows.kept = {rows.of(cell.y), rows.of(cell.y) + 1};
        beyond = part_pool(columns, rows, particles);
    }
    begin_pool(beyond, simulation);
    simulation.extent = extent_of(particles);
    return occupied_part(tank, borders, simulation.extent, false);
}

template <class Real>
void show_beyond(Simulation<Real>& simulation) {
    begin_pool(-simulation.window.beyond, simulation);
}

/// Whether a window reaches all around a part.
inline bool reaches(const GridShape& window, const GridShape& part) {
    const GridShape both = united(window, part);
    return both.nx == window.nx && both.ny == window.ny;
}

template <class Real>
std::int32_t move_window(const GridShape& part, Simulation<Real>& simulation) {
    const GridShape& tank = simulation.layers.shape;
    const GridShape before = stored_part(simulation);
    const GridShape rim = with_rim(simulation, part);
    if (reaches(before, rim)) {
        return 0;
    }
    const GridShape both = united(before, rim);
    // It stays where it can: liquid that comes and goes does not move it each time.
    const std::int32_t entries = simulation.window.cells;
    const bool stays = window_around(tank, both).size() <= entries;
    const GridShape now = window_around(tank, stays ? both : rim);
    PressureFields<Real>& fields = simulation.pressure;
    carry(before, now, entries, fields.pressure + simulation.grid.origin);
    carry(before, now, entries, fields.density + simulation.grid.origin);
    auto* level = fields.level + simulation.grid.origin;
    for (std::int32_t c = 0; c < entries; ++c) {
        level[c] = kEmptyLevel<Real>;
    }
    number_cells(now, simulation);
    return entries + simulation.stages->draw_stored(simulation.layers, simulation.bodies);
}

/// A part and, of what the last substep worked on, the cells that a window may not lose.
template <class Real>
GridShape with_fields(const Simulation<Real>& simulation, const GridShape& part,
                      bool densities_are_shown) {
    const GridShape& tank = simulation.layers.shape;
    const PressureFields<Real>& fields = simulation.pressure;
    const GridShape last = simulation.occupied;
    GridShape all = part;
    for (std::int32_t j = last.j0; j < last.j0 + last.ny; ++j) {
        for (std::int32_t i = last.i0; i < last.i0 + last.nx; ++i) {
            const std::int32_t c = tank.index(i, j);
            if (fields.pressure[c] != Real(0) ||
                (densities_are_shown && fields.density[c] != DensityOf<Real>(0))) {
                const std::int32_t columns = i % kWindowColumns;  // windows begin at whole groups
                const std::int32_t rows = j % kWindowRows;
                all = united(all, {columns + 1, rows + 1, 0, i - columns, j - rows});
            }
        }
    }
    return all;
}

template <class Real>
bool look_around(Simulation<Real>& simulation, bool densities_are_shown) {
    const GridShape& tank = simulation.layers.shape;
    const Particles<Real>& particles = simulation.particles;
    const Extent<Real> extent = particles.count > 0 ? extent_of(particles) : Extent<Real>{};
    GridShape part = occupied_part(tank, simulation.settings.borders, extent, false);
    GridShape both = united(part, simulation.occupied);
    // What was restored may stand anywhere in the window, and leaves no room for a rim.
    if (!reaches(stored_part(simulation), with_rim(simulation, part))) {
        both = with_fields(simulation, part, densities_are_shown);
        if (!fits_window(simulation, both)) {
            return false;
        }
        move_window(both, simulation);
        both = stored_part(simulation);
    }
    part.stride = both.stride = tank.stride;
    simulation.occupied = both;
    simulation.grid.shape = part;
    return true;
}

#define WEIR_INSTANTIATE(Real)                                                              \
    template bool fits_window(const Simulation<Real>&, const GridShape&);                   \
    template bool is_window(const Simulation<Real>&, const GridShape&);                     \
    template GridShape hide_beyond(Simulation<Real>&);                                      \
    template void show_beyond(Simulation<Real>&);                                           \
    template std::int32_t move_window(const GridShape&, Simulation<Real>&);                 \
    template bool look_around(Simulation<Real>&, bool);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

#define WEIR_INSTANTIATE(Real) template void number_cells(const GridShape&, Simulation<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
