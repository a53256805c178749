#include "step/mass_matrix.hpp"

#include "solid/face_axis.hpp"
#include "solid/thin_walls.hpp"
#include "step/mass_matrix_lanes.hpp"

namespace weir {

namespace {

/// Σ_p m_p w_i w_j of a face and the next one, those of the diagonals of their stencils included.
/// More than kMost count as so many: ghosts may count them twice along each axis.
using Edge [[gnu::may_alias]] = std::uint16_t;
constexpr std::int32_t kMost = 16383;
/// The same of the two diagonals of four faces, which are alike.
using Diagonal = std::uint8_t;
constexpr std::int32_t kMostAcross = 127;
constexpr MatrixUnits kUnits{1024, 128};
/// A particle that is denser counts as one of that density.
constexpr std::int32_t kDensest = 31;

/// One component's faces. Neighbours of a face: at ±1 and ±stride.
template <class Real>
struct Component {
    const Domain<Real>& domain;
    bool is_u;
    bool to_surface;
    const VelocityOf<Real>* mass;
    Real* momentum;
    const VelocityOf<Real>* other_mass;  ///< of the other component
    const Real* other_momentum;
    Edge* right;             ///< from a face to the next one along x
    Edge* up;                ///< along y
    Diagonal* across;        ///< of it and the next ones along x, along y and along both
    VelocityOf<Real>* flow;  ///< what the iteration has come to
    Real* kept;              ///< room for two rows of it

    const GridShape& shape() const { return domain.grid.shape; }
    FaceAxis<Real> axis() const { return {shape(), domain.walls, is_u}; }
    std::int32_t first_i() const { return is_u && !domain.borders.wrap_x ? 1 : 0; }
    std::int32_t first_j() const { return is_u || domain.borders.wrap_y ? 0 : 1; }

    /// Whether the first and the last face along the component's own axis are one; else: walls.
    bool has_seam() const { return is_u ? domain.borders.wrap_x : domain.borders.wrap_y; }
    /// Faces across that axis; the last ones are n-th.
    Line faces_across(std::int32_t n) const {
        return is_u ? column(shape(), n) : row(shape(), n);
    }
    std::int32_t last_across() const { return is_u ? shape().nx : shape().ny; }

    template <class Count>
    static void give(Count& count, std::int32_t units) {
        constexpr std::int32_t most = sizeof(Count) == sizeof(Edge) ? kMost : kMostAcross;
        count = static_cast<Count>(minimum(count + units, most));
    }

    void scatter(Vec2<Real> x, Real density) const {
        const std::int32_t stride = shape().stride;
        const Stencil<Real> at = is_u ? stencil_u(shape(), x) : stencil_v(shape(), x);
        const Real left = Real(1) - at.fx;
        const Real lower = Real(1) - at.fy;
        const Real both_x = at.fx * left;
        const Real both_y = at.fy * lower;
        const Real along_x = (Real(kUnits.edge) * density) * both_x;
        const Real along_y = (Real(kUnits.edge) * density) * both_y;
        const auto whole = [](Real share) { return static_cast<std::int32_t>(share + Real(0.5)); };
        give(right[at.base], whole(along_x * lower));
        give(right[at.base + stride], whole(along_x * at.fy));
        give(up[at.base], whole(along_y * left));
        give(up[at.base + 1], whole(along_y * at.fx));
        give(across[at.base], whole((Real(kUnits.diagonal) * density) * (both_x * both_y)));
    }

#if WEIR_HAS_LANES
    /// The same of some that are all of the first liquid.
    void scatter_in_lanes(const Vec2<float>* position, std::int32_t count) const {
        const std::int32_t stride = shape().stride;
        const std::int32_t first = is_u ? 1 : stride;
        EdgeShares shares;
        for (std::int32_t k = 0; k < count; k += kMatrixRun) {
            const std::int32_t some = minimum(kMatrixRun, count - k);
            share_edges_in_lanes(is_u, stride, kUnits, &position[k].x, some, shares);
            for (std::int32_t n = 0; n < some; ++n) {
                const auto face = static_cast<std::int32_t>(shares.base[n]) + first;
                give(right[face], shares.near[2 * n]);
                give(right[face + stride], shares.far[2 * n]);
                give(up[face], shares.near[2 * n + 1]);
                give(up[face + 1], shares.far[2 * n + 1]);
                give(across[face], shares.across[2 * n]);
            }
        }
    }
#endif

