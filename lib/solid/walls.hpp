// What solids leave open, as the liquid sees them: the contour of all bodies merged.
#pragma once

#include "grid/staggered_grid.hpp"
#include "math/lanes.hpp"
#include "solid/body_load.hpp"
#include "solid/thin_walls.hpp"

namespace weir {

inline constexpr std::uint16_t kNoBody = 0xFFFF;

/// Nodes further out than this know no wall, cells. (kFarFromSolids of the public face.) Contour
/// lines need nodes up to one cell out, gradients in the solid's first cell a little more.
template <class Real>
inline constexpr Real kBand = Real(1.5);

/// Faces in solids deeper than this are never read, cells: a particle stands in front of the wall,
/// and its stencil reaches one cell along each axis.
template <class Real>
inline constexpr Real kDeepestMirror = Real(-1.5);

/// What goes into a wall less steeply than this to what it does along it goes along it, too: a
/// bent wall's faces know it where the wall has another direction.
template <class Real>
inline constexpr Real kAlongBend = Real(0.5);

/// A film on a wall has air where it is mirrored from. Where faces that particles reach have less
/// than this of the weight there, they count alone: the others, at rest, braked it to a third.
/// Were it so everywhere, what leans on a wall would be stirred.
inline constexpr float kFilmWeight = 0.75F;
inline constexpr float kLeastFilmWeight = 1.0F / 64.0F;

/// Where the liquid sticks, faces nearer to the wall than this are interpolated between the wall
/// and the liquid a cell out: the pressure came after viscosity had bound them to the wall.
template <class Real>
inline constexpr Real kBoundLayer = Real(0.5);

template <class Real>
class PictureBeyond;
template <class Real>
struct MovingWalls;
template <class Real>
struct StickingWalls;

/// What is stored of the tank: all of it, or a part (step/window.hpp). Elsewhere the picture of the
/// solids is drawn for whoever asks (solid/picture_beyond.hpp).
template <class Real, bool Has = kHasWindow<Real>>
struct StoredPart {
    SmallShape at;
    const BodyTable<Real>* bodies = nullptr;  ///< null: all of the tank is stored
    PictureBeyond<Real>* picture = nullptr;   ///< if not null: of the one who asks
};
template <class Real>
struct StoredPart<Real, false> {};

/// Arrays share the grid's numbering. `active` false: no body exists and none of them is read.
template <class Real>
struct Walls {
    bool active = false;  ///< there are bodies; within a substep: and one is near the liquid
    bool binary = false;                ///< Contour::mid_edge
    bool any_sticking = false;          ///< to a body without slip, if the liquid is viscous
    /// Null: the liquid is not viscous, or no body without slip.
    const StickingWalls<Real>* sticking = nullptr;
    const MovingWalls<Real>* moving = nullptr;  ///< null: no body has a velocity or a spin
    DistanceOf<Real>* distance = nullptr;  ///< signed distance at nodes, cells, negative inside
    SlotOf<Real>* nearest = nullptr;   ///< slot of the nearest body at nodes (`nearest_at`)
    std::uint8_t* cell_case = nullptr;  ///< marching squares case of the cell
    ShareOf<Real>* open_u = nullptr;    ///< open fraction of the u face, 0 … 1
    ShareOf<Real>* open_v = nullptr;
    ShareOf<Real>* full_density = nullptr;  ///< density of a cell when all around it is full
    std::uint32_t* near = nullptr;  ///< a bit a cell: its left or lower face is to be mirrored
    const Body<Real>* body = nullptr;
    ThinWallsPointer<Real> thin = {};   ///< null: none, or none near the liquid
    BodyLoad<Real>* load = nullptr;     ///< what bodies receive; null: nobody wants to know
    Face<Real> particle_mass[2] = {};   ///< of either liquid, over the first's density, cells²
    StoredPart<Real> stored = {};
};

/// The part of the tank that arrays hold.
template <class Real>
inline GridShape stored_part([[maybe_unused]] const Walls<Real>& walls, const GridShape& tank) {
    if constexpr (kHasWindow<Real>) {
        return walls.stored.at;
    } else {
        return tank;
    }
}

/// Whether what a particle asks of a cell's contour is stored: its nodes, and those next to them.
template <class Real>
inline bool is_stored([[maybe_unused]] const Walls<Real>& walls,
                      [[maybe_unused]] const GridShape& tank, [[maybe_unused]] std::int32_t i,
                      [[maybe_unused]] std::int32_t j) {
    if constexpr (kHasWindow<Real>) {
        if (walls.stored.bodies == nullptr) {
            return true;
        }
        const GridShape part = walls.stored.at;
        const auto within = [](std::int32_t cell, std::int32_t first, std::int32_t cells,
                               std::int32_t all) {
            return cell >= (first == 0 ? 0 : first + 1) &&
                   cell < first + cells - (first + cells == all ? 0 : 1);
        };
        return within(i, part.i0, part.nx, tank.nx) && within(j, part.j0, part.ny, tank.ny);
    } else {
        return true;
    }
}

/// Words of `near` for one row of the tank's cells, of which a shape may be a part.
inline std::int32_t near_words(const GridShape& shape) {
    return (shape.stride - 2 + 31) / 32;
}

/// Of a part that is stored, the word that stands first.
inline std::int32_t first_near_word(const GridShape& part) {
    return part.j0 * near_words(part) + part.i0 / 32;
}

/// Marks cells of a row in `near`, or not, one after the other from column i on.
class MarksNear {
public:
    template <class Real>
    MarksNear(Walls<Real>& walls, const GridShape& shape, std::int32_t i, std::int32_t j)
        : word_(walls.near + (shape.j0 + j) * near_words(shape) + (shape.i0 + i) / 32),
          bit_(1U << (static_cast<std::uint32_t>(shape.i0 + i) % 32U)) {}

