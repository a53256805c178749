#include "pressure/surface_tension.hpp"

#include "solid/contour_hit.hpp"
#include "solid/open_around.hpp"

namespace weir {

namespace {

/// No grid shows a drop smaller than a cell, 1/cells.
template <class Real>
constexpr Real kSharpest = Real(1);

/// |∇f|² below which there is no surface; at one it is about 0.1.
template <class Real>
constexpr Real kFlat = Real(1.0e-6);

/// What the lines on both sides add to a second difference, by Simpson's rule: f is a step a few
/// cells wide, of which a central difference tells the mean slope over two cells. Of its own line
/// alone κ was 1.14 times as large along the axes and 0.88 along diagonals.
template <class Real>
constexpr Real kBeside = Real(1.0 / 6.0);

/// Whether a contour or a thin wall is within a cell of some cells of a row.
template <class Real>
bool any_wall(const GridShape& s, const Walls<Real>& walls, const Part& columns, std::int32_t j) {
    if (!walls.active) {
        return false;
    }
    const std::int32_t first = maximum(columns.first - 1, 0);
    const std::int32_t count = minimum(columns.end + 1, s.nx) - first;
    for (std::int32_t row = maximum(j - 1, 0); row <= minimum(j + 1, s.ny - 1); ++row) {
        if (!are_zero(walls.cell_case + s.index(first, row), count)) {
            return true;
        }
    }
    if constexpr (kHasThinWalls<Real>) {
        return next_marked(walls.thin, s, j, j, columns.first, columns.end, kNear) < columns.end;
    }
    return false;
}

/// Whether a cell's centre is in a solid.
template <class Real>
bool is_behind(const GridShape& s, const Walls<Real>& walls, std::int32_t c) {
    if (!walls.active || walls.cell_case[c] == kCellOutside) {
        return false;
    }
    const DistanceOf<Real>* low = walls.distance + c;
    return (Real(low[0]) + Real(low[1])) + (Real(low[s.stride]) + Real(low[s.stride + 1])) <
           Real(0);
}

/// Whether a thin wall stands between the centres of two cells side by side.
template <class Real>
bool are_parted(const Walls<Real>& walls, std::int32_t a, std::int32_t b) {
    if (walls.thin == nullptr || a == b) {
        return false;
    }
    const std::uint32_t closed = a - b == 1 || b - a == 1 ? kLeftClosed : kLowerClosed;
    return (walls.thin->mark[maximum(a, b)] & closed) != 0;
}

/// One axis of the smoothing, `step` from cell to cell.
template <class Field, class Real>
void smooth(const GridShape& s, const Part& rows, std::int32_t step, const Field* from,
            VelocityOf<Real>* to) {
    const auto at = [&](std::int32_t c) { return minimum(Real(from[c]), Real(1)); };
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            to[c] = Real(0.5) * at(c) + Real(0.25) * (at(c - step) + at(c + step));
        }
    }
}

/// What a field has in a cell's 3 × 3 cells, row by row. Beyond a wall stands the mirror image of
/// what is before it, as beyond the tank's: whatever wets it does so at a right angle.
template <class Real>
struct Around {
    Real f[9];

    template <class Field>
    Around(const GridShape& s, const Walls<Real>& walls, const Field* field, std::int32_t i,
           std::int32_t j)
        : Around(s, walls, field, i, j, any_wall(s, walls, {i, i + 1}, j)) {}

    template <class Field>
    Around(const GridShape& s, const Walls<Real>& walls, const Field* field, std::int32_t i,
           std::int32_t j, bool walled) {
        if (walled) {
            look(s, walls, field, i, j);
            return;
        }
        for (std::int32_t k = 0; k < 9; ++k) {
            f[k] = field[s.index(i + k % 3 - 1, j + k / 3 - 1)];
        }
    }

private:
    template <class Field>
    void look(const GridShape& s, const Walls<Real>& walls, const Field* field, std::int32_t i,
              std::int32_t j) {
        const bool out = !is_behind(s, walls, s.index(i, j));
        std::int32_t cell[9];
        bool hidden[9];
        for (std::int32_t k = 0; k < 9; ++k) {
            cell[k] = s.index(clamp(i + k % 3 - 1, 0, s.nx - 1), clamp(j + k / 3 - 1, 0, s.ny - 1));
            hidden[k] = walls.cell_case[cell[k]] == kCellInside ||
                        (out && is_behind(s, walls, cell[k]));
        }
        const auto sees = [&](std::int32_t from, std::int32_t to) {
            return !hidden[to] && !are_parted(walls, cell[from], cell[to]);
        };
        f[4] = field[cell[4]];
        bool side[9] = {};
        for (std::int32_t k = 1; k < 9; k += 2) {
            side[k] = sees(4, k);
            f[k] = field[cell[side[k] ? k : 4]];
        }
        for (std::int32_t k = 0; k < 9; k += k == 2 ? 4 : 2) {  // corners
            const std::int32_t x = k % 3 == 0 ? 3 : 5;
            const std::int32_t y = k < 3 ? 1 : 7;
            if ((side[x] && sees(x, k)) || (side[y] && sees(y, k))) {
                f[k] = field[cell[k]];
            } else {
                f[k] = side[x] == side[y] ? Real(0.5) * (f[x] + f[y]) : f[side[x] ? x : y];
            }
        }
    }
};

