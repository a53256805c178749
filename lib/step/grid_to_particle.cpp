#include "step/grid_to_particle.hpp"

#include "grid/diffuse.hpp"
#include "step/blend_packed.hpp"
#include "step/depth_bits.hpp"
#include "step/face_lanes.hpp"
#include "step/tank_walls.hpp"
#include "step/transfer_fpu.hpp"
#include "step/transfer_lanes.hpp"
#include "step/transfer_packed.hpp"

namespace weir {

namespace {

/// Scatter and gather together smooth like 1 + ∇²/6: each is a hat function of variance 1/6.
template <class Real>
constexpr Real kSmoothing = Real(1.0 / 6.0);

/// Lowest and highest of a face and the four around it.
template <class Real>
struct Range {
    Real low;
    Real high;
};

template <class Real, class Field>
inline Range<Real> range_around(const Field* field, std::int32_t face, std::int32_t stride) {
    const Real left = field[face - 1];
    const Real right = field[face + 1];
    const Real lower = field[face - stride];
    const Real upper = field[face + stride];
    const Real here = field[face];
    return {minimum(here, minimum(minimum(left, right), minimum(lower, upper))),
            maximum(here, maximum(maximum(left, right), maximum(lower, upper)))};
}

/// The same of a value there. Not inline: most are between two of the faces around.
template <class Real>
[[gnu::noinline]] Real clamp_to_range(Real value, const VelocityOf<Real>* field, std::int32_t face,
                                      std::int32_t stride) {
    const Range<Real> range = range_around<Real>(field, face, stride);
    return clamp(value, range.low, range.high);
}

/// field − kSmoothing ∇²field, within what is there: beyond it, a jump such as a wall without slip
/// makes would grow from step to step.
template <class Real>
inline Real sharp(const VelocityOf<Real>* field, std::int32_t face, std::int32_t stride) {
    const Real left = field[face - 1];
    const Real right = field[face + 1];
    const Real lower = field[face - stride];
    const Real upper = field[face + stride];
    const Real here = field[face];
    const Real around = (left + right) + (lower + upper);
    const Real value = here - kSmoothing<Real> * (around - Real(4) * here);
    return have_unlike_signs(value - left, value - right) ||
                   have_unlike_signs(value - lower, value - upper)
               ? value
               : clamp_to_range<Real>(value, field, face, stride);
}

/// One component: out = sharp where liquid is all around.
template <class Real>
struct Sharpening {
    const GridShape& s;
    const ThinWalls<Real>* thin;
    const LevelOf<Real>* level;
    std::int32_t back;  ///< from a face to the one before it across its own cells
    const VelocityOf<Real>* field;
    VelocityOf<Real>* out;

    bool deep(std::int32_t face) const {
        return level[face] > Real(0) && level[face - back] > Real(0);
    }

    /// A face with liquid all around.
    void sharpen(std::int32_t face) const {
        if (thin == nullptr || ((thin->mark[face] | thin->mark[face - back]) & kTouching) == 0) {
            out[face] = sharp<Real>(field, face, s.stride);
        }
    }

    void one(std::int32_t i, std::int32_t j) const {
        const std::int32_t face = s.index(i, j);
        const std::int32_t along = back == 1 ? s.stride : 1;
        // The face before the one on the seam has cells that lie two beyond it: its image has not.
        const bool on_seam = (back == 1 ? i : j) == 0;
        const std::int32_t before =
            face - back + (on_seam ? back * (back == 1 ? s.nx : s.ny) : 0);
        if (deep(face) && deep(before) && deep(face + back) && deep(face - along) &&
            deep(face + along)) {
            sharpen(face);
        }
    }

    /// All of some rows of the arrays, counted from the lowest ghost row; what nothing is done to
    /// is copied on the way.
    void rows_in_lanes(std::int32_t first_i, std::int32_t first_j, const Part& rows) const {
        for (std::int32_t j = rows.first - 1; j < rows.end - 1; ++j) {
            if (j < first_j || j >= s.ny || (back != 1 && j == 0)) {
                copy_rows(s, {j + 1, j + 2}, field, out);
                for (std::int32_t i = first_i; j >= first_j && j < s.ny && i < s.nx; ++i) {
                    one(i, j);
                }
            } else {
                row_in_lanes(first_i, j);
            }
        }
    }

private:
    void copy(std::int32_t face, std::int32_t end) const {
        for (; face < end; ++face) {
            out[face] = field[face];
        }
    }

