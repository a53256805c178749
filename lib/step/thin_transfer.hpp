// Both transfers past walls thinner than a cell: a particle gives to and takes from those faces
// only that it sees (the compatibility of Hu et al. 2018). Only particles within a cell of such a
// wall come here.
#pragma once

#include "solid/thin_marks.hpp"
#include "solid/thin_sight.hpp"
#include "solid/walls.hpp"
#include "step/grid_to_particle.hpp"

namespace weir {

/// Whether a thin wall may stand between a particle and a face that it reads.
template <class Real>
inline bool beside_thin_wall(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> x) {
    return (mark_at(thin, s, x) & kTouching) != 0;
}

/// Calls away(part) for particles that follow each other and stand beside no thin wall, and
/// beside(k) for those that do: all of a part, in the pool's order.
template <class Real, class Away, class Beside>
inline void for_each_beside(const Particles<Real>& particles, const Part& part,
                            const ThinWalls<Real>& thin, const GridShape& s, Away away,
                            Beside beside) {
    std::int32_t first = part.first;
    for (std::int32_t begin = part.first; begin < part.end; begin += kBlock<Real>) {
        const MarkedInBlock<Real> marked(thin, s, particles.position + begin,
                                         minimum(kBlock<Real>, part.end - begin));
        for (std::int32_t m = marked.count() - 1; m >= 0; --m) {
            const std::int32_t k = begin + marked[m];
            if (beside_thin_wall(thin, s, Vec2<Real>(particles.position[k]))) {
                if (first < k) {
                    away(Part{first, k});
                }
                beside(k);
                first = k + 1;
            }
        }
    }
    if (first < part.end) {
        away(Part{first, part.end});
    }
}

/// Adds mass and momentum of all particles to the cleared grid; ghost rows are not folded back.
/// @return how often a face took nothing (scatter.hpp).
template <class Real>
std::int32_t scatter_past_walls(const Particles<Real>& particles, const ThinWalls<Real>& thin,
                                Real second_density, StaggeredGrid<Real>& grid);

/// Gathers the particles of a block that stand beside thin walls anew: a face that a particle does
/// not see has the value of the nearest one of its stencil that it sees, and what of that goes to
/// or from the wall holds in proportion to the distance from it, unless its cell is sparse: what
/// flies alone is met by no pressure. Who sees none falls. After `grid_to_particle` of the block.
/// @param fall velocity that gravity gives in the substep.
/// @param before, velocity places and velocities before the block was gathered.
template <class Real>
TransferResult<Real> gather_past_walls(const StaggeredGrid<Real>& grid,
                                       const Transfer<Real>& transfer,
                                       const Walls<Real>& walls, const DensityOf<Real>* density,
                                       Vec2<Real> fall,
                                       const Vec2<PositionOf<Real>>* before,
                                       const Vec2<VelocityOf<Real>>* velocity,
                                       Particles<Real>& block);

/// Closed faces of thin walls, as particles beside them will read them: the liquid's velocity a
/// cell further out on the side of the wall on which the face is, its part along the wall kept,
/// its normal part in proportion to the distance. Relative to the wall's own velocity. Faces whose
/// cell on that side holds no liquid (level > 0) keep what they have. Order: none, only faces that
/// are open are read.
template <class Real>
void mirror_at_thin_walls(const Walls<Real>& walls, const LevelOf<Real>* level,
                          StaggeredGrid<Real>& grid);

}  // namespace weir
