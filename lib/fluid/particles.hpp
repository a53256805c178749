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
    std::uint8_t* tag = nullptr;  ///< the caller's; null: there are none

    bool full() const { return count == capacity; }
    /// A part of the pool, to be changed in place.
    Particles part(std::int32_t first, std::int32_t size) const {
        Particles some = *this;
        some.begin_later(first);
        some.count = some.capacity = size;
        return some;
    }
    /// The pool as it is without its first ones.
    void begin_later(std::int32_t by) {
        position += by;
        velocity += by;
        kind = kind != nullptr ? kind + by : nullptr;
        tag = tag != nullptr ? tag + by : nullptr;
        count -= by;
    }
    const Liquid* kind_at(std::int32_t k) const { return kind != nullptr ? kind + k : nullptr; }
    void add(Vec2<Real> at, Vec2<Real> moving, Liquid of) {
        position[count] = at;
        velocity[count] = moving;
        if (kind != nullptr) {
            kind[count] = of;
        }
        if (tag != nullptr) {
            tag[count] = 0;
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
        if (tag != nullptr) {
            tag[index] = tag[count];
        }
    }
    void swap(std::int32_t a, std::int32_t b) {
        swap_in(position, a, b);
        swap_in(velocity, a, b);
        if (kind != nullptr) {
            swap_in(kind, a, b);
        }
        if (tag != nullptr) {
            swap_in(tag, a, b);
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

private:
    template <class Field>
    static void swap_in(Field* field, std::int32_t a, std::int32_t b) {
        const Field kept = field[a];
        field[a] = field[b];
        field[b] = kept;
    }
};

/// Between what places particles are, along either axis. SmallFixed asks for the high ones alone:
/// its tanks are so small that what lies below and on the left is not worth a look.
template <class Real>
struct Extent {
    Vec2<PositionOf<Real>> low;
    Vec2<PositionOf<Real>> high;

    /// That of one particle, or of none.
    static Extent of_first(const Particles<Real>& particles) {
        const Vec2<PositionOf<Real>>* first = particles.position;
        return particles.count > 0 ? Extent{*first, *first} : Extent{};
    }
    void add(const Extent& other) {
        low = {minimum(low.x, other.low.x), minimum(low.y, other.low.y)};
        high = {maximum(high.x, other.high.x), maximum(high.y, other.high.y)};
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
    const Vec2<Real> low = corner_of<Real>(s, 0, 0);
    const Vec2<Real> high = corner_of<Real>(s, s.nx, s.ny);
    return {clamp(x.x, low.x + kWallGap<Real>, high.x - kWallGap<Real>),
            clamp(x.y, low.y + kWallGap<Real>, high.y - kWallGap<Real>)};
}

}  // namespace weir
