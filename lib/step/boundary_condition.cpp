#include "step/boundary_condition.hpp"

#include "step/mirror.hpp"
#include "step/mirror_lanes.hpp"
#include "step/mirror_packed.hpp"

namespace weir {

namespace {

template <class Real>
Velocity<Real> velocity_before(const Domain<Real>& domain) {
    const StaggeredGrid<Real>& grid = domain.grid;
    return {grid.shape,  grid.mass_u,               grid.mass_v, grid.mass_u,
            grid.mass_v, goes_along(domain.fields), domain.fields.sound_speed > Real(0)};
}
template <class Real>
Velocity<Real> velocity_now(const Domain<Real>& domain) {
    Velocity<Real> velocity = velocity_before(domain);
    velocity.u = domain.grid.u;
    velocity.v = domain.grid.v;
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
                       find_mirror(axis, fields.pressure, fields.fall, i, j, mirror)
                   ? axis.of(was ? before(field, mirror) : mirrored(field, mirror))
                   : own;
    }
}

/// One field after the other.
template <class Real>
void mirror_field(const Domain<Real>& domain, const TwoFields<Real>& both, bool was,
                  const Part& computed, Work work) {
    const Walls<Real>& walls = domain.walls;
    PressureFields<Real>& fields = domain.fields;
    VelocityOf<Real>* const u = was ? domain.grid.mass_u : domain.grid.u;
    VelocityOf<Real>* const v = was ? domain.grid.mass_v : domain.grid.v;
    const GridShape& s = domain.grid.shape;
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
/// So many more rows later faces are computed that wait for others, to fill groups of lanes.
constexpr std::int32_t kRowsWaiting = 6;
/// Faces of rows that are computed and not yet written find room in scratch, by turns: three
/// numbers each, in as many rows. In low tanks fewer wait.
constexpr std::int32_t kTurns = kRowsHeld + 1;
constexpr std::int32_t kMostTurns = kTurns + kRowsWaiting;
constexpr std::int32_t rows_of(std::int32_t turns) {
    return 3 * turns;
}
template <class Real>
constexpr std::int32_t turns_in(const GridShape& s) {
    return kHasLanes<Real> ? clamp(s.ny / rows_of(1), kTurns, kMostTurns) : kTurns;
}

/// One component of both fields, on the same faces.
template <class Real>
struct BothFields {
    FaceAxis<Real> axis;
    VelocityOf<Real>* now;
    VelocityOf<Real>* was;
    VelocityOf<Real>* scratch;
    std::int32_t turns;
    std::int32_t held[kMostTurns] = {};  ///< how many faces of a row

    std::int32_t turn_of(std::int32_t j) const {
        return kHasLanes<Real> ? j % turns : j % kTurns;
    }
    /// Columns of a turn's faces; what they take stands in the two rows behind.
    VelocityOf<Real>* columns(std::int32_t turn) const {
        return scratch + axis.s.index(0, 3 * turn);
    }
    void hold(std::int32_t i, std::int32_t j, Real now_there, Real was_there) {
        const std::int32_t turn = turn_of(j);
        VelocityOf<Real>* there = columns(turn) + held[turn]++;
        there[0] = static_cast<Real>(i);
        there[axis.s.stride] = now_there;
        there[2 * axis.s.stride] = was_there;
    }
    void write(std::int32_t j) {
        const std::int32_t turn = turn_of(j);
        const std::int32_t row = axis.s.index(0, j);
        const std::int32_t up = axis.s.stride;
        const VelocityOf<Real>* there = columns(turn);
        for (std::int32_t left = held[turn]; left > 0; --left, ++there) {
            const std::int32_t face = row + static_cast<std::int32_t>(Real(there[0]));
            now[face] = there[up];
            was[face] = there[2 * up];
        }
        held[turn] = 0;
    }
};

/// Both fields in one look at each face.
template <class Real>
struct BothMirrors {
    const Walls<Real>& walls;
    const PressureFields<Real>& fields;
    Velocity<Real> now;
    Velocity<Real> was;
    Vec2<Real> fall;
    BothFields<Real> u;
    BothFields<Real> v;
#if WEIR_HAS_LANES
    MirrorFaces waiting_u = {};
    MirrorFaces waiting_v = {};
#endif

    void face(BothFields<Real>& of, std::int32_t i, std::int32_t j) {
        if (wants_image(of.axis, fields, of.axis.s.index(i, j))) {
            mirror(of, i, j);
        }
    }
    [[gnu::noinline]] void mirror(BothFields<Real>& of, std::int32_t i, std::int32_t j) {
        Mirror<Real> mirror;
        if (find_mirror(of.axis, fields, fall, i, j, mirror)) {
            of.hold(i, j, of.axis.of(mirrored(now, mirror)), of.axis.of(before(was, mirror)));
        }
    }

#if WEIR_HAS_LANES
    template <bool OnU>
    static void find(const MirrorTask& task, const MirrorFaces& faces, Mirrors& found) {
        if (faces.count > 4) {
            wide_faces()->find_mirrors(task, OnU, faces, found);
        } else {
            find_mirrors<FourLanes, OnU>(task, faces, found);
        }
    }

    /// All that wait.
    template <bool OnU>
    void in_lanes(const MirrorTask& task, MirrorFaces& faces) {
        BothFields<float>& of = OnU ? u : v;
        const std::int32_t count = faces.fill_up();
        Mirrors mirrors;
        find<OnU>(task, faces, mirrors);
        faces.count = 0;
        const std::uint32_t all = (1U << count) - 1U;
        std::uint32_t found = mirrors.wet & all;
        for (std::uint32_t dry = found ^ all; dry != 0; dry &= dry - 1U) {
            const std::int32_t k = WEIR_TRAILING_ZEROS(dry);
            if (look_again(of.axis, faces, mirrors, k)) {
                found |= 1U << static_cast<std::uint32_t>(k);
            }
        }
        if (found == 0) {
            return;
        }
        MirrorChanges changes;
        if (count > 4) {
            wide_faces()->mirror_faces(task, OnU, faces.face, mirrors, changes);
        } else {
            mirror_faces<FourLanes, OnU>(task, faces.face, mirrors, changes);
        }
        for (; found != 0; found &= found - 1U) {
            const std::int32_t k = WEIR_TRAILING_ZEROS(found);
            of.hold(faces.column[k], faces.row[k], changes.now[k], changes.was[k]);
        }
    }

    /// A face whose mirror point lies in no liquid cell: whether one is near it. Else it may mirror
    /// the other side.
    bool look_again(const FaceAxis<float>& axis, const MirrorFaces& faces, const Mirrors& mirrors,
                    std::int32_t k) {
        if (near_liquid(axis.s, fields.level, mirrors.point(k))) {
            return true;
        }
        const std::int32_t there = faces.face[k];
        const std::int32_t i = faces.column[k];
        const std::int32_t j = faces.row[k];
        const Edge<float> edge{axis.centre(i, j), there, there + axis.other_node()};
        Mirror<float> mirror;
        if (from_other_side(axis, edge, mirrors.normal(k), mirror)) {
            face(axis.is_u ? u : v, i, j);
        }
        return false;
    }

    /// `first`: the face of column `from`.
    template <bool OnU>
    void add_all(const MirrorTask& task, std::int32_t first, std::int32_t from,
                 std::uint32_t which, std::int32_t j) {
        MirrorFaces& faces = OnU ? waiting_u : waiting_v;
        for (; which != 0; which &= which - 1U) {
            const std::int32_t k = WEIR_TRAILING_ZEROS(which);
            faces.add(first + k, from + k, j);
            if (faces.count == task.at_once) {
                in_lanes<OnU>(task, faces);
            }
        }
    }

    static FacesToMirror look_at_eight(const MirrorTask& task, std::int32_t first) {
        const WideFaces* wide = wide_faces();
        return wide != nullptr ? wide->faces_to_mirror(task, first)
                               : faces_to_mirror<FourLanes>(task, first);
    }

    MirrorTask mirror_task() const {
        const GridShape& s = now.shape;
        return {s,
                walls.distance,
                fields.level,
                fields.pressure,
                most_slack(fields),
                fall,
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
                walls.thin != nullptr,
                walls.moving != nullptr ? &walls : nullptr};
    }

    /// Eight cells of a row from i on of which some are marked.
    void add_eight(const MirrorTask& task, std::int32_t i, std::uint32_t marked, std::int32_t j) {
        // Some of those before once more, that none is beyond the row.
        const std::int32_t from = minimum(i, task.s.nx - 8);
        const std::int32_t first = task.s.index(from, j);
        FacesToMirror faces = look_at_eight(task, first);
        faces.u &= marked << (i - from);
        faces.v &= marked << (i - from);
        add_all<true>(task, first, from, i > 0 ? faces.u : faces.u & ~1U, j);
        add_all<false>(task, first, from, j > 0 ? faces.v : 0U, j);
    }

    /// Those that have waited for rows enough, or all of them, wait no longer.
    void row_in_lanes(const MirrorTask& task, std::int32_t j) {
        const GridShape& s = now.shape;
        const std::uint32_t* near = first_near(s, walls, j);
        for (std::int32_t k = 0; 32 * k < s.nx; ++k) {
            for (std::uint32_t left = near[k]; left != 0;) {
                const auto lowest = static_cast<std::uint32_t>(WEIR_TRAILING_ZEROS(left));
                const std::uint32_t eight = lowest & ~7U;
                add_eight(task, 32 * k + static_cast<std::int32_t>(eight), left >> eight & 0xFFU,
                          j);
                left &= ~(0xFFU << eight);
            }
        }
        const std::int32_t waited = j + 1 < s.ny ? u.turns - kTurns : 0;
        if (waiting_u.count > 0 && waiting_u.row[0] <= j - waited) {
            in_lanes<true>(task, waiting_u);
        }
        if (waiting_v.count > 0 && waiting_v.row[0] <= j - waited) {
            in_lanes<false>(task, waiting_v);
        }
    }
#endif

    void row(std::int32_t j) {
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

/// What row(j) computes is written as soon as no other row reads what stood there.
template <class Real, class Row>
void mirror_rows(std::int32_t rows, BothMirrors<Real>& mirrors, const Row& row) {
    const std::int32_t held = mirrors.u.turns - 1;
    for (std::int32_t front = 0; front < rows + held; ++front) {
        if (front < rows) {
            row(front);
        }
        if (front >= held) {
            mirrors.u.write(front - held);
            mirrors.v.write(front - held);
        }
    }
}

template <class Real>
void mirror_together(const Domain<Real>& domain, const TwoFields<Real>& both) {
    const Walls<Real>& walls = domain.walls;
    PressureFields<Real>& fields = domain.fields;
    StaggeredGrid<Real>& grid = domain.grid;
    const GridShape& s = grid.shape;
    const std::int32_t turns = turns_in<Real>(s);
    BothMirrors<Real> mirrors{
        walls,
        fields,
        both.now,
        both.was,
        both.fall,
        {{s, walls, true}, grid.u, grid.mass_u, fields.divergence, turns},
        {{s, walls, false}, grid.v, grid.mass_v, fields.inverse_diagonal, turns}};
#if WEIR_HAS_LANES
    if constexpr (kHasLanes<Real>) {
        if (walls.sticking == nullptr && s.nx >= 8) {
            const MirrorTask task = mirrors.mirror_task();
            mirror_rows(s.ny, mirrors, [&](std::int32_t j) { mirrors.row_in_lanes(task, j); });
            return;
        }
    }
#endif
    mirror_rows(s.ny, mirrors, [&](std::int32_t j) { mirrors.row(j); });
}

}  // namespace

template <class Real>
void mirror_in_solids(const Domain<Real>& domain, Vec2<Real> fall, Work work) {
    const GridShape& s = domain.grid.shape;
    const TwoFields<Real> both{velocity_now(domain), velocity_before(domain), domain.fields, fall};
    const bool enough = work.left() >= 4 * static_cast<std::int64_t>(s.ny) * s.nx;
    Part rows = work.take(s.ny, s.nx);
    bool done = false;
    if (enough && rows.first == 0 && rows.end == s.ny && work.pieces(s.ny, s.nx, 1) <= 1) {
        if constexpr (Stored<Real>::coarse) {
            done = packed::BothMirrors(domain, both).mirror();
        } else if (s.ny >= rows_of(kTurns)) {
            mirror_together(domain, both);
            done = true;
        }
    }
    if (done) {
        for (std::int32_t loop = 1; loop < 4; ++loop) {
            work.take(s.ny, s.nx);
        }
        return;
    }
    mirror_field(domain, both, false, rows, work);
    rows = work.take(s.ny, s.nx);
    mirror_field(domain, both, true, rows, work);
}

#define WEIR_INSTANTIATE(Real) \
    template void mirror_in_solids(const Domain<Real>&, Vec2<Real>, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
