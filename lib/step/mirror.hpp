// Where a face in a solid takes its velocity from, and which.
#pragma once

#include "fluid/particles.hpp"
#include "pressure/parting.hpp"
#include "solid/face_axis.hpp"
#include "solid/moving_walls.hpp"

namespace weir {

/// The mirror point lies at least this far out, where the stencil holds liquid.
template <class Real>
inline constexpr Real kLeastReach = Real(1);

/// What is no faster along a wall than so many times the liquid goes with it, and is not braked:
/// the two are known at different places. With one and a half, jets gained energy, and with any if
/// the liquid is compressible.
template <class Real>
inline Real goes_along(const PressureFields<Real>& fields) {
    return Real(fields.sound_speed > Real(0) ? 1.0F : 1.25F);
}

/// A velocity that is only read, and the one before the step, which tells whose faces are reached.
template <class Real>
struct Velocity {
    const GridShape& shape;
    const VelocityOf<Real>* u;
    const VelocityOf<Real>* v;
    const VelocityOf<Real>* was_u;
    const VelocityOf<Real>* was_v;
    Real goes_along;
    /// Whether faces that no particle reaches count as liquid at rest, too: compressible liquid,
    /// which stores what pushes it, would gain by what that takes.
    bool all_count;
};

/// The velocity, which is to be `mirrored`, and the one before the step, which becomes `before`.
template <class Real>
struct TwoFields {
    Velocity<Real> now;
    Velocity<Real> was;
    const PressureFields<Real>& pressure;
    Vec2<Real> fall;  ///< what gravity gave
};

template <class Real>
struct Mirror {
    std::int32_t face;
    bool is_u;             ///< the face
    Vec2<Real> normal;
    Vec2<Real> point;      ///< in the liquid
    Stencil<Real> at_u;    ///< around it
    Stencil<Real> at_v;
    Vec2<Real> wall;       ///< velocity of the wall there
    Real ratio = Real(0);  ///< depth of the face over distance of the mirror point
    bool sticks = false;   ///< the wall's own velocity on the wall, not slip
    bool open = false;     ///< the face: what it has along the normal is the liquid's
    bool slack = false;    ///< gravity takes the liquid from the wall, and nothing holds it there
};

/// A face between two nodes.
template <class Real>
struct Edge {
    Vec2<Real> centre;
    std::int32_t a;
    std::int32_t b;
};

template <class Real>
void mirror_of(const GridShape& s, const Walls<Real>& walls, const Edge<Real>& edge, Real distance,
               Vec2<Real> normal, Mirror<Real>& mirror) {
    const Vec2<Real> face = edge.centre;
    mirror.face = edge.a;
    mirror.is_u = edge.b - edge.a != 1;
    mirror.normal = normal;
    mirror.wall = walls.moving != nullptr ? walls.moving->velocity(walls, edge.a, edge.b, face)
                                         : Vec2<Real>{};
    const std::uint16_t slot =
        walls.sticking != nullptr ? sticking_body(walls, edge.a, edge.b) : kNoBody;
    mirror.sticks = slot != kNoBody;
    if (mirror.sticks) {
        const Body<Real>& body = walls.body[slot];
        const Vec2<Real> on_wall = face - distance * mirror.normal;
        mirror.wall = surface_velocity(body.surface, velocity_at(body, on_wall), mirror.normal);
    }
    const Real depth = mirror.sticks ? -distance : -minimum(distance, Real(0));
    const Real reach = maximum(depth, kLeastReach<Real>);
    mirror.point = within_tank(s, face + (depth + reach) * mirror.normal);
    mirror.ratio = minimum(depth, kLeastReach<Real>);  // depth / reach: that least is 1
}

/// Whether the point's cell or one around it holds liquid.
template <class Real>
bool near_liquid(const GridShape& s, const LevelOf<Real>* level, Vec2<Real> point) {
    const std::int32_t i = static_cast<std::int32_t>(point.x) - s.i0;
    const std::int32_t j = static_cast<std::int32_t>(point.y) - s.j0;
    if (level[s.index(minimum(i, s.nx - 1), minimum(j, s.ny - 1))] > Real(0)) {
        return true;  // nearly always
    }
    for (std::int32_t row = maximum(j - 1, 0); row <= minimum(j + 1, s.ny - 1); ++row) {
        for (std::int32_t column = maximum(i - 1, 0); column <= minimum(i + 1, s.nx - 1);
             ++column) {
            if (level[s.index(column, row)] > Real(0)) {
                return true;
            }
        }
    }
    return false;
}

/// As `interpolate`, of those faces alone that particles reach, if they are a film's. Not inline:
/// few are.
template <class Real>
[[gnu::noinline]] Real of_reached(const VelocityOf<Real>* field, const VelocityOf<Real>* was,
                                  std::int32_t stride, const Stencil<Real>& at) {
    const std::int32_t face[4] = {at.base, at.base + 1, at.base + stride, at.base + stride + 1};
    const Real share[4] = {(Real(1) - at.fx) * (Real(1) - at.fy), at.fx * (Real(1) - at.fy),
                           (Real(1) - at.fx) * at.fy, at.fx * at.fy};
    Real reached[4];
    for (std::int32_t k = 0; k < 4; ++k) {
        reached[k] = is_no_velocity(Real(was[face[k]])) ? Real(0) : share[k];
    }
    const Real weight = ((reached[0] + reached[1]) + reached[2]) + reached[3];
    if (!(weight < Real(kFilmWeight) && weight > Real(kLeastFilmWeight))) {
        return interpolate(field, stride, at);
    }
    const Real sum = ((reached[0] * Real(field[face[0]]) + reached[1] * Real(field[face[1]])) +
                      reached[2] * Real(field[face[2]])) +
                     reached[3] * Real(field[face[3]]);
    return sum / weight;
}

/// Packed worlds cannot tell who is reached from who is at rest.
template <class Real>
Real at_mirror(const VelocityOf<Real>* field, const VelocityOf<Real>* was, std::int32_t stride,
               const Stencil<Real>& at, bool all_count) {
    if constexpr (!Stored<Real>::coarse) {
        const VelocityOf<Real>* low = was + at.base;
        const VelocityOf<Real>* high = low + stride;
        if (!all_count && (is_no_velocity(Real(low[0])) || is_no_velocity(Real(low[1])) ||
                           is_no_velocity(Real(high[0])) || is_no_velocity(Real(high[1])))) {
            return of_reached<Real>(field, was, stride, at);
        }
    }
    return interpolate(field, stride, at);
}

template <class Real>
Vec2<Real> at_mirror(const Velocity<Real>& grid, const Mirror<Real>& mirror) {
    const std::int32_t stride = grid.shape.stride;
    return {at_mirror<Real>(grid.u, grid.was_u, stride, mirror.at_u, grid.all_count),
            at_mirror<Real>(grid.v, grid.was_v, stride, mirror.at_v, grid.all_count)};
}

/// Mean of four faces side by side, but for those that no particle reaches.
template <class Real>
Real mean_of_faces(const VelocityOf<Real>* field, const VelocityOf<Real>* was, bool all_count,
                   std::int32_t stride, std::int32_t first) {
    Real count = Real(0);
    const auto look = [&](std::int32_t face) {
        const bool reached = all_count || !is_no_velocity(Real(was[face]));
        count += Real(reached ? 1 : 0);
        return reached ? Real(field[face]) : Real(0);
    };
    const Real low = look(first) + look(first + 1);
    const Real high = look(first + stride) + look(first + stride + 1);
    return (low + high) / maximum(count, Real(1));
}

/// The face's own component, and the mean of the other's four faces around it.
template <class Real>
Vec2<Real> at_face(const Velocity<Real>& grid, const Mirror<Real>& mirror) {
    const std::int32_t stride = grid.shape.stride;
    const std::int32_t face = mirror.face;
    const auto mean = [&](const VelocityOf<Real>* of, const VelocityOf<Real>* was,
                          std::int32_t first) {
        return mean_of_faces<Real>(of, was, grid.all_count, stride, first);
    };
    return mirror.is_u ? Vec2<Real>{grid.u[face], mean(grid.v, grid.was_v, face - 1)}
                       : Vec2<Real>{mean(grid.u, grid.was_u, face - stride), grid.v[face]};
}

/// What is at the face itself, along the wall's normal and in its frame.
template <class Real>
Real own_towards(const Velocity<Real>& grid, const Mirror<Real>& mirror) {
    const Vec2<Real> own = at_face(grid, mirror) - mirror.wall;
    return dot(own, mirror.normal);
}

/// Where the liquid sticks: along the wall linear from the wall to the liquid at the mirror point.
template <class Real>
Vec2<Real> stuck(const Mirror<Real>& mirror, Vec2<Real> liquid, Real towards) {
    const Vec2<Real> relative = liquid - mirror.wall;
    const Real across = dot(relative, mirror.normal);
    const Vec2<Real> along = relative - across * mirror.normal;
    return (mirror.wall - mirror.ratio * along) + towards * mirror.normal;
}

/// Whether the pressure at a point is slack, in the part of the tank that is looked at.
template <class Real>
bool is_slack_at(const GridShape& s, const PressureFields<Real>& fields, Vec2<Real> point) {
    const std::int32_t i = static_cast<std::int32_t>(point.x) - s.i0;
    const std::int32_t j = static_cast<std::int32_t>(point.y) - s.j0;
    return i < s.nx && j < s.ny &&
           absolute(fields.pressure[s.index(i, j)]) <= most_slack(fields);
}

/// What a mirrored velocity differs by along the normal from the liquid's, which has so much.
template <class Real>
inline Real turned(const Mirror<Real>& mirror, Real normal_part) {
    if (mirror.slack && normal_part > Real(0)) {
        return Real(0);  // it takes the face along
    }
    return normal_part * (Real(1) + mirror.ratio);
}

/// Velocity that a face in a solid takes: mirrored about the wall, in the wall's frame.
template <class Real>
Vec2<Real> mirrored(const Velocity<Real>& grid, const Mirror<Real>& mirror) {
    const Vec2<Real> liquid = at_mirror(grid, mirror);
    const Real normal_part = dot(liquid - mirror.wall, mirror.normal);
    if (mirror.sticks) {
        return stuck(mirror, liquid, mirror.open ? own_towards(grid, mirror)
                                                       : -mirror.ratio * normal_part);
    }
    return liquid - turned(mirror, normal_part) * mirror.normal;
}

/// Velocity before the step that goes with it: along the wall the liquid's, so that the change is
/// the liquid's, and by how much what was there was faster than goes along with it, so that the
/// change brakes that. Along the normal mirrored, too, and by how much what was there goes into the
/// wall beyond that and `kAlongBend`, so that the change stops it. All mirrored where it sticks.
template <class Real>
Vec2<Real> before(const Velocity<Real>& grid, const Mirror<Real>& mirror) {
    const Vec2<Real> liquid = at_mirror(grid, mirror) - mirror.wall;
    if (mirror.sticks) {
        return stuck(mirror, liquid + mirror.wall, own_towards(grid, mirror));
    }
    const Vec2<Real> own = at_face(grid, mirror);
    const Vec2<Real> relative = own - mirror.wall;
    const Vec2<Real> tangent{-mirror.normal.y, mirror.normal.x};
    const Real along = dot(relative, tangent);
    const Real liquid_along = dot(liquid, tangent);
    const Real most = grid.goes_along * absolute(liquid_along);
    const Real taken = clamp(along, -most, most) - liquid_along;
    const Real towards = dot(relative, mirror.normal);
    const Real normal_part = dot(liquid, mirror.normal);
    const Real beyond = towards - (normal_part - turned(mirror, normal_part));
    const Real free = maximum<Real>(beyond, -(kAlongBend<Real> * absolute(along)));
    return own - (taken * tangent + free * mirror.normal);
}

/// Whether a face takes what is mirrored: it is closed, or bound to the wall. Between two nodes.
template <class Real>
bool is_mirrored(const Walls<Real>& walls, Real open, Real distance, std::int32_t a,
                 std::int32_t b) {
    if (open > Real(0)) {
        return walls.sticking != nullptr && distance < kBoundLayer<Real> &&
               sticking_body(walls, a, b) != kNoBody;
    }
    return !(distance < kDeepestMirror<Real>);
}

/// Whether nobody reads a closed face. Particles read what they gave mass to, and that shows in
/// both its cells unless thin walls hide it; bends and sharpening read what is beside liquid.
template <class Real>
inline bool is_unread(const FaceAxis<Real>& axis, const PressureFields<Real>& fields,
                      std::int32_t face) {
    const std::int32_t before = face - axis.before();
    const auto wet = [&](std::int32_t cell) { return is_positive(Real(fields.level[cell])); };
    return axis.walls.thin == nullptr && !wet(face) && !wet(before) &&
           (is_empty(fields, face) || is_empty(fields, before));
}

/// The same to the other side of a solid that is thin here. False: it is thick, or ends at the
/// tank's wall.
template <class Real>
bool from_other_side(const FaceAxis<Real>& axis, const Edge<Real>& edge, Vec2<Real> normal,
                     Mirror<Real>& mirror) {
    const GridShape& s = axis.s;
    const Vec2<Real> across = edge.centre - normal;
    const Vec2<Real> inside = within_tank(s, across);
    if (inside.x != across.x || inside.y != across.y) {
        return false;
    }
    const auto i = static_cast<std::int32_t>(across.x);
    const auto j = static_cast<std::int32_t>(across.y);
    const Stencil<Real> at{s.index(i - s.i0, j - s.j0), across.x - static_cast<Real>(i),
                           across.y - static_cast<Real>(j)};
    const Real distance = interpolate(axis.walls.distance, s.stride, at) - Real(1);
    if (distance > Real(0) || !(distance > Real(-1))) {
        return false;
    }
    mirror_of(s, axis.walls, edge, distance, Real(-1) * normal, mirror);
    return true;
}

/// Whether a face is to take its velocity from elsewhere: a look at most of them.
template <class Real>
WEIR_ALWAYS_INLINE bool wants_image(const FaceAxis<Real>& axis,
                                    const PressureFields<Real>& fields,
                                    std::int32_t face) {
    const Real open = axis.open()[face];
    if (is_positive(open) && axis.walls.sticking == nullptr) {
        return false;
    }
    return (is_positive(open) || !is_unread(axis, fields, face)) &&
           is_mirrored<Real>(axis.walls, open, axis.distance(face), face,
                             face + axis.other_node());
}

/// Where such a face takes its velocity from. False: it keeps its own.
template <class Real>
bool find_mirror(const FaceAxis<Real>& axis, const PressureFields<Real>& fields, Vec2<Real> fall,
                 std::int32_t i, std::int32_t j, Mirror<Real>& mirror) {
    const std::int32_t face = axis.s.index(i, j);
    const Edge<Real> edge{axis.centre(i, j), face, face + axis.other_node()};
    const Vec2<Real> normal = axis.normal(face);
    mirror_of(axis.s, axis.walls, edge, axis.distance(face), normal, mirror);
    if (!near_liquid(axis.s, fields.level, mirror.point) &&
        !(from_other_side(axis, edge, normal, mirror) &&
          near_liquid(axis.s, fields.level, mirror.point))) {
        return false;
    }
    mirror.open = axis.open()[face] > Real(0);
    const Real from_wall = dot(mirror.normal, fall);
    mirror.slack = from_wall > Real(0) && is_slack_at(axis.s, fields, mirror.point);
    mirror.at_u = stencil_u(axis.s, mirror.point);
    mirror.at_v = stencil_v(axis.s, mirror.point);
    return true;
}

}  // namespace weir