    /// Ghosts of the edges: walls mirror particles.
    void fold() const {
        const GridShape& s = shape();
        const Borders<Real>& b = domain.borders;
        Line (*const along)(const GridShape&, std::int32_t) = is_u ? row : column;
        Edge* const ahead = is_u ? right : up;  // across the face's cells
        Edge* const aside = is_u ? up : right;
        const bool wrap = is_u ? b.wrap_y : b.wrap_x;
        const std::int32_t last = (is_u ? s.ny : s.nx) - 1;
        const std::int32_t end = last_across();
        move_ghosts(ahead, s, along, last, wrap);
        fold_across(aside, along(s, -1), along(s, last), wrap);
        fold_across(across, along(s, -1), along(s, last), wrap);
        fold_across(aside, faces_across(0), faces_across(end), has_seam());
        if (has_seam()) {
            copy(aside, faces_across(-1), faces_across(end - 1));
            copy(ahead, faces_across(-1), faces_across(end - 1));
            copy(across, faces_across(-1), faces_across(end - 1));
        }
    }

    /// Velocities as scattered.
    void begin(const Part& rows) const {
        for_each_run(shape(), rows, [&](const Part& faces) {
            for (std::int32_t face = faces.first; face < faces.end; ++face) {
                const Real m = mass[face];
                flow[face] = m > Real(0) ? momentum[face] / m : Real(0);
            }
        });
    }

    /// Ghosts of the flow, and what is on walls.
    void extend() const {
        extend_component(domain.borders, shape(), is_u, flow);
        if (!has_seam()) {
            clear(flow, faces_across(0));
            clear(flow, faces_across(last_across()));
        }
    }

    void step_face(MassMatrixStep step, std::int32_t face, const FlowRows<Real>& rows) const {
        const LevelOf<Real>* const level = domain.fields.level;
        const bool here = level[face] > LevelOf<Real>(0);
        const bool before = level[face - axis().before()] > LevelOf<Real>(0);
        const bool deep = here && before;
        if (!(mass[face] > VelocityOf<Real>(0) && (deep || (to_surface && (here || before))) &&
              !is_beside_wall(face))) {
            return;
        }
        const Real more = deep && step != MassMatrixStep::to_middle ? excess(face, rows)
                                                                    : to_middle(face, rows);
        const Real sum = momentum[face] + more;
        if (step == MassMatrixStep::finish) {
            momentum[face] = sum;
        } else {
            flow[face] = sum / mass[face];
        }
    }

private:
    /// From the mean place of a face's particles to its own, by the slope between the faces beside
    /// it, times its mass. What no particle joins to it has no say.
    Real to_middle(std::int32_t face, const FlowRows<Real>& rows) const {
        const auto along = [](Real before, Real here, Real after, Edge behind, Edge ahead) {
            const Real twice = behind > 0 && ahead > 0 ? after - before
                               : ahead > 0             ? (after - here) + (after - here)
                                                       : (here - before) + (here - before);
            return (static_cast<Real>(behind - ahead) * Real(0.5 / kUnits.edge)) * twice;
        };
        return along(rows.here[-1], rows.here[0], rows.here[1], right[face - 1], right[face]) +
               along(rows.below[0], rows.here[0], rows.above[0], up[face - shape().stride],
                     up[face]);
    }

