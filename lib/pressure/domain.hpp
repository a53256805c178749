// What the stages between the transfers work on.
#pragma once

#include "pressure/face_weights.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

/// The liquid on its grid, and what bounds it.
template <class Real>
struct Domain {
    StaggeredGrid<Real>& grid;
    PressureFields<Real>& fields;
    const Borders<Real>& borders;
    const Walls<Real>& walls;
    bool sideways = false;  ///< gravity pulls more along rows than across: as deep as they are long

    template <bool Solids, bool Mixed>
    FaceWeights<Solids, Mixed, Real> face_weights() const {
        return {grid, borders, walls};
    }
};

}  // namespace weir
