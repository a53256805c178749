#include "step/boundary_condition.hpp"

#include "step/mirror.hpp"
#include "step/mirror_lanes.hpp"
#include "step/mirror_packed.hpp"

namespace weir {

namespace {

template <class Real>
Velocity<Real> velocity_before(const StaggeredGrid<Real>& grid,
                               const PressureFields<Real>& fields) {
    return {grid.shape,  grid.mass_u,        grid.mass_v, grid.mass_u,
            grid.mass_v, goes_along(fields), fields.sound_speed > Real(0)};
}
template <class Real>
Velocity<Real> velocity_now(const StaggeredGrid<Real>& grid, const PressureFields<Real>& fields) {
    Velocity<Real> velocity = velocity_before(grid, fields);
    velocity.u = grid.u;
    velocity.v = grid.v;
    return velocity;
}

template <class Real>
VelocityOf<Real> mirror_face(const FaceAxis<Real>& axis, const TwoFields<Real>& fields, bool was,
                             std::int32_t i, std::int32_t j) {
    const std::int32_t face = axis.s.index(i, j);
    const Velocity<Real>& field = was ? fields.was : fields.now;
    const VelocityOf<Real> own = (axis.is_u ? field.u : field.v)[face];
    if constexpr (Stored<Real>::coarse) {
        packed::Image image;
        return !packed::find_image(axis, fields, i, j, image) ? own : was ? image.was : image.now;
    } else {
        Mirror<Real> mirror;
        return wants_image(axis, fields.pressure, face) &&
                       find_mirror(axis, fields.pressure, i, j, mirror)
                   ? axis.of(was ? before(field, mirror) : mirrored(field, mirror))
                   : own;
    }
}

/// One field after the other.
template <class Real>
void mirror_field(const Walls<Real>& walls, const TwoFields<Real>& both, bool was,
                  const Part& computed, Work work, PressureFields<Real>& fields,
                  VelocityOf<Real>* u, VelocityOf<Real>* v) {
    const GridShape& s = both.now.shape;
    const FaceAxis<Real> on_u{s, walls, true};
    const FaceAxis<Real> on_v{s, walls, false};
    // All are computed before the first is written: they read each other.
    work.share(computed, s.nx, 1, [&](const Part& rows, std::int32_t) {
        for_each_near(s, walls, rows, [&](std::int32_t i, std::int32_t j) {
            const std::int32_t c = s.index(i, j);
            fields.divergence[c] = i > 0 ? mirror_face(on_u, both, was, i, j) : u[c];
            fields.inverse_diagonal[c] = j > 0 ? mirror_face(on_v, both, was, i, j) : v[c];
        });
    });
    for_each_near(s, walls, work.take(s.ny, s.nx), [&](std::int32_t i, std::int32_t j) {
        const std::int32_t c = s.index(i, j);
        u[c] = fields.divergence[c];
        v[c] = fields.inverse_diagonal[c];
        fields.inverse_diagonal[c] = Real(0);  // no liquid all around: packed worlds ask
    });
}

/// Rows further apart than this do not read each other: the mirror point of the deepest face is
/// twice kDeepestMirror away, and its stencil begins a cell further on.
constexpr std::int32_t kRowsHeld = 5;
/// Faces of rows that are computed and not yet written find room in scratch, by turns: three
/// numbers each, in as many rows.
constexpr std::int32_t kTurns = kRowsHeld + 1;
constexpr std::int32_t kRowsOfTurns = 3 * kTurns;

/// One component of both fields, on the same faces.
template <class Real>
struct BothFields {
    FaceAxis<Real> axis;
    VelocityOf<Real>* now;
    VelocityOf<Real>* was;
    VelocityOf<Real>* scratch;
    std::int32_t held[kTurns] = {};  ///< how many faces of a row

    VelocityOf<Real>& number(std::int32_t j, std::int32_t which, std::int32_t k) const {
        return scratch[axis.s.index(k, 3 * (j % kTurns) + which)];
    }
    void hold(std::int32_t i, std::int32_t j, Real now_there, Real was_there) {
        const std::int32_t k = held[j % kTurns]++;
        number(j, 0, k) = static_cast<Real>(i);
        number(j, 1, k) = now_there;
        number(j, 2, k) = was_there;
    }
    void write(std::int32_t j) {
        for (std::int32_t k = 0; k < held[j % kTurns]; ++k) {
            const std::int32_t face =
                axis.s.index(static_cast<std::int32_t>(Real(number(j, 0, k))), j);
            now[face] = number(j, 1, k);
            was[face] = number(j, 2, k);
        }
        held[j % kTurns] = 0;
    }
};

/// Both fields in one look at each face.
template <class Real>
struct BothMirrors {
    const Walls<Real>& walls;
    const PressureFields<Real>& fields;
    Velocity<Real> now;
    Velocity<Real> was;
    BothFields<Real> u;
    BothFields<Real> v;