/// Both axes at once, where there are walls: one after the other would tell walls that lean one way
/// from those that lean the other way, and drops slid along them.
template <class Real>
void smooth_beside(const GridShape& s, const Walls<Real>& walls, const Part& rows,
                   const DensityOf<Real>* from, VelocityOf<Real>* to) {
    constexpr std::int32_t kAtOnce = 8;
    const auto beside = [&](std::int32_t i, std::int32_t j) {
        const Around<Real> around(s, walls, from, i, j, true);
        Real sum = Real(0);
        for (std::int32_t k = 0; k < 9; ++k) {
            const Real weight = Real(k == 4 ? 0.25 : (k % 2 == 1 ? 0.125 : 0.0625));
            sum += weight * minimum(around.f[k], Real(1));
        }
        to[s.index(i, j)] = sum;
    };
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        for (std::int32_t first = 0; first < s.nx; first += kAtOnce) {
            const Part some{first, minimum(first + kAtOnce, s.nx)};
            if (!any_wall(s, walls, some, j)) {
                continue;
            }
            for (std::int32_t i = some.first; i < some.end; ++i) {
                if (walls.cell_case[s.index(i, j)] != kCellInside &&
                    any_wall(s, walls, {i, i + 1}, j)) {
                    beside(i, j);
                }
            }
        }
    }
}

/// κ = −(fxx fy² − 2 fx fy fxy + fyy fx²) / |∇f|³ at a cell's centre, from its 3 × 3 cells.
template <class Real>
Real curvature(const Around<Real>& around) {
    const Real* const f = around.f;
    const Real fx = Real(0.5) * (f[5] - f[3]);
    const Real fy = Real(0.5) * (f[7] - f[1]);
    const Real steepness = fx * fx + fy * fy;
    if (!(steepness > kFlat<Real>)) {
        return Real(0);
    }
    const auto bent = [f](std::int32_t k, std::int32_t along, std::int32_t across) {
        const auto line = [f, along](std::int32_t at) {
            return (f[at + along] + f[at - along]) - Real(2) * f[at];
        };
        return line(k) + kBeside<Real> * ((line(k + across) + line(k - across)) -
                                          Real(2) * line(k));
    };
    const Real fxx = bent(4, 1, 3);
    const Real fyy = bent(4, 3, 1);
    const Real fxy = Real(0.25) * ((f[8] + f[0]) - (f[6] + f[2]));
    const Real bend = (fxx * fy * fy + fyy * fx * fx) - Real(2) * fx * fy * fxy;
    return clamp(-bend / (steepness * square_root(steepness)), -kSharpest<Real>,
                 kSharpest<Real>);
}

/// Mean curvature of the surface between an air cell and the liquid cells beside it. Of two cells
/// between whose centres a contour passes the one in the open tells it.
template <class Real>
Real surface_curvature(const GridShape& s, const Walls<Real>& walls, const VelocityOf<Real>* f,
                       const LevelOf<Real>* level, std::int32_t i, std::int32_t j) {
    const std::int32_t air = s.index(i, j);
    const bool air_behind = is_behind(s, walls, air);
    Real sum = Real(0);
    Real count = Real(0);
    Real in_air = Real(0);
    const auto look = [&](std::int32_t x, std::int32_t y) {
        const std::int32_t liquid = s.index(x, y);
        if (!(level[liquid] > Real(0)) || are_parted(walls, air, liquid)) {
            return;
        }
        in_air = count > Real(0) ? in_air : curvature(Around<Real>(s, walls, f, i, j));
        const Real in_liquid = curvature(Around<Real>(s, walls, f, x, y));
        const bool across = is_behind(s, walls, liquid) != air_behind;
        const Real way = across ? Real(air_behind ? 0 : 1)
                                : level[liquid] / (level[liquid] - level[air]);
        sum += in_liquid + way * (in_air - in_liquid);
        count += Real(1);
    };
    look(i - 1, j);
    look(i + 1, j);
    look(i, j - 1);
    look(i, j + 1);
    return count > Real(0) ? sum / count : Real(0);
}

}  // namespace

template <class Real>
void surface_tension(const Domain<Real>& domain, Real amount, Work work) {
    const GridShape& s = domain.grid.shape;
    const Borders<Real>& borders = domain.borders;
    PressureFields<Real>& fields = domain.fields;
    VelocityOf<Real>* f = fields.divergence;
    VelocityOf<Real>* between = fields.inverse_diagonal;
    if (work.once(s.border())) {
        mirror_cells(borders, s, fields.density);
    }
    smooth<DensityOf<Real>, Real>(s, work.take(s.ny, s.nx), 1, fields.density, between);
    if (work.once(s.border())) {
        mirror_cells(borders, s, between);
    }
    const Part smoothed = work.take(s.ny, s.nx);
    smooth<VelocityOf<Real>, Real>(s, smoothed, s.stride, between, f);
    if (domain.walls.active) {
        smooth_beside<Real>(s, domain.walls, smoothed, fields.density, f);
    }
    if (work.once(s.border())) {
        mirror_cells(borders, s, f);
    }
    const Part rows = work.take(s.ny, s.nx);
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        for (std::int32_t i = 0; i < s.nx; ++i) {
            const std::int32_t c = s.index(i, j);
            if (!(fields.level[c] > Real(0))) {
                fields.pressure[c] =
                    amount * surface_curvature<Real>(s, domain.walls, f, fields.level, i, j);
            }
        }
    }
    if (work.once(s.border())) {
        extend_cells(borders, s, fields.pressure);
    }
}

template <class Real>
const detail::Tension<Real>& detail::tension() {
    static constexpr Tension<Real> kStage{surface_tension<Real>};
    return kStage;
}

#define WEIR_INSTANTIATE(Real)                                     \
    template const detail::Tension<Real>& detail::tension<Real>(); \
    template void surface_tension(const Domain<Real>&, Real, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
