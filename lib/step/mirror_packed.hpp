// Where a face in a solid takes its velocity from, and which: packed worlds, in whole numbers.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "pressure/domain.hpp"
#include "step/mirror.hpp"
#include "step/places_packed.hpp"

namespace weir {

namespace packed {

using Whole = Vec2<std::int32_t>;

/// What `weir::Mirror` says.
struct Mirror {
    Whole normal;         ///< 2^−14ths
    Whole wall;           ///< velocity, 256ths
    std::uint32_t place;  ///< in the liquid, a word of 256ths
    std::int32_t ratio;   ///< 512ths
    bool sticks;
    bool open;
    bool slack;  ///< gravity takes the liquid from the wall, and nothing holds it there
};

/// Of a velocity, 256ths, or of a cross-wise one; both fit with any normal.
inline std::int32_t along(Whole v, Whole normal) {
    return rounded_shift(v.x * normal.x + v.y * normal.y, 14);
}
inline Whole relative_to(Whole wall, Whole v) {
    return {saturated<17>(v.x - wall.x), saturated<17>(v.y - wall.y)};
}

/// Faces of a component around a place, and their weights.
struct StencilAt {
    std::int32_t first;  ///< the lower left one, in bytes
    Weights w;

    std::int32_t of(const Speed* field, std::int32_t stride) const {
        const Speed* low = further(field, first);
        const Speed* high = low + stride;
        return rounded_shift((w.lower_left * low[0].raw + w.lower_right * low[1].raw) +
                             (w.upper_left * high[0].raw + w.upper_right * high[1].raw), 7);
    }
};
template <bool OnU>
inline StencilAt stencil_at(std::uint32_t place, std::int32_t stride) {
    const std::uint32_t from = place + kHalf<OnU>;
    return {base_of(from, stride * kSpeedBytes) + (OnU ? 1 : stride) * kSpeedBytes,
            weights_of(from)};
}

/// Faces around a mirror's place, the same ones of each field.
struct MirrorFaces {
    StencilAt u;
    StencilAt v;

    MirrorFaces(const Mirror& mirror, std::int32_t stride)
        : u(stencil_at<true>(mirror.place, stride)),
          v(stencil_at<false>(mirror.place, stride)) {}
};

/// One of the fields that are mirrored, on the faces of one component.
struct MirrorTask {
    const FaceAxis<Real>& axis;
    const Velocity<Real>& grid;

    std::int32_t of(Whole v) const { return axis.is_u ? v.x : v.y; }
    /// A length along the normal.
    std::int32_t part(std::int32_t length, const Mirror& mirror) const {
        return rounded_shift(length * of(mirror.normal), 14);
    }

    Whole at_mirror(const MirrorFaces& faces) const {
        return {faces.u.of(grid.u, axis.s.stride), faces.v.of(grid.v, axis.s.stride)};
    }
    /// The face's own component, and the mean of the other's four faces around it.
    Whole at_face(std::int32_t face) const {
        const std::int32_t t = axis.s.stride;
        const auto mean = [t](const Speed* low) {
            return rounded_shift((low[0].raw + low[1].raw) + (low[t].raw + low[t + 1].raw), 1);
        };
        return axis.is_u ? Whole{2 * grid.u[face].raw, mean(grid.v + face - 1)}
                         : Whole{mean(grid.u + face - t), 2 * grid.v[face].raw};
    }
    std::int32_t own_towards(const Mirror& mirror, std::int32_t face) const {
        return along(relative_to(mirror.wall, at_face(face)), mirror.normal);
    }

    std::int32_t stuck(const Mirror& mirror, Whole relative, std::int32_t towards) const {
        const std::int32_t across = along(relative, mirror.normal);
        const std::int32_t aside = of(relative) - part(across, mirror);
        return of(mirror.wall) - rounded_shift(mirror.ratio * aside, 9) + part(towards, mirror);
    }

