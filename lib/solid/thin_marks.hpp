// Which particles are near thin walls: of a block in lanes, where there are any.
#pragma once

#include "solid/collide.hpp"
#include "solid/near_wall_lanes.hpp"
#include "solid/thin_walls.hpp"

namespace weir {

/// Whether a thin wall can be on a particle's way to `x`: within two cells, or anywhere if the
/// particle or a wall moved further than a cell.
template <class Real>
inline bool near_thin(const GridShape& s, const ThinWalls<Real>& thin, Vec2<Real> x, bool far) {
    return far || thin.reach > Real(1) || (mark_at(thin, s, x) & kNear) != 0;
}

/// Whether no particle of a block, as seen from any wall, can have come further than a cell: then
/// who met a thin wall is within one cell of it.
template <class Real>
inline bool stays_beside(const Flight<Real>& flight, const ThinWalls<Real>& thin) {
    return !flight.beyond && !flight.far && thin.reach <= Real(1) - kPastCorner<Real>;
}

/// Numbers of those particles of a block, of kBlock<Real> at most, that are within two cells of a
/// thin wall, the last one first. Some more may be among them.
template <class Real>
class MarkedInBlock {
public:
    MarkedInBlock(const ThinWalls<Real>& thin, const GridShape& s,
                  const Vec2<PositionOf<Real>>* position, std::int32_t particles) {
        if constexpr (kHasLanes<Real>) {
            if (maximum(s.stride, s.ny) < 0x8000) {
                find_in_lanes(thin.mark, s, position, particles);
                return;
            }
        }
        for (std::int32_t k = particles - 1; k >= 0; --k) {
            n_[count_] = k;
            count_ += mark_at(thin, s, Vec2<Real>(position[k])) != 0 ? 1 : 0;
        }
    }
    std::int32_t count() const { return count_; }
    std::int32_t operator[](std::int32_t k) const { return n_[k]; }

private:
    static constexpr std::int32_t kRoom = kBlock<Real> + 8;

    void find_in_lanes([[maybe_unused]] const std::uint8_t* mark,
                       [[maybe_unused]] const GridShape& s,
                       [[maybe_unused]] const Vec2<PositionOf<Real>>* position,
                       [[maybe_unused]] std::int32_t particles) {
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            std::uint32_t cell[kRoom];
            NearWall near{0, n_, cell};
            find_near_wall({s, mark, position, position, false}, particles, near);
            count_ = near.count;
        }
#endif
    }

    std::int32_t n_[kRoom];
    std::int32_t count_ = 0;
};

}  // namespace weir
