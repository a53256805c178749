// Stage: collide, late in the step. Reads the contour matrix; corrects particles.
#pragma once

#include "fluid/particles.hpp"
#include "math/lanes.hpp"
#include "solid/contacts.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Particles are gathered and collided by so many at a time, so that where each came from is known
/// at no memory but this. Lanes take a while to set up, and live where a kilobyte of stack is.
/// Packed worlds take several of them at once, as many as scratch has words for.
template <class Real>
inline constexpr std::int32_t kBlock = kHasLanes<Real> ? 512 : (Stored<Real>::coarse ? 16 : 32);

/// Who goes no further along an axis has passed no wall that is not in its cell, cells: less than
/// kPastCorner by more than rounding.
template <class Real>
inline constexpr Real kLongWay = Real(0.625);

/// Where the particles of a block come from.
template <class Real>
struct Flight {
    /// Their places at the beginning of the substep.
    const Vec2<PositionOf<Real>>* before = nullptr;
    bool far = false;           ///< one of them moved further than kLongWay along an axis
    Seconds<Real> dt_s{};       ///< for which bodies moved
    bool mark_removed = false;  ///< who is removed stays, marked, until `Particles::remove_marked`
    /// They are where no picture of the solids is stored: others' ways all lie where one is. Who is
    /// inside there stays inside.
    bool beyond = false;
    const BodyTable<Real>* bodies = nullptr;  ///< whose outlines tell sides of what is thin
};

template <class Real>
struct CollideResult {
    std::int32_t tested = 0;     ///< particles in a cell with a contour line, or inside a solid
    std::int32_t reflected = 0;  ///< particles behind a line, or stopped on their path
    std::int32_t stuck = 0;      ///< particles still inside a solid, on their way out
    std::int32_t removed = 0;    ///< particles that had no way out
    bool covered = false;        ///< a body was put onto one: it was half a cell deep, or a whole
                                 ///< one in what moves, between whose arms some are caught
    bool leapt = false;          ///< one went further than the gather lets any go
    Real max_speed = Real(0);    ///< of those that were answered, along an axis, cells/s
};

/// Tests each particle of a block against the contour line of its cell. One that is behind it is
/// set back to the line, and its velocity is answered by the surface (`reflect`). One that moved
/// further than a cell, or further than half a cell and through a solid, or would be set back to
/// another side than it came from, is swept: it stops where its path, seen from the body, first
/// meets a solid. One that was inside before it moved goes to the nearest place outside, at most
/// one cell a substep, so within kLongestWayOut + 1 substeps; if there is none, or if a moving body
/// presses it against another or the tank, it is removed, and the pool's last particle takes its
/// place. Contour::mid_edge has neither sweep nor way out: what a cell without a gradient holds,
/// stays. Blocks go from the pool's end to its begin, so that who takes a place has been answered.
/// Cost: a table look-up and the length of its way a particle, about 60 operations near walls;
/// those few that are swept 16 inside tests, those few that are stuck a search.
template <class Real>
void collide(const GridShape& shape, const Walls<Real>& walls, const Flight<Real>& flight,
             std::int32_t first, std::int32_t count, Particles<Real>& particles,
             Contacts<Real>& contacts, CollideResult<Real>& result);

/// Whether a point of the tank lies behind the contour.
template <class Real>
bool inside_solid(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> point);

}  // namespace weir