    /// `weir::mirrored`, 256ths.
    std::int32_t mirrored(const Mirror& mirror, Whole liquid, std::int32_t face) const {
        const Whole relative = relative_to(mirror.wall, liquid);
        const std::int32_t towards = along(relative, mirror.normal);
        if (mirror.sticks) {
            return stuck(mirror, relative,
                         mirror.open ? own_towards(mirror, face)
                                     : -rounded_shift(mirror.ratio * towards, 9));
        }
        return of(liquid) - part(turned(mirror, towards), mirror);
    }

    /// `weir::turned`, 256ths.
    static std::int32_t turned(const Mirror& mirror, std::int32_t towards) {
        if (mirror.slack && towards > 0) {
            return 0;  // it takes the face along
        }
        return saturated<17>(rounded_shift(towards * (512 + mirror.ratio), 9));
    }

    static Speed speed_of(std::int32_t image) {
        return Speed::of_raw(short_of(rounded_shift(image, 1)));
    }
    Speed speed_now(const Mirror& mirror, const MirrorFaces& faces, std::int32_t face) const {
        return speed_of(mirrored(mirror, at_mirror(faces), face));
    }
    Speed speed_before(const Mirror& mirror, const MirrorFaces& faces, std::int32_t face) const {
        return speed_of(before(mirror, at_mirror(faces), face));
    }

    /// `weir::before`, 256ths. Faces that no particle reaches count as they are.
    std::int32_t before(const Mirror& mirror, Whole liquid, std::int32_t face) const {
        const Whole relative = relative_to(mirror.wall, liquid);
        if (mirror.sticks) {
            return stuck(mirror, relative, own_towards(mirror, face));
        }
        const Whole there = at_face(face);
        const Whole tangent{-mirror.normal.y, mirror.normal.x};
        const std::int32_t liquid_along = along(relative, tangent);
        const Whole own = relative_to(mirror.wall, there);
        const std::int32_t own_along = along(own, tangent);
        const std::int32_t size = absolute(liquid_along);
        const std::int32_t most = size + size / 4;
        const std::int32_t taken = clamp(own_along, -most, most) - liquid_along;
        const std::int32_t towards = along(relative, mirror.normal);
        const std::int32_t beyond =
            along(own, mirror.normal) - (towards - turned(mirror, towards));
        const std::int32_t free = maximum(beyond, -(absolute(own_along) / 2));
        return of(there) -
               rounded_shift(taken * of(tangent) + saturated<17>(free) * of(mirror.normal), 14);
    }
};

/// Distances are 256ths, so differences across two faces are 1024ths.
inline Whole normal_at(const FaceAxis<Real>& axis, std::int32_t face) {
    const auto* d = axis.walls.distance + face;
    const std::int32_t edge = axis.other_node();
    const std::int32_t step = axis.is_u ? 1 : axis.s.stride;
    const std::int32_t near = saturated<14>(4 * (d[edge].raw - d[0].raw));
    const std::int32_t wide = saturated<14>((d[step].raw + d[step + edge].raw) -
                                            (d[-step].raw + d[edge - step].raw));
    const auto square = static_cast<std::uint32_t>(near * near + wide * wide);
    const std::uint32_t length = fixed::root_below(16U * square).root;
    const auto inverse = static_cast<std::int32_t>((1U << 26U) / maximum(length, 1U));
    const std::int32_t along_edge = rounded_shift(near * inverse, 10);
    const std::int32_t across = length == 0 ? 1 << 14 : rounded_shift(wide * inverse, 10);
    return axis.is_u ? Whole{across, along_edge} : Whole{along_edge, across};
}

inline Vec2<Real> as_real(Whole normal) {
    return {Real::of_raw(4 * normal.x), Real::of_raw(4 * normal.y)};
}

/// Where a face lies, and in which part of the tank, 256ths.
struct FacePlace {
    const GridShape& s;
    Whole centre;

