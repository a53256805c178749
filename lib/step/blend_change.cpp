#include "step/blend_change.hpp"

#include "pressure/projection.hpp"
#include "step/blend_packed.hpp"
#include "step/depth_bits.hpp"
#include "step/face_lanes.hpp"
#include "step/transfer_fpu.hpp"

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
inline Range<Real> range_around(const Field* face, std::int32_t stride) {
    const Real left = face[-1];
    const Real right = face[1];
    const Real lower = *(face - stride);
    const Real upper = face[stride];
    const Real here = *face;
    return {minimum(here, minimum(minimum(left, right), minimum(lower, upper))),
            maximum(here, maximum(maximum(left, right), maximum(lower, upper)))};
}

/// The same of a value there. Not inline: most are between two of the faces around.
template <class Real>
[[gnu::noinline]] Real clamp_to_range(Real value, const VelocityOf<Real>* face,
                                      std::int32_t stride) {
    const Range<Real> range = range_around<Real>(face, stride);
    return clamp(value, range.low, range.high);
}

/// field − kSmoothing ∇²field, within what is there: beyond it, a jump such as a wall without slip
/// makes would grow from step to step.
template <class Real>
inline Real sharp(const VelocityOf<Real>* face, std::int32_t stride) {
    const Real left = face[-1];
    const Real right = face[1];
    const Real lower = *(face - stride);
    const Real upper = face[stride];
    const Real here = *face;
    const Real around = (left + right) + (lower + upper);
    const Real value = here - kSmoothing<Real> * (around - Real(4) * here);
    return have_unlike_signs(value - left, value - right) ||
                   have_unlike_signs(value - lower, value - upper)
               ? value
               : clamp_to_range<Real>(value, face, stride);
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
    void sharpen(std::int32_t face, std::int32_t stride) const {
        if (thin == nullptr || ((thin->mark[face] | thin->mark[face - back]) & kTouching) == 0) {
            out[face] = sharp<Real>(whole(field + face), stride);
        }
    }

    /// Such faces of a row. Not inline: it wants all registers.
    [[gnu::noinline]] void sharpen_bits(std::uint32_t faces, std::int32_t place) const {
        const Sharpening all = *this;  // what a call cannot change
        const std::int32_t stride = s.stride;
        for_each_bit(faces, place, [&](std::int32_t face, std::uint32_t) {
            all.sharpen(face, stride);
        });
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
            sharpen(face, s.stride);
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
        of_u.sharpen_bits(u, at.place);
        of_v.sharpen_bits(v, at.place);
    });
}

/// Both components where liquid is all around; plain loops leave other faces as they were copied.
template <class Real>
void sharpen(const Domain<Real>& domain, VelocityOf<Real>* sharp_u, VelocityOf<Real>* sharp_v,
             Work work) {
    const Borders<Real>& borders = domain.borders;
    const ThinWalls<Real>* thin = domain.walls.thin;
    const LevelOf<Real>* level = domain.fields.level;
    StaggeredGrid<Real>& grid = domain.grid;
    const GridShape& s = grid.shape;
    const Sharpening<Real> of_u{s, thin, level, 1, grid.mass_u, sharp_u};
    const Sharpening<Real> of_v{s, thin, level, s.stride, grid.mass_v, sharp_v};
    if constexpr (kHasLanes<Real>) {
        const std::int32_t cost = 2 * (s.nx + 2);
        work.share(work.take(s.ny + 2, cost), cost, 1, [&](const Part& rows, std::int32_t) {
            of_u.rows_in_lanes(borders.wrap_x ? 0 : 1, 0, rows);
            of_v.rows_in_lanes(0, borders.wrap_y ? 0 : 1, rows);
        });
    } else {
        work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
            sharpen_rows<Real>(borders, rows, of_u, of_v);
        });
    }
    const detail::SecondLiquid<Real>* const second = domain.fields.second_liquid;
    if (second != nullptr) {
        second->sharpen_between(domain, kSmoothing<Real>, sharp_u, sharp_v, work);
    }
    if (work.once(s.border())) {
        extend_velocity(borders, s, sharp_u, sharp_v);
    }
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
void blend_change(const Domain<Real>& domain, Real flip_ratio, bool unsmoothed, Work work) {
    if constexpr (Stored<Real>::coarse) {
        blend_packed(domain, flip_ratio, work);
        return;
    }
    PressureFields<Real>& fields = domain.fields;
    StaggeredGrid<Real>& grid = domain.grid;
    const GridShape& s = grid.shape;
    VelocityOf<Real>* sharp_u = fields.divergence;
    VelocityOf<Real>* sharp_v = fields.inverse_diagonal;
    if (unsmoothed || !kHasLanes<Real>) {  // lanes copy on the way
        work.share(work.take(s.ny + 2, s.nx + 2), s.nx + 2, 1,
                   [&](const Part& rows, std::int32_t) {
                       copy_rows(s, rows, grid.mass_u, sharp_u);
                       copy_rows(s, rows, grid.mass_v, sharp_v);
                   });
    }
    if (!unsmoothed) {
        sharpen(domain, sharp_u, sharp_v, work);
    }
    work.share(work.take(s.ny + 2, s.nx + 2), s.nx + 2, 1, [&](const Part& rows, std::int32_t) {
        for_each_run(s, rows, [&](const Part& faces) {
            blend<Real>(faces, Real(1) - flip_ratio, sharp_u, sharp_v, grid);
        });
    });
}

#define WEIR_INSTANTIATE(Real) \
    template void blend_change(const Domain<Real>&, Real, bool, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