    void row_in_lanes(std::int32_t first_i, std::int32_t j) const {
        const std::int32_t row = s.index(0, j);
        const Part columns = s.columns(j);
        const Part entries = s.entries(j);
        std::int32_t i = maximum(first_i, columns.first);
        copy(row + entries.first, row + maximum(columns.first, back == 1 ? 1 : 0));
        for (; back == 1 && i < 1; ++i) {
            one(i, j);
        }
        while (i < columns.end) {
            const std::int32_t wall =
                next_marked(thin, s, j - 1, j, maximum(i - 1, 0), columns.end, kTouching);
            if (wall > i) {
                i = sharpen_lanes(level, back, s.stride, kSmoothing<Real>, field, row + i,
                                  row + wall, out) - row;
            }
            // A cell beside a wall has the face before it and the one behind.
            const std::int32_t end = minimum(wall + 2, columns.end);
            copy(row + i, row + end);
            for (; i < end; ++i) {
                one(i, j);
            }
        }
        copy(row + columns.end, row + entries.end);
    }
};

template <class Real>
void sharpen_rows(const Borders<Real>& borders, const Part& rows, const Sharpening<Real>& of_u,
                  const Sharpening<Real>& of_v) {
    const GridShape& s = of_u.s;
    for (std::int32_t j = rows.first; borders.wrap_x && j < rows.end; ++j) {
        of_u.one(0, j);
    }
    for (std::int32_t i = 0; borders.wrap_y && rows.first == 0 && i < s.nx; ++i) {
        of_v.one(i, 0);
    }
    // Of a face's cells both, and those of the faces around.
    const auto deep = [](std::uint32_t before, std::uint32_t own, std::uint32_t behind) {
        return before & own & (own << 1U) & (own >> 1U) & behind;
    };
    const auto left = [](const CellBits& row) { return row.wet & (row.wet << 1U); };
    for_each_depth<Real>(s, of_u.level, rows, [&](const DepthBits<Real>& at) {
        const std::uint32_t u = at.of_u & deep(left(at.below), left(at.here), left(at.above));
        const std::uint32_t v = at.of_v() & deep(at.under.wet & at.below.wet,
                                                 at.below.wet & at.here.wet,
                                                 at.here.wet & at.above.wet);
        for_each_bit(u, at.place, [&](std::int32_t face, std::uint32_t) { of_u.sharpen(face); });
        for_each_bit(v, at.place, [&](std::int32_t face, std::uint32_t) { of_v.sharpen(face); });
    });
}

/// before = (now − before) + pic_ratio · sharp, for both components.
template <class Real>
void blend(const Part& faces, Real pic_ratio, const VelocityOf<Real>* sharp_u,
           const VelocityOf<Real>* sharp_v, StaggeredGrid<Real>& grid) {
    const auto component = [&](const VelocityOf<Real>* now, const VelocityOf<Real>* sharp,
                               VelocityOf<Real>* before) {
        std::int32_t face = faces.first;
        if constexpr (kHasLanes<Real>) {
            face = blend_lanes(now, sharp, pic_ratio, face, faces.end, before);
        }
        if constexpr (kHasFpuLoops<Real>) {
            face += blend_with_fpu(now + face, sharp + face, pic_ratio, faces.end - face,
                                   before + face);
        }
        for (; face < faces.end; ++face) {
            before[face] = (now[face] - before[face]) + pic_ratio * sharp[face];
        }
    };
    component(grid.u, sharp_u, grid.mass_u);
    component(grid.v, sharp_v, grid.mass_v);
}

}  // namespace

template <class Real>
void blend_change(const Borders<Real>& borders, Real flip_ratio, PressureFields<Real>& fields,
                  StaggeredGrid<Real>& grid, const ThinWalls<Real>* thin, Work work) {
    if constexpr (Stored<Real>::coarse) {
        blend_packed(borders, flip_ratio, fields, grid, work);
        return;
    }
    const GridShape& s = grid.shape;
    VelocityOf<Real>* sharp_u = fields.divergence;
    VelocityOf<Real>* sharp_v = fields.inverse_diagonal;
    const Sharpening<Real> of_u{s, thin, fields.level, 1, grid.mass_u, sharp_u};
    const Sharpening<Real> of_v{s, thin, fields.level, s.stride, grid.mass_v, sharp_v};
    if constexpr (kHasLanes<Real>) {
        const std::int32_t cost = 2 * (s.nx + 2);
        work.share(work.take(s.ny + 2, cost), cost, 1, [&](const Part& rows, std::int32_t) {
            of_u.rows_in_lanes(borders.wrap_x ? 0 : 1, 0, rows);
            of_v.rows_in_lanes(0, borders.wrap_y ? 0 : 1, rows);
        });
    } else {
        work.share(work.take(s.ny + 2, s.nx + 2), s.nx + 2, 1,
                   [&](const Part& rows, std::int32_t) {
                       copy_rows(s, rows, grid.mass_u, sharp_u);
                       copy_rows(s, rows, grid.mass_v, sharp_v);
                   });
        work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
            sharpen_rows<Real>(borders, rows, of_u, of_v);
        });
    }
    if (work.once(s.border())) {
        extend_velocity(borders, s, sharp_u, sharp_v);
    }
    work.share(work.take(s.ny + 2, s.nx + 2), s.nx + 2, 1, [&](const Part& rows, std::int32_t) {
        for_each_run(s, rows, [&](const Part& faces) {
            blend<Real>(faces, Real(1) - flip_ratio, sharp_u, sharp_v, grid);
        });
    });
}

