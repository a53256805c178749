// The particle pool: positions in cells, velocities in cells per second.
#pragma once

#include "grid/staggered_grid.hpp"
#include "weir/config.hpp"

namespace weir {

template <class Real>
struct Particles {
    Vec2<PositionOf<Real>>* position = nullptr;
    Vec2<VelocityOf<Real>>* velocity = nullptr;
    std::int32_t count = 0;
    std::int32_t capacity = 0;
    Liquid* kind = nullptr;  ///< null: there is one liquid

    bool full() const { return count == capacity; }
    /// A part of the pool, to be changed in place.
    Particles part(std::int32_t first, std::int32_t size) const {
        return {position + first, velocity + first, size, size,
                kind != nullptr ? kind + first : nullptr};
    }
    const Liquid* kind_at(std::int32_t k) const { return kind != nullptr ? kind + k : nullptr; }
    void add(Vec2<Real> at, Vec2<Real> moving, Liquid of) {
        position[count] = at;
        velocity[count] = moving;
        if (kind != nullptr) {
            kind[count] = of;
        }
        ++count;
    }
    /// The last particle takes the removed one's place.
    void remove(std::int32_t index) {
        --count;
        position[index] = position[count];
        velocity[index] = velocity[count];
        if (kind != nullptr) {
            kind[index] = kind[count];
        }
    }
    /// Marks a particle as one to be removed: no tank has such a place. Not for packed places.
    void mark(std::int32_t index) { position[index].x = PositionOf<Real>(Real(-1)); }
    /// Removes the marked ones, so many, as if it had been done one by one from the pool's end.
    void remove_marked(std::int32_t marked) {
        for (std::int32_t k = count - 1; marked > 0; --k) {
            if (position[k].x < PositionOf<Real>(Real(0))) {
                remove(k);
                --marked;
            }
        }
    }
};

/// Particles stay this far inside the tank, cells: every stencil then lies within the arrays.
template <class Real>
inline constexpr Real kWallGap = Real(1.0 / 64.0);

template <class Real>
inline bool in_tank(const GridShape& s, Vec2<Real> x) {
    return Real(0) <= x.x && x.x < static_cast<Real>(s.nx) && Real(0) <= x.y &&
           x.y < static_cast<Real>(s.ny);
}

/// The nearest point that a particle may have.
template <class Real>
inline Vec2<Real> within_tank(const GridShape& s, Vec2<Real> x) {
    return {clamp(x.x, kWallGap<Real>, static_cast<Real>(s.nx) - kWallGap<Real>),
            clamp(x.y, kWallGap<Real>, static_cast<Real>(s.ny) - kWallGap<Real>)};
}

}  // namespace weir
