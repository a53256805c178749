#include "grid/common_flow.hpp"

#include <type_traits>

namespace weir {

namespace {

/// A sum of velocities.
template <class Real>
struct Flow {
    static constexpr bool kWhole = !std::is_floating_point<Real>::value;
    std::conditional_t<kWhole, std::int64_t, Real> sum{};
    std::int32_t faces = 0;

    void add(Real velocity) {
        if constexpr (kWhole) {
            sum += velocity.raw;
        } else {
            sum += velocity;
        }
        ++faces;
    }
    void add(const Flow& other) {
        sum += other.sum;
        faces += other.faces;
    }
    Real mean() const {
        if (faces == 0) {
            return Real(0);
        }
        if constexpr (kWhole) {
            const auto size = static_cast<std::uint64_t>(sum < 0 ? -sum : sum);
            const auto one = static_cast<std::int32_t>(
                fixed::divide(size, static_cast<std::uint32_t>(faces)));
            return Real::of_raw(sum < 0 ? -one : one);
        } else {
            return sum / static_cast<Real>(faces);
        }
    }
};

/// All of a component's faces, ghosts and all.
template <class Visit>
void for_each_face(const GridShape& s, Visit visit) {
    for (std::int32_t j = -1; j <= s.ny; ++j) {
        for (std::int32_t face = s.index(-1, j); face <= s.index(s.nx, j); ++face) {
            visit(face);
        }
    }
}

/// Whether a field stays within what a packed velocity bears.
template <class Real>
bool bears(VelocityOf<Real> flow, const GridShape& s, const VelocityOf<Real>* field) {
    const Real most = Real(kMaxSpeedSmallFixed) - absolute(Real(flow));
    bool all = true;
    for_each_face(s, [&](std::int32_t face) { all = all && absolute(Real(field[face])) <= most; });
    return all;
}

template <class Real>
void shift(Real by, const GridShape& s, VelocityOf<Real>* field) {
    for_each_face(s, [&](std::int32_t face) { field[face] = Real(field[face]) + by; });
}

/// Of one component, amid liquid; `back`: from a face to the cell before it.
template <class Real>
VelocityOf<Real> mean_of(const GridShape& s, std::int32_t back, const LevelOf<Real>* level,
                         const VelocityOf<Real>* field) {
    Flow<Real> all;
    for (std::int32_t j = 0; j < s.ny; ++j) {
        Flow<Real> of_row;  // by rows: a sum of millions of floats would round
        for (std::int32_t face = s.index(0, j); face < s.index(s.nx, j); ++face) {
            if (level[face] > Real(0) && level[face - back] > Real(0)) {
                of_row.add(field[face]);
            }
        }
        all.add(of_row);
    }
    return VelocityOf<Real>(all.mean());
}

/// Calls visit(velocity, gain, back, part of `flow`, part of `gain`) for the periodic components,
/// once in a walk.
template <class Real, class Visit>
void for_each_periodic(const Borders<Real>& b, StaggeredGrid<Real>& grid, Work work,
                       Visit visit) {
    if ((!b.wrap_x && !b.wrap_y) || !work.once(3 * grid.shape.size())) {
        return;
    }
    CommonFlow<Real>& common = grid.common;
    if (b.wrap_x) {
        visit(grid.u, grid.mass_u, 1, common.flow.x, common.gain.x);
    }
    if (b.wrap_y) {
        visit(grid.v, grid.mass_v, grid.shape.stride, common.flow.y, common.gain.y);
    }
}

}  // namespace

template <class Real>
void leave_common_flow(const Borders<Real>& b, const LevelOf<Real>* level,
                       StaggeredGrid<Real>& grid, Work work) {
    using Speed = VelocityOf<Real>;
    const GridShape& s = grid.shape;
    for_each_periodic(b, grid, work, [&](Speed* velocity, const Speed* gain, std::int32_t back,
                                         Speed& own, Speed& gained) {
        own = mean_of<Real>(s, back, level, velocity);
        if (Stored<Real>::coarse && !bears<Real>(own, s, velocity)) {
            own = Speed{};
        }
        shift<Real>(Real(0) - Real(own), s, velocity);
        gained = mean_of<Real>(s, back, level, gain);
    });
}

template <class Real>
void join_common_flow(const Borders<Real>& b, const LevelOf<Real>* level,
                      StaggeredGrid<Real>& grid, Work work) {
    using Speed = VelocityOf<Real>;
    const GridShape& s = grid.shape;
    for_each_periodic(b, grid, work, [&](Speed* velocity, Speed* gain, std::int32_t back,
                                         const Speed& own, const Speed& gained) {
        shift<Real>(own, s, velocity);
        shift<Real>(Real(gained) - Real(mean_of<Real>(s, back, level, gain)), s, gain);
    });
}

#define WEIR_INSTANTIATE(Real)                                                     \
    template void leave_common_flow(const Borders<Real>&, const LevelOf<Real>*,    \
                                    StaggeredGrid<Real>&, Work);                   \
    template void join_common_flow(const Borders<Real>&, const LevelOf<Real>*,     \
                                   StaggeredGrid<Real>&, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