namespace {

/// What a particle moves within that meets nothing, as numbers to compare with.
template <class Real>
struct Clear {
    using Magnitude = decltype(magnitude_key(Real()));
    using Bound = decltype(bound_key(Real()));
    Magnitude limit;
    Magnitude near;
    Bound low;
    Bound right;
    Bound top;

    Clear(Vec2<Real> size, const Transfer<Real>& transfer)
        : limit(magnitude_key(transfer.limit)),
          near(magnitude_key(minimum(transfer.near, transfer.limit))),
          low(bound_key(kWallGap<Real>)),
          right(bound_key(size.x - kWallGap<Real>)),
          top(bound_key(size.y - kWallGap<Real>)) {}

    bool moves(Real along_x, Real along_y, Real x, Real y) const {
        return magnitude_key(along_x) <= near && magnitude_key(along_y) <= near &&
               is_between(bound_key(x), low, right) && is_between(bound_key(y), low, top);
    }
};

/// A particle that meets something, or is too fast. Not inline: few do, and the loop over all wants
/// the registers.
template <class Real>
[[gnu::noinline, gnu::cold]] void advect_rare(Vec2<Real> size, const Transfer<Real>& transfer,
                                               Vec2<Real> along, Vec2<Real> v, std::int32_t k,
                                               Particles<Real>& particles,
                                               TransferResult<Real>& result) {
    Vec2<Real> x = particles.position[k];
    advect(size, {transfer, particles.kind_at(k)}, along, x, v, result);
    particles.position[k] = x;
    particles.velocity[k] = v;
}

template <class Real>
TransferResult<Real> gather(const StaggeredGrid<Real>& grid, const Transfer<Real>& transfer,
                            Particles<Real>& particles) {
    const GridShape& s = grid.shape;
    const Vec2<Real> size{static_cast<Real>(s.nx), static_cast<Real>(s.ny)};
    const Clear<Real> clear(size, transfer);
    auto fastest = magnitude_key(Real(0));
    TransferResult<Real> result;
    Vec2<PositionOf<Real>>* position = particles.position;
    Vec2<VelocityOf<Real>>* velocity = particles.velocity;
    const Vec2<PositionOf<Real>>* const end = position + particles.count;
    for (; position != end; ++position, ++velocity) {
        const Vec2<Real> x{position->x, position->y};
        const Stencil<Real> at_u = stencil_u(s, x);
        const Stencil<Real> at_v = stencil_v(s, x);
        // By components: pairs of numbers would go by way of the stack.
        const Real along_x = interpolate(grid.u, s.stride, at_u);
        const Real along_y = interpolate(grid.v, s.stride, at_v);
        const Real change_x = interpolate(grid.mass_u, s.stride, at_u);
        const Real change_y = interpolate(grid.mass_v, s.stride, at_v);
        const Real new_x = transfer.flip_ratio * velocity->x + change_x;
        const Real new_y = transfer.flip_ratio * velocity->y + change_y;
        const Real to_x = x.x + transfer.dt_s * along_x;
        const Real to_y = x.y + transfer.dt_s * along_y;
        const auto speed_x = magnitude_key(new_x);
        const auto speed_y = magnitude_key(new_y);
        auto most = fastest;
        if (speed_x > most || speed_y > most) {  // seldom: a branch costs less than a choice
            most = speed_x > speed_y ? speed_x : speed_y;
        }
        if (most <= clear.limit && clear.moves(along_x, along_y, to_x, to_y)) {
            fastest = most;
            position->x = to_x;
            position->y = to_y;
            velocity->x = new_x;
            velocity->y = new_y;
        } else {
            const auto k = static_cast<std::int32_t>(position - particles.position);
            advect_rare(size, transfer, {along_x, along_y}, {new_x, new_y}, k, particles, result);
        }
    }
    result.max_speed = maximum(result.max_speed, Real(magnitude_of_key(fastest)));
    return result;
}

/// What is slow loses half, so that last digits come to rest: with a sixteenth they go round. What
/// falls is faster.
[[gnu::noinline, gnu::cold]] void settle(const Particles<Fixed>& particles) {
    const auto slower = [](Fixed v) {
        return absolute(v) <= kSettling<Fixed> ? Fixed::of_raw(v.raw / 2) : v;
    };
    for (std::int32_t k = 0; k < particles.count; ++k) {
        Vec2<Fixed>& v = particles.velocity[k];
        v = {slower(v.x), slower(v.y)};
    }
}

#if WEIR_HAS_FPU_LOOPS

TransferResult<float> gather_with_fpu(const StaggeredGrid<float>& grid,
                                      const Transfer<float>& transfer,
                                      Particles<float>& particles) {
    const GridShape& s = grid.shape;
    const Vec2<float> size{static_cast<float>(s.nx), static_cast<float>(s.ny)};
    const Clear<float> clear(size, transfer);
    const fpu::Faces faces(grid);
    const fpu::GatherTask task{transfer.dt_s, transfer.flip_ratio, clear.limit, clear.near,
                               clear.right - clear.low, clear.top - clear.low};
    std::uint32_t fastest = 0;
    TransferResult<float> result;
    const Vec2<float>* const end = particles.position + particles.count;
    for (std::int32_t k = 0; k < particles.count; ++k) {
        fpu::Found found;
        const Vec2<float>* stopped =
            fpu::gather(faces, task, particles.position + k, particles.velocity + k, end, fastest,
                        found);
        k = static_cast<std::int32_t>(stopped - particles.position);
        if (stopped != end) {
            advect_rare(size, transfer, found.along, found.velocity, k, particles, result);
        }
    }
    result.max_speed = maximum(result.max_speed, magnitude_of_key(fastest));
    return result;
}

#endif

}  // namespace

