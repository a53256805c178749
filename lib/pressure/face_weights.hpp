// What a pressure difference of 1 across a face moves through it: open share × 1/density.
#pragma once

#include "grid/borders.hpp"
#include "solid/walls.hpp"

namespace weir {

/// One number for each face of a cell.
template <class Real>
struct Faces {
    Real left;
    Real right;
    Real lower;
    Real upper;
};

/// Solids, Mixed: whether there are bodies and two liquids; what is absent is compiled away.
template <bool Solids, bool Mixed, class Real>
struct FaceWeights {
    const StaggeredGrid<Real>& grid;
    const Borders<Real>& borders;
    const Walls<Real>& walls;

    Real open_u(std::int32_t face) const { return Solids ? Real(walls.open_u[face]) : Real(1); }
    Real open_v(std::int32_t face) const { return Solids ? Real(walls.open_v[face]) : Real(1); }
    Real light_u(std::int32_t face) const {
        return Mixed ? Real(grid.inverse_density_u[face]) : Real(1);
    }
    Real light_v(std::int32_t face) const {
        return Mixed ? Real(grid.inverse_density_v[face]) : Real(1);
    }
    Real u(std::int32_t face) const {
        return Solids && Mixed ? open_u(face) * light_u(face)
                               : (Solids ? open_u(face) : light_u(face));
    }
    Real v(std::int32_t face) const {
        return Solids && Mixed ? open_v(face) * light_v(face)
                               : (Solids ? open_v(face) : light_v(face));
    }

    // A tank with room for solids has no seams.
    bool wraps_x() const { return !Solids && borders.wrap_x; }
    bool wraps_y() const { return !Solids && borders.wrap_y; }
    bool has_left(std::int32_t i) const { return i > 0 || wraps_x(); }
    bool has_right(std::int32_t i) const { return i + 1 < grid.shape.nx || wraps_x(); }
    bool has_lower(std::int32_t j) const { return j > 0 || wraps_y(); }
    bool has_upper(std::int32_t j) const { return j + 1 < grid.shape.ny || wraps_y(); }

    /// What flows out of a cell through the open parts of its faces, cells/s. Through those on the
    /// tank's walls that is 0 but where liquid parts from them: as if the wall went along.
    Real outflow(std::int32_t i, std::int32_t j) const {
        const std::int32_t c = grid.shape.index(i, j);
        const std::int32_t up = c + grid.shape.stride;
        return (open_u(c + 1) * grid.u[c + 1] - open_u(c) * grid.u[c]) +
               (open_v(up) * grid.v[up] - open_v(c) * grid.v[c]);
    }

    /// Sum over the four neighbours of a liquid cell, each with its face. Beyond the tank and in
    /// air the pressure is 0: only the diagonal tells them apart. The inverse diagonal is negative
    /// where a wall touches the cell; elsewhere no weight is read.
    Real weighted(const Real* p, std::int32_t c, Real inverse) const {
        const std::int32_t up = grid.shape.stride;
        return Mixed || (Solids && inverse < Real(0))
                   ? (u(c) * p[-1] + u(c + 1) * p[1]) + (v(c) * p[-up] + v(c + up) * p[up])
                   : (p[-1] + p[1]) + (p[-up] + p[up]);
    }

    /// Of all four faces of a cell; 0 on the tank's walls.
    Faces<Real> around(std::int32_t i, std::int32_t j) const {
        const std::int32_t c = grid.shape.index(i, j);
        return {has_left(i) ? u(c) : Real(0), has_right(i) ? u(c + 1) : Real(0),
                has_lower(j) ? v(c) : Real(0),
                has_upper(j) ? v(c + grid.shape.stride) : Real(0)};
    }
};

/// Of faces that are all open.
template <class Real>
using OpenWeights = FaceWeights<false, false, Real>;

}  // namespace weir