    /// What a face has beyond what its particles interpolate, times its mass.
    Real excess(std::int32_t face, const FlowRows<Real>& rows) const {
        const Real* const below = rows.below;
        const Real* const here = rows.here;
        const Real* const above = rows.above;
        const std::int32_t s = shape().stride;
        const auto x = [&](std::int32_t at) {
            return static_cast<Real>(right[face + at]) * Real(1.0 / kUnits.edge);
        };
        const auto y = [&](std::int32_t at) {
            return static_cast<Real>(up[face + at]) * Real(1.0 / kUnits.edge);
        };
        const auto diagonals = [&](std::int32_t at) {
            return static_cast<Real>(across[face + at]) * Real(1.0 / kUnits.diagonal);
        };
        const Real ahead = here[0] - here[1];
        const Real behind = here[0] - here[-1];
        const Real upper = here[0] - above[0];
        const Real lower = here[0] - below[0];
        const Real edges = (x(0) * ahead + x(-1) * behind) + (y(0) * upper + y(-s) * lower);
        const Real corners =
            (diagonals(0) * ((ahead + upper) - (here[0] - above[1])) +
             diagonals(-1) * ((behind + upper) - (here[0] - above[-1]))) +
            (diagonals(-s) * ((ahead + lower) - (here[0] - below[1])) +
             diagonals(-s - 1) * ((behind + lower) - (here[0] - below[-1])));
        return edges - corners;
    }

    bool is_beside_wall(std::int32_t face) const {
        const Walls<Real>& walls = domain.walls;
        if (!walls.active) {
            return false;
        }
        const std::int32_t before = face - axis().before();
        if (walls.thin != nullptr &&
            ((walls.thin->mark[face] | walls.thin->mark[before]) & kTouching) != 0) {
            return true;
        }
        return !(axis().open()[face] > ShareOf<Real>(0)) ||
               (walls.sticking != nullptr && axis().distance(face) < Real(1) &&
                walls.sticking->body(axis(), face) != kNoBody);
    }
};

template <class Real>
void sum_edges(const Component<Real>& of, const Particles<Real>& particles, Real second_density,
               Work work) {
    const GridShape& s = of.shape();
    const Part rows = work.take(s.ny + 2, s.nx + 2);
    clear_rows(s, rows, of.right);
    clear_rows(s, rows, of.up);
    clear_rows(s, rows, of.across);
    const Part part = work.take(particles.count, 1);
    const Real of_second = minimum(second_density, Real(kDensest));
    bool in_lanes = false;
    if constexpr (kHasLanes<Real>) {
        in_lanes = particles.kind == nullptr;
        if (in_lanes) {
            of.scatter_in_lanes(particles.position + part.first, part.end - part.first);
        }
    }
    for (std::int32_t k = part.first; !in_lanes && k < part.end; ++k) {
        const bool second = particles.kind != nullptr && particles.kind[k] == Liquid::second;
        of.scatter(particles.position[k], second ? of_second : Real(1));
    }
    if (work.once(s.border())) {
        of.fold();
    }
}

/// A step of one row's faces; the flow's rows from the tank's first column on.
template <class Real>
void step_row(const Component<Real>& of, MassMatrixStep step, std::int32_t j,
              const FlowRows<Real>& rows) {
    const GridShape& s = of.shape();
    const std::int32_t row = s.index(0, j);
    std::int32_t i = of.first_i();
    if constexpr (kHasLanes<Real>) {
        if (!of.domain.walls.active) {
            i = mass_matrix_lanes({of.right, of.up, of.across, s.stride, of.axis().before(),
                                   of.domain.fields.level, of.mass, of.momentum, of.flow,
                                   of.to_surface, kUnits},
                                  step, rows.from(i), row + i, row + s.nx) - row;
        }
    }
    for (; i < s.nx; ++i) {
        of.step_face(step, row + i, rows.from(i));
    }
}

/// Replaces the flow row by row; rows that give way are kept for the one above.
template <class Real>
void iterate(const Component<Real>& of, MassMatrixStep step, Work work) {
    const GridShape& s = of.shape();
    const auto kept = [&](std::int32_t j) { return of.kept + (j & 1) * (s.nx + 2) + 1; };
    const auto keep = [&](std::int32_t j) {
        std::memcpy(kept(j) - 1, of.flow + s.index(-1, j),
                    static_cast<std::size_t>(s.nx + 2) * sizeof(Real));
    };
    if (work.once(s.border() + s.nx)) {
        of.extend();
        keep(of.first_j() - 1);
    }
    const Part rows = work.take(s.ny, s.nx);
    for (std::int32_t j = maximum(rows.first, of.first_j()); j < rows.end; ++j) {
        keep(j);
        step_row<Real>(of, step, j, {kept(j - 1), kept(j), of.flow + s.index(0, j + 1)});
    }
}

template <class Real>
void solve(const Component<Real>& of, const Particles<Real>& particles, Real second_density,
           Work work) {
    const GridShape& s = of.shape();
    sum_edges(of, particles, second_density, work);
    of.begin(work.take(s.ny + 2, s.nx + 2));
    const Walls<Real>& walls = of.domain.walls;
    if (walls.active && walls.sticking != nullptr && work.once(s.size())) {
        walls.sticking->centre_flow(of.axis(), of.other_mass, of.other_momentum, of.flow);
    }
    iterate(of, MassMatrixStep::to_middle, work);
    iterate(of, MassMatrixStep::excess, work);
    if (work.once(s.border())) {
        of.extend();
    }
    work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        for (std::int32_t j = maximum(rows.first, of.first_j()); j < rows.end; ++j) {
            const Real* const here = of.flow + s.index(0, j);
            step_row<Real>(of, MassMatrixStep::finish, j,
                           {here - s.stride, here, here + s.stride});
        }
    });
    if (work.once(s.border()) && of.has_seam()) {
        copy(of.momentum, of.faces_across(of.last_across()), of.faces_across(0));
    }
}