    void face(BothFields<Real>& of, std::int32_t i, std::int32_t j) {
        if (wants_image(of.axis, fields, of.axis.s.index(i, j))) {
            mirror(of, i, j);
        }
    }
    [[gnu::noinline]] void mirror(BothFields<Real>& of, std::int32_t i, std::int32_t j) {
        Mirror<Real> mirror;
        if (find_mirror(of.axis, fields, i, j, mirror)) {
            of.hold(i, j, of.axis.of(mirrored(now, mirror)), of.axis.of(before(was, mirror)));
        }
    }

#if WEIR_HAS_LANES
    template <bool OnU>
    void find(const MirrorTask& task, const MirrorFaces& faces, std::int32_t j,
              Mirrors& found) const {
        if (faces.count > 4) {
            wide_faces()->find_mirrors(task, OnU, faces, j, found);
        } else {
            find_mirrors<FourLanes, OnU>(task, faces, j, found);
        }
        const FaceAxis<float>& axis = OnU ? u.axis : v.axis;
        for (std::int32_t k = 0; walls.moving && k < faces.count; ++k) {
            const std::int32_t face = faces.face[k];
            const Vec2<float> wall = wall_velocity(walls, face, face + axis.other_node(),
                                                   axis.centre(faces.column[k], j));
            found.wall_x[k] = wall.x;
            found.wall_y[k] = wall.y;
        }
    }

    template <bool OnU>
    void in_lanes(const MirrorTask& task, MirrorFaces& faces, std::int32_t j) {
        BothFields<float>& of = OnU ? u : v;
        for (std::int32_t k = faces.count; k < (faces.count > 4 ? 8 : 4); ++k) {
            faces.face[k] = faces.face[0];
            faces.column[k] = faces.column[0];
        }
        Mirrors mirrors;
        find<OnU>(task, faces, j, mirrors);
        std::uint32_t found = mirrors.wet & ((1U << faces.count) - 1U);
        std::uint32_t dry = found ^ ((1U << faces.count) - 1U);
        for (; dry != 0; dry &= dry - 1U) {
            const std::int32_t k = __builtin_ctz(dry);
            if (look_again(of.axis, faces.face[k], faces.column[k], j, mirrors, k)) {
                found |= 1U << static_cast<std::uint32_t>(k);
            }
        }
        if (found == 0) {
            return;
        }
        MirrorChanges changes;
        if (faces.count > 4) {
            wide_faces()->mirror_faces(task, OnU, faces.face, mirrors, changes);
        } else {
            mirror_faces<FourLanes, OnU>(task, faces.face, mirrors, changes);
        }
        for (; found != 0; found &= found - 1U) {
            const std::int32_t k = __builtin_ctz(found);
            of.hold(faces.column[k], j, changes.now[k], changes.was[k]);
        }
    }

    /// A face whose mirror point lies in no liquid cell: whether one is near it. Else it may mirror
    /// the other side.
    bool look_again(const FaceAxis<float>& axis, std::int32_t there, std::int32_t i, std::int32_t j,
                    const Mirrors& mirrors, std::int32_t k) {
        if (near_liquid(axis.s, fields.level, mirrors.point(k))) {
            return true;
        }
        const Edge<float> edge{axis.centre(i, j), there, there + axis.other_node()};
        Mirror<float> mirror;
        if (from_other_side(axis, edge, mirrors.normal(k), mirror)) {
            face(axis.is_u ? u : v, i, j);
        }
        return false;
    }

    template <bool OnU>
    void add(const MirrorTask& task, MirrorFaces& faces, std::int32_t i, std::int32_t j) {
        faces.face[faces.count] = task.s.index(i, j);
        faces.column[faces.count] = i;
        if (++faces.count == task.at_once) {
            in_lanes<OnU>(task, faces, j);
            faces.count = 0;
        }
    }

    template <bool OnU>
    void add_all(const MirrorTask& task, MirrorFaces& faces, std::int32_t from, std::uint32_t which,
                 std::int32_t j) {
        for (; which != 0; which &= which - 1U) {
            add<OnU>(task, faces, from + __builtin_ctz(which), j);
        }
    }

