// The staggered (MAC) grid (Harlow & Welch 1965), in cells: cell (i, j) covers [i, i+1] × [j, j+1].
//
//   u on the left face of a cell, at (i, j + ½);  v on its lower face, at (i + ½, j);
//   pressure, density and level at its centre;  signed distance at its lower left node (i, j).
//
// All arrays share one numbering with a ring of ghost cells, i = −1 … nx, j = −1 … ny.
#pragma once

#include <cstring>

#include "base/array_view.hpp"
#include "base/work.hpp"
#include "math/vec2.hpp"

namespace weir {

#if WEIR_PARALLEL
/// Rows that are worked on together: those of a coarse cell.
inline constexpr std::int32_t kRowsOfSpan = 4;

/// What of a few rows there is any work to do for (step/row_spans.hpp).
struct RowSpan {
    Part columns;  ///< cells
    Part entries;  ///< what is written where no particle may reach, so that it can be read: −1 … nx
    Part liquid;   ///< of the tank's columns, those that hold mass
};
#endif

/// A tank's cells, or a part of them: numbered from the part's lower left corner, stored where they
/// are in the whole.
struct GridShape {
    std::int32_t nx = 0;
    std::int32_t ny = 0;
    std::int32_t stride = 0;  ///< the tank's nx + 2: from a cell to the one above it
    std::int32_t i0 = 0;  ///< of the tank's cells, the one that is (0, 0) here
    std::int32_t j0 = 0;
#if WEIR_PARALLEL
    const RowSpan* spans = nullptr;  ///< of the tank's rows; null: all are worked on end to end

    const RowSpan& span_of(std::int32_t j) const {
        return spans[(j0 + (j < 0 ? 0 : (j < ny ? j : ny - 1))) / kRowsOfSpan];
    }
    /// Columns of a row that stages work on.
    Part columns(std::int32_t j) const {
        return spans != nullptr ? span_of(j).columns : Part{0, nx};
    }
    /// The same with what they look at beside those, ghost cells included.
    Part entries(std::int32_t j) const {
        return spans != nullptr ? span_of(j).entries : Part{-1, nx + 1};
    }
    /// How many rows, from j downwards, have the same columns.
    std::int32_t rows_alike(std::int32_t j) const {
        return (j0 + j) % kRowsOfSpan + 1;
    }
    bool has_spans() const { return spans != nullptr; }
#else
    Part columns(std::int32_t) const { return {0, nx}; }
    Part entries(std::int32_t) const { return {-1, nx + 1}; }
    static constexpr std::int32_t rows_alike(std::int32_t j) { return j + 1; }
    static constexpr bool has_spans() { return false; }
#endif

    std::int32_t size() const { return (nx + 2) * (ny + 2); }
    /// Entries of the lines along all borders: what it costs to fill them.
    std::int32_t border() const { return 2 * (nx + ny + 4); }
    std::int32_t index(std::int32_t i, std::int32_t j) const {
        return (j0 + j + 1) * stride + i0 + i + 1;
    }
};

/// A shape in few bytes, whose rows are as long as it is wide.
struct SmallShape {
    std::int16_t nx = 0;
    std::int16_t ny = 0;
    std::int16_t i0 = 0;
    std::int16_t j0 = 0;