    void put(bool near) {
        *word_ = near ? *word_ | bit_ : *word_ & ~bit_;
        bit_ <<= 1U;
        if (bit_ == 0) {
            bit_ = 1;
            ++word_;
        }
    }

private:
    std::uint32_t* word_;
    std::uint32_t bit_;
};

template <class Real>
inline bool is_near(const Walls<Real>& walls, const GridShape& shape, std::int32_t i,
                    std::int32_t j) {
    const std::int32_t column = shape.i0 + i;
    const std::uint32_t word = walls.near[(shape.j0 + j) * near_words(shape) + column / 32];
    return (word >> (static_cast<std::uint32_t>(column) % 32U) & 1U) != 0;
}

/// The marks of a row's first 32 cells, and behind them those of the next ones.
template <class Real>
inline const std::uint32_t* first_near(const GridShape& shape, const Walls<Real>& walls,
                                       std::int32_t j) {
    return walls.near + (shape.j0 + j) * near_words(shape) + shape.i0 / 32;
}

/// Calls visit(i, j) for every cell of some rows that is marked, row by row. Where there is none,
/// 32 cells cost one look. A part of the tank begins at a multiple of as many.
template <class Real, class Visit>
inline void for_each_near(const GridShape& shape, const Walls<Real>& walls, const Part& rows,
                          Visit visit) {
    const std::int32_t words = near_words(shape);
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const std::uint32_t* row = walls.near + (shape.j0 + j) * words + shape.i0 / 32;
        for (std::int32_t k = 0; 32 * k < shape.nx; ++k) {
            std::uint32_t left = row[k];
#if defined(__ARM_ARCH_6M__)  // others count zeros in an instruction or two
            for (std::int32_t i = 32 * k; left != 0; left >>= 1U, ++i) {
                if ((left & 1U) != 0) {
                    visit(i, j);
                }
            }
#else
            for (; left != 0; left &= left - 1U) {
                visit(32 * k + WEIR_TRAILING_ZEROS(left), j);
            }
#endif
        }
    }
}

/// Velocity of the body's material at a point of the tank, cells/s.
template <class Real>
inline Vec2<Real> velocity_at(const Body<Real>& body, Vec2<Real> point) {
    return body.velocity + spin_velocity(body.spin, point - body.position);
}

/// Slot of the body that is nearest to a node, or kNoBody.
template <class Real>
inline std::uint16_t nearest_at(const Walls<Real>& walls, std::int32_t node) {
    if (has_names<Real>(walls.nearest)) {
        return walls.nearest[node];
    }
    return walls.distance[node] < kBand<Real> ? std::uint16_t{0} : kNoBody;
}

/// Slot of the body that is nearest to an edge between two nodes, or kNoBody.
template <class Real>
inline std::uint16_t nearest_body(const Walls<Real>& walls, std::int32_t a, std::int32_t b) {
    return nearest_at(walls, walls.distance[a] < walls.distance[b] ? a : b);
}

/// Slot of the nearest body if viscous liquid sticks to it, or kNoBody.
template <class Real>
inline std::uint16_t sticking_body(const Walls<Real>& walls, std::int32_t a, std::int32_t b) {
    const std::uint16_t slot = nearest_body(walls, a, b);
    return slot != kNoBody && walls.body[slot].surface.no_slip ? slot : kNoBody;
}

/// Whether a contour or a thin wall is in a cell or at its faces.
template <class Real>
inline bool touches_wall(const Walls<Real>& walls, std::int32_t cell) {
    return walls.cell_case[cell] != 0 ||
           (walls.thin != nullptr && (walls.thin->mark[cell] & kTouching) != 0);
}

/// Whether all faces of a cell are wide open. A cell that no contour crosses may yet have a closed
/// one: its neighbour is a sliver.
template <class Real>
inline bool untouched(const Walls<Real>& walls, std::int32_t cell, std::int32_t up) {
    const auto wide = [](Real open) { return bound_key(open) == bound_key(Real(1)); };
    return wide(walls.open_u[cell]) && wide(walls.open_u[cell + 1]) && wide(walls.open_v[cell]) &&
           wide(walls.open_v[up]);
}

}  // namespace weir