    FacePlace(const FaceAxis<Real>& axis, std::int32_t i, std::int32_t j)
        : s(axis.s), centre{(s.i0 + i) * 256 + (axis.is_u ? 0 : 128),
                            (s.j0 + j) * 256 + (axis.is_u ? 128 : 0)} {}
    /// So many 512ths away; what lies outside is put back.
    Whole further_out(std::int32_t way, Whole normal, bool& outside) const {
        constexpr std::int32_t kGap = Place(kWallGap<Real>).raw;
        const Whole to{centre.x + rounded_shift(way * normal.x, 15),
                       centre.y + rounded_shift(way * normal.y, 15)};
        const Whole in{clamp(to.x, s.i0 * 256 + kGap, (s.i0 + s.nx) * 256 - kGap),
                       clamp(to.y, s.j0 * 256 + kGap, (s.j0 + s.ny) * 256 - kGap)};
        outside = in.x != to.x || in.y != to.y;
        return in;
    }
};

inline std::uint32_t word_of(Whole place) {
    return static_cast<std::uint32_t>(place.x) + (static_cast<std::uint32_t>(place.y) << 16U);
}

/// `distance`: 512ths. @return whether there is liquid at the mirror's place.
inline bool mirror_of(const FaceAxis<Real>& axis, const TwoFields<Real>& both,
                      const FacePlace& from, std::int32_t face, std::int32_t distance,
                      Whole normal, Mirror& mirror) {
    const Walls<Real>& walls = axis.walls;
    const std::int32_t other = face + axis.other_node();
    const std::uint16_t slot =
        walls.sticking != nullptr ? walls.sticking->body(axis, face) : kNoBody;
    mirror.normal = normal;
    mirror.sticks = slot != kNoBody;
    mirror.wall = {};
    if (walls.moving != nullptr || mirror.sticks) {
        const auto real = [](std::int32_t place) { return Real::of_raw(256 * place); };
        const Vec2<Real> centre{real(from.centre.x), real(from.centre.y)};
        const Vec2<Real> n = as_real(normal);
        const Vec2<Real> wall =
            mirror.sticks ? walls.sticking->velocity(
                                axis, slot, centre - Real::of_raw(128 * distance) * n, n)
                          : walls.moving->velocity(walls, face, other, centre);
        constexpr std::int32_t kMost = 0x7FFFFF00;  // a fast spin's end saturates
        mirror.wall = {rounded_shift(clamp(wall.x.raw, -kMost, kMost), 8),
                       rounded_shift(clamp(wall.y.raw, -kMost, kMost), 8)};
    }
    constexpr std::int32_t kReach = 512;
    const std::int32_t depth = mirror.sticks ? -distance : maximum(-distance, 0);
    bool outside = false;
    const Whole place = from.further_out(depth + maximum(depth, kReach), normal, outside);
    mirror.place = word_of(place);
    mirror.ratio = minimum(depth, kReach);
    const Vec2<Real> point{Real::of_raw(256 * place.x), Real::of_raw(256 * place.y)};
    const Whole fall{Speed(both.fall.x).raw, Speed(both.fall.y).raw};
    mirror.slack = along(fall, normal) > 0 && is_slack_at(axis.s, both.pressure, point);
    return near_liquid(axis.s, both.pressure.level, point);
}

/// A cell further on, where a solid that is thin here has its other side: its distance from the
/// face, 512ths, or 1: it is thick, or ends at the tank's wall.
inline std::int32_t other_side(const FaceAxis<Real>& axis, const FacePlace& from, Whole normal) {
    bool outside = false;
    const std::uint32_t at = word_of(from.further_out(-512, normal, outside));
    const Weights w = weights_of(at);
    const std::int32_t t = axis.s.stride;
    const auto* low = axis.walls.distance +
                      (static_cast<std::int32_t>(at >> 24U) + 1) * t + low_byte(at >> 8U) + 1;
    const std::int32_t distance =
        rounded_shift((w.lower_left * low[0].raw + w.lower_right * low[1].raw) +
                      (w.upper_left * low[t].raw + w.upper_right * low[t + 1].raw), 7) - 512;
    return outside || distance > 0 || distance <= -512 ? 1 : distance;
}

/// `weir::find_mirror`.
inline bool find_mirror(const FaceAxis<Real>& axis, const TwoFields<Real>& both,
                        std::int32_t i, std::int32_t j, Mirror& mirror) {
    const std::int32_t face = axis.s.index(i, j);
    const std::int32_t distance =
        axis.walls.distance[face].raw + axis.walls.distance[face + axis.other_node()].raw;
    mirror.open = axis.open()[face].raw != 0;
    const FacePlace from(axis, i, j);
    const Whole normal = normal_at(axis, face);
    if (mirror_of(axis, both, from, face, distance, normal, mirror)) {
        return true;
    }
    const std::int32_t beyond = other_side(axis, from, normal);
    return beyond <= 0 &&
           mirror_of(axis, both, from, face, beyond, {-normal.x, -normal.y}, mirror);
}

/// What a face takes in both fields.
struct Image {
    Speed now;
    Speed was;
};

/// False: it keeps its own. By itself: it is asked for in several places.
[[gnu::noinline]] inline bool find_image(const FaceAxis<Real>& axis, const TwoFields<Real>& fields,
                                         std::int32_t i, std::int32_t j, Image& image) {
    const std::int32_t face = axis.s.index(i, j);
    Mirror mirror;
    if (!wants_image(axis, fields.pressure, face) ||
        !find_mirror(axis, fields, i, j, mirror)) {
        return false;
    }
    const MirrorFaces faces(mirror, axis.s.stride);
    image.now = MirrorTask{axis, fields.now}.speed_now(mirror, faces, face);
    image.was = MirrorTask{axis, fields.was}.speed_before(mirror, faces, face);
    return true;
}

/// Both fields of a packed world in one look at each face. What is computed is held one behind the
/// other in scratch, and which faces of a cell it is for in place of the cell's diagonal.
class BothMirrors {
public:
    BothMirrors(const Domain<Real>& domain, const TwoFields<Real>& both)
        : walls_(domain.walls), both_(both), fields_(domain.fields), grid_(domain.grid),
          held_(fields_.divergence),
          end_(held_ + grid_.shape.index(grid_.shape.nx, grid_.shape.ny - 1)) {}