    SmallShape() = default;
    SmallShape(const GridShape& s)  // NOLINT
        : nx(static_cast<std::int16_t>(s.nx)), ny(static_cast<std::int16_t>(s.ny)),
          i0(static_cast<std::int16_t>(s.i0)), j0(static_cast<std::int16_t>(s.j0)) {}
    operator GridShape() const { return {nx, ny, nx + 2, i0, j0}; }  // NOLINT
};

/// Where in the tank the lower left corner of a cell is.
template <class Real>
inline Vec2<Real> corner_of(const GridShape& s, std::int32_t i, std::int32_t j) {
    return {static_cast<Real>(s.i0 + i), static_cast<Real>(s.j0 + j)};
}

/// Entries of some rows, ghost rows counted from the lowest: in one run, but row by row where the
/// grid is narrower than its numbering.
template <class Visit>
inline void for_each_run(const GridShape& s, const Part& rows, Visit visit) {
    if (s.has_spans()) {
        for (std::int32_t j = rows.first - 1; j < rows.end - 1; ++j) {
            const Part entries = s.entries(j);
            if (!entries.empty()) {
                visit(Part{s.index(entries.first, j), s.index(entries.end, j)});
            }
        }
        return;
    }
    const std::int32_t width = minimum(s.nx + 2, s.stride);
    const std::int32_t at_once = width == s.stride ? rows.end - rows.first : 1;
    if (width > 0 && at_once > 0) {
        for (std::int32_t row = rows.first; row < rows.end; row += at_once) {
            const std::int32_t first = s.index(-1, row - 1);
            visit(Part{first, first + (at_once - 1) * s.stride + width});
        }
    }
}

/// Copies some rows of a field.
template <class Field>
inline void copy_rows(const GridShape& s, const Part& rows, const Field* from, Field* to) {
    for_each_run(s, rows, [&](const Part& part) {
        std::memcpy(static_cast<void*>(to + part.first), from + part.first,
                    static_cast<std::size_t>(part.end - part.first) * sizeof(Field));
    });
}

/// Empties them.
template <class Field>
inline void clear_rows(const GridShape& s, const Part& rows, Field* field) {
    for_each_run(s, rows, [&](const Part& part) {
        std::memset(static_cast<void*>(field + part.first), 0,
                    static_cast<std::size_t>(part.end - part.first) * sizeof(Field));
    });
}

/// Whether a part of a huge tank can be stored. Packed worlds are so small that they store it all.
template <class Real>
inline constexpr bool kHasWindow = !Stored<Real>::shares_momentum;

/// `least_head` in packed worlds, in 64ths and in cells.
inline constexpr std::int32_t kHeadRaw = 3;
template <class Real>
inline constexpr Real kPackedHead = Real(kHeadRaw / 64.0);

/// Level of a cell that no particle reaches, cells.
template <class Real>
inline constexpr Real kEmptyLevel =
    Real(Stored<Real>::coarse ? -1.5 - kHeadRaw / 64.0 : -1.55);

/// Whether a number is given up to tell faces that no particle reaches: fixed point has one 0.
/// Packed worlds do not tell them.
template <class Real>
inline constexpr bool kMarksUnreached =
    !std::is_floating_point<Real>::value && !Stored<Real>::coarse;

/// Velocity before the step of a face that no particle reaches: 0, though not the 0 of one where
/// all is at rest, or a last digit.
template <class Real>
inline constexpr Real kNoVelocity = Real(kMarksUnreached<Real> ? 1.0 / 65536.0 : -0.0);

template <class Real>
inline bool is_no_velocity(Real velocity) {
    return WEIR_COMPARE_BYTES(&velocity, &kNoVelocity<Real>, sizeof velocity) == 0;
}

/// What stands for the velocity before the step of a face that particles reach: never what stands
/// for those that none reaches, nor, so that what is mirrored stays so, that turned round.
template <class Real>
inline Real reached_velocity(Real velocity, Real unreached) {
    return kMarksUnreached<Real> && absolute(velocity) == unreached ? Real(0) : velocity;
}

template <class Real>
struct StaggeredGrid {
    GridShape shape;
    VelocityOf<Real>* u = nullptr;       ///< cells/s
    VelocityOf<Real>* v = nullptr;
    VelocityOf<Real>* mass_u = nullptr;  ///< in particles; free for reuse once velocity is known
    VelocityOf<Real>* mass_v = nullptr;
    /// Where u and v will be.
    Real* momentum_u() const { return reinterpret_cast<Real*>(u); }
    Real* momentum_v() const { return reinterpret_cast<Real*>(v); }
    /// With two liquids, where mass_u and mass_v only count: mass, then, once velocity is known,
    /// volume over mass. A particle of the first liquid has mass and volume 1. Null: one liquid.
    VelocityOf<Real>* inverse_density_u = nullptr;
    VelocityOf<Real>* inverse_density_v = nullptr;
    /// Of the whole tank's numbering, the entry that arrays begin with: 0, or that of the window
    /// which is stored. Pointers stand so far before their arrays.
    std::int32_t origin = 0;
#if WEIR_PARALLEL
    /// Whether densities tell of the particles as they are now, but for one substep's way.
    bool knows_rows = false;
    bool whole_rows = true;  ///< the last substep worked on
    RowSpan* row_spans = nullptr;  ///< of the tank's rows; null: whole rows are worked on
    /// Room that is free during the scatter, for loops that threads share. Empty: they do not.
    ArrayView<Real> spans = {};
#endif
    /// A field as room for one and the one behind it, side by side.
    Real* as_pairs(VelocityOf<Real>* field) const { return field - origin; }
    /// Room for two fields, free during both transfers, and a promise that mass_u stands behind u
    /// and mass_v behind v: loops in lanes keep two numbers a face side by side. Null: plain loops.
    Real* pairs = nullptr;
};

/// Nobody knows any more where in their rows particles are.
template <class Real>
inline void forget_rows([[maybe_unused]] StaggeredGrid<Real>& grid) {
#if WEIR_PARALLEL
    grid.knows_rows = false;
    grid.whole_rows = true;
#endif
}

/// The four nodes around a point and its weights: bilinear.
template <class Real>
struct Stencil {
    std::int32_t base;  ///< lower left; the others are at +1, +stride, +stride+1
    Real fx;            ///< 0 … 1, weight of the right hand nodes
    Real fy;            ///< 0 … 1, weight of the upper nodes
};

/// Around a point, on the u faces; 0 ≤ x < nx, 0 ≤ y < ny.
template <class Real>
inline Stencil<Real> stencil_u(const GridShape& shape, Vec2<Real> point) {
    const std::int32_t i = static_cast<std::int32_t>(point.x);
    const Real shifted = point.y + Real(0.5);
    const std::int32_t j = static_cast<std::int32_t>(shifted);
    return {j * shape.stride + i + 1, point.x - static_cast<Real>(i),
            shifted - static_cast<Real>(j)};
}

/// Around a point, on the v faces.
template <class Real>
inline Stencil<Real> stencil_v(const GridShape& shape, Vec2<Real> point) {
    const Real shifted = point.x + Real(0.5);
    const std::int32_t i = static_cast<std::int32_t>(shifted);
    const std::int32_t j = static_cast<std::int32_t>(point.y);
    return {(j + 1) * shape.stride + i, shifted - static_cast<Real>(i),
            point.y - static_cast<Real>(j)};
}

template <class Field, class Real>
inline Real interpolate(const Field* field, std::int32_t stride, const Stencil<Real>& at) {
    const Field* p = field + at.base;
    const Field* upper = whole(p + stride);  // one address for two numbers
    const Real low = p[0] + at.fx * (p[1] - p[0]);
    const Real high = upper[0] + at.fx * (upper[1] - upper[0]);
    return low + at.fy * (high - low);
}

template <class Real>
struct Sample {
    Real value;
    Real slope_x;  ///< per cell
    Real slope_y;
};

/// Bilinear value and its gradient, from the four nodes' numbers.
template <class Real>
inline Sample<Real> bilinear(SameAs<Real> lower_left, SameAs<Real> lower_right,
                             SameAs<Real> upper_left, SameAs<Real> upper_right,
                             const Stencil<Real>& at) {
    const Real low_slope = lower_right - lower_left;
    const Real high_slope = upper_right - upper_left;
    const Real low = lower_left + at.fx * low_slope;
    const Real high = upper_left + at.fx * high_slope;
    const Real slope_y = high - low;
    return {low + at.fy * slope_y, low_slope + at.fy * (high_slope - low_slope), slope_y};
}

template <class Field, class Real>
inline Sample<Real> sample(const Field* field, std::int32_t stride, const Stencil<Real>& at) {
    const Field* p = field + at.base;
    return bilinear(p[0], p[1], p[stride], p[stride + 1], at);
}

}  // namespace weir