template <class Real>
void prepare_gather(StaggeredGrid<Real>& grid, Work work) {
    if constexpr (kHasLanes<Real>) {
        if (grid.pairs != nullptr) {
            pair_fields(grid, work);
        }
    }
}

template <class Real>
TransferResult<Real> grid_to_particle(const StaggeredGrid<Real>& grid,
                                      const Transfer<Real>& transfer,
                                      Particles<Real>& particles) {
    if constexpr (kHasLanes<Real>) {
        if (grid.pairs != nullptr) {
            return gather_in_lanes(grid, transfer, particles);
        }
    }
    if constexpr (Stored<Real>::coarse) {
        return gather_packed(grid, transfer, particles);
    } else if constexpr (kHasFpuLoops<Real>) {
        return gather_with_fpu(grid, transfer, particles);
    } else {
        const TransferResult<Real> result = gather(grid, transfer, particles);
        if constexpr (kSettles<Real>) {
            if (transfer.settling) {
                settle(particles);
            }
        }
        return result;
    }
}

#define WEIR_INSTANTIATE(Real)                                                      \
    template void blend_change(const Borders<Real>&, Real, PressureFields<Real>&,   \
                               StaggeredGrid<Real>&, const ThinWalls<Real>*, Work); \
    template void prepare_gather(StaggeredGrid<Real>&, Work);                       \
    template TransferResult<Real> grid_to_particle(                                 \
        const StaggeredGrid<Real>&, const Transfer<Real>&, Particles<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
