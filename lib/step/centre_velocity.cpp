#include "step/centre_velocity.hpp"

#include "solid/face_axis.hpp"
#include "solid/thin_walls.hpp"
#include "step/scatter.hpp"

namespace weir {

namespace {

/// One component's faces, and what particles give them by the flow's slope.
template <class Real>
struct Sloping {
    const Domain<Real>& domain;
    bool is_u;
    Real gained;  ///< from gravity
    VelocityOf<Real>* mass;
    VelocityOf<Real>* momentum;

    const GridShape& shape() const { return domain.grid.shape; }
    VelocityOf<Real>* now() const { return is_u ? domain.grid.u : domain.grid.v; }
    VelocityOf<Real>* before() const { return is_u ? domain.grid.mass_u : domain.grid.mass_v; }

    void scatter_slope(Vec2<Real> x, Real density) const {
        const std::int32_t stride = shape().stride;
        const Stencil<Real> at = is_u ? stencil_u(shape(), x) : stencil_v(shape(), x);
        const Sample<Real> flow = sample(before(), stride, at);
        const Real left = -at.fx * flow.slope_x;
        const Real lower = -at.fy * flow.slope_y;
        const Real right = left + flow.slope_x;
        const Real upper = lower + flow.slope_y;
        const Real both = at.fx * at.fy;
        const auto give = [&](std::int32_t face, Real weight, Real faster) {
            if (has_room(mass[face], momentum[face])) {
                const Real share = weight * density;
                mass[face] += share;
                momentum[face] += share * faster;
            }
        };
        give(at.base, (Real(1) - at.fx) - (at.fy - both), left + lower);
        give(at.base + 1, at.fx - both, right + lower);
        give(at.base + stride, at.fy - both, left + upper);
        give(at.base + stride + 1, both, right + upper);
    }

    /// A wall's image slopes as the liquid does, whatever the wall's own velocity is.
    void fold() const {
        Borders<Real> still = domain.borders;
        still.bottom.conveyor = still.top.conveyor = Real(0);
        still.left.conveyor = still.right.conveyor = Real(0);
        fold_component<true>(still, shape(), is_u, mass, momentum);
    }

    /// Of a face: what was scattered, and what its particles give besides.
    void centre(std::int32_t face, bool again) const {
        const Real all = mass[face];
        if (!(all > Real(0)) || !is_within(face) || is_beside_wall(face)) {
            return;
        }
        Real faster = Real(momentum[face]) / all;
        if (again) {
            const Real scattered = now()[face] - gained;
            faster += faster - (before()[face] - scattered);
            before()[face] = reached_velocity<Real>(scattered + faster, kNoVelocity<Real>);
            now()[face] += faster;
        } else {
            before()[face] += faster;
        }
    }

private:
    FaceAxis<Real> axis() const { return {shape(), domain.walls, is_u}; }

    /// Liquid on both sides.
    bool is_within(std::int32_t face) const {
        const LevelOf<Real>* const level = domain.fields.level;
        return level[face] > LevelOf<Real>(0) && level[face - axis().before()] > LevelOf<Real>(0);
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
void go_over(const Sloping<Real>& faces, const Particles<Real>& particles, Real second_density,
             bool again, Work work) {
    const GridShape& s = faces.shape();
    const Part cleared = work.take(s.ny + 2, s.nx + 2);
    clear_rows(s, cleared, faces.mass);
    clear_rows(s, cleared, faces.momentum);
    const Part part = work.take(particles.count, 1);
    for (std::int32_t k = part.first; k < part.end; ++k) {
        const bool second = particles.kind != nullptr && particles.kind[k] == Liquid::second;
        faces.scatter_slope(particles.position[k], second ? second_density : Real(1));
    }
    if (work.once(s.border())) {
        faces.fold();
    }
    const Part rows = work.take(s.ny, s.nx);
    const Borders<Real>& b = faces.domain.borders;
    const std::int32_t first_i = faces.is_u && !b.wrap_x ? 1 : 0;
    const std::int32_t first_j = faces.is_u || b.wrap_y ? 0 : 1;
    for (std::int32_t j = maximum(rows.first, first_j); j < rows.end; ++j) {
        const Part columns = s.columns(j);
        for (std::int32_t i = maximum(columns.first, first_i); i < columns.end; ++i) {
            faces.centre(s.index(i, j), again);
        }
    }
}

}  // namespace

template <class Real>
void centre_velocity(const Domain<Real>& domain, const Particles<Real>& particles,
                     Real second_density, Vec2<Real> fall, bool again, Work work) {
    VelocityOf<Real>* const mass = domain.fields.divergence;
    VelocityOf<Real>* const momentum = domain.fields.inverse_diagonal;
    go_over<Real>({domain, true, fall.x, mass, momentum}, particles, second_density, again, work);
    go_over<Real>({domain, false, fall.y, mass, momentum}, particles, second_density, again, work);
}

#define WEIR_INSTANTIATE(Real)                                                        \
    template void centre_velocity(const Domain<Real>&, const Particles<Real>&, Real, \
                                  Vec2<Real>, bool, Work);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