template <class Real>
void solve_both(const Domain<Real>& domain, const Particles<Real>& particles,
                Real second_density, bool to_surface, Work work) {
    const StaggeredGrid<Real>& grid = domain.grid;
    const GridShape& s = grid.shape;
    const std::int32_t first = s.index(-1, -1);
    const std::int32_t end = s.index(s.nx, s.ny) + 1;
    Edge* const right = reinterpret_cast<Edge*>(domain.fields.divergence + first) - first;
    Edge* const up = right + (end - first);  // two of them take no more than a number
    // The coarse grid has 7 numbers for 16 cells, and one more on each side.
    Real* const kept = domain.fields.coarse.correction;
    Diagonal* const across = reinterpret_cast<Diagonal*>(kept + 2 * (s.nx + 2)) - first;
    VelocityOf<Real>* const flow = domain.fields.inverse_diagonal;
    const bool mixed = grid.inverse_density_u != nullptr;  // then the mass stands there
    const VelocityOf<Real>* const mass_u = mixed ? grid.inverse_density_u : grid.mass_u;
    const VelocityOf<Real>* const mass_v = mixed ? grid.inverse_density_v : grid.mass_v;
    solve<Real>({domain, true, to_surface, mass_u, grid.momentum_u(), mass_v, grid.momentum_v(),
                 right, up, across, flow, kept},
                particles, second_density, work);
    solve<Real>({domain, false, to_surface, mass_v, grid.momentum_v(), mass_u, grid.momentum_u(),
                 right, up, across, flow, kept},
                particles, second_density, work);
}

}  // namespace

template <class Real>
const detail::MassMatrix<Real>& detail::mass_matrix() {
    static constexpr MassMatrix<Real> kStage{solve_both<Real>};
    return kStage;
}

#define WEIR_INSTANTIATE(Real) \
    template const detail::MassMatrix<Real>& detail::mass_matrix<Real>();
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