    static FacesToMirror look_at_eight(const MirrorTask& task, std::int32_t first) {
        const WideFaces* wide = wide_faces();
        return wide != nullptr ? wide->faces_to_mirror(task, first)
                               : faces_to_mirror<FourLanes>(task, first);
    }

    void row_in_lanes(std::int32_t j) {
        const GridShape& s = now.shape;
        const MirrorTask task{s,
                              walls.distance,
                              fields.level,
                              now.u,
                              now.v,
                              was.u,
                              was.v,
                              within_tank(s, Vec2<float>{-1.0F, -1.0F}),
                              within_tank(s, Vec2<float>{__builtin_inff(), __builtin_inff()}),
                              was.goes_along,
                              was.all_count,
                              mirrors_at_once(),
                              walls.open_u,
                              walls.open_v,
                              fields.density,
                              walls.thin != nullptr};
        MirrorFaces on_u;
        MirrorFaces on_v;
        const std::uint32_t* near = first_near(s, walls, j);
        for (std::int32_t i = 0; i < s.nx; i += 8) {
            const std::uint32_t marked = near[i / 32] >> (i % 32) & 0xFFU;
            if (marked != 0) {
                // Some of those before once more, that none is beyond the row.
                const std::int32_t from = minimum(i, s.nx - 8);
                FacesToMirror faces = look_at_eight(task, s.index(from, j));
                faces.u &= marked << (i - from);
                faces.v &= marked << (i - from);
                add_all<true>(task, on_u, from, i > 0 ? faces.u : faces.u & ~1U, j);
                add_all<false>(task, on_v, from, j > 0 ? faces.v : 0U, j);
            }
        }
        if (on_u.count > 0) {
            in_lanes<true>(task, on_u, j);
        }
        if (on_v.count > 0) {
            in_lanes<false>(task, on_v, j);
        }
    }
#endif

    void row(std::int32_t j) {
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            if (!walls.sticking && now.shape.nx >= 8) {
                row_in_lanes(j);
                return;
            }
        }
#endif
        for_each_near(now.shape, walls, {j, j + 1}, [&](std::int32_t i, std::int32_t) {
            if (i > 0) {
                face(u, i, j);
            }
            if (j > 0) {
                face(v, i, j);
            }
        });
    }
};

/// What is computed is written as soon as no other row reads what stood there.
template <class Real>
void mirror_together(const Walls<Real>& walls, const TwoFields<Real>& both,
                     PressureFields<Real>& fields, StaggeredGrid<Real>& grid) {
    const GridShape& s = grid.shape;
    BothMirrors<Real> mirrors{
        walls,
        fields,
        both.now,
        both.was,
        {{s, walls, true}, grid.u, grid.mass_u, fields.divergence},
        {{s, walls, false}, grid.v, grid.mass_v, fields.inverse_diagonal}};
    for (std::int32_t front = 0; front < s.ny + kRowsHeld; ++front) {
        if (front < s.ny) {
            mirrors.row(front);
        }
        if (front >= kRowsHeld) {
            mirrors.u.write(front - kRowsHeld);
            mirrors.v.write(front - kRowsHeld);
        }
    }
}

}  // namespace

template <class Real>
void mirror_in_solids(const Walls<Real>& walls, PressureFields<Real>& fields,
                      StaggeredGrid<Real>& grid, Work work) {
    const GridShape& s = grid.shape;
    const TwoFields<Real> both{velocity_now(grid, fields), velocity_before(grid, fields), fields};
    const bool enough = work.left() >= 4 * static_cast<std::int64_t>(s.ny) * s.nx;
    Part rows = work.take(s.ny, s.nx);
    bool done = false;
    if (enough && rows.first == 0 && rows.end == s.ny && work.pieces(s.ny, s.nx, 1) <= 1) {
        if constexpr (Stored<Real>::coarse) {
            done = packed::BothMirrors(walls, both, fields, grid).mirror();
        } else if (s.ny >= kRowsOfTurns) {
            mirror_together(walls, both, fields, grid);
            done = true;
        }
    }
    if (done) {
        for (std::int32_t loop = 1; loop < 4; ++loop) {
            work.take(s.ny, s.nx);
        }
        return;
    }
    mirror_field(walls, both, false, rows, work, fields, grid.u, grid.v);
    rows = work.take(s.ny, s.nx);
    mirror_field(walls, both, true, rows, work, fields, grid.mass_u, grid.mass_v);
}

#define WEIR_INSTANTIATE(Real)                                                \
    template void mirror_in_solids(const Walls<Real>&, PressureFields<Real>&, \
                                   StaggeredGrid<Real>&, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