    /// False: there are too many, and nothing has happened.
    bool mirror() {
        const GridShape& s = grid_.shape;
        const FaceAxis<Real> on_u{s, walls_, true};
        const FaceAxis<Real> on_v{s, walls_, false};
        const Part rows{0, s.ny};
        for_each_near(s, walls_, rows, [&](std::int32_t i, std::int32_t j) {
            fields_.inverse_diagonal[s.index(i, j)].raw = static_cast<std::int16_t>(
                (i > 0 && hold(on_u, i, j) ? 1 : 0) + (j > 0 && hold(on_v, i, j) ? 2 : 0));
        });
        if (held_ > end_) {
            return false;
        }
        held_ = fields_.divergence;
        for_each_near(s, walls_, rows, [&](std::int32_t i, std::int32_t j) {
            const std::int32_t c = s.index(i, j);
            const std::int32_t which = fields_.inverse_diagonal[c].raw;
            if ((which & 1) != 0) {
                write(grid_.u, grid_.mass_u, c);
            }
            if ((which & 2) != 0) {
                write(grid_.v, grid_.mass_v, c);
            }
        });
        return true;
    }

private:
    bool hold(const FaceAxis<Real>& axis, std::int32_t i, std::int32_t j) {
        Image image;
        if (!find_image(axis, both_, i, j, image)) {
            return false;
        }
        held_ += 2;
        if (held_ <= end_) {
            held_[-2] = image.now;
            held_[-1] = image.was;
        }
        return true;
    }
    void write(Speed* now, Speed* was, std::int32_t face) {
        now[face] = held_[0];
        was[face] = held_[1];
        held_ += 2;
    }

    const Walls<Real>& walls_;
    const TwoFields<Real>& both_;
    PressureFields<Real>& fields_;
    StaggeredGrid<Real>& grid_;
    Speed* held_;
    Speed* end_;
};

}  // namespace packed

}  // namespace weir
