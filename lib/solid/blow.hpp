// Particles that hit a body, and what the body receives.
#pragma once

#include "math/lanes.hpp"
#include "solid/collide.hpp"
#include "solid/moving_walls.hpp"
#include "solid/reflect.hpp"

namespace weir {

/// What `collide` works on.
template <class Real>
struct Scene {
    const GridShape& shape;
    const Walls<Real>& walls;
    Particles<Real>& particles;
    Contacts<Real>& contacts;
    CollideResult<Real>& result;
    Seconds<Real> dt_s;
    bool beyond;  ///< where no picture is stored, and a search for a way out would draw a thousand
    const BodyTable<Real>* bodies;
};

/// Gives the particle its velocity after a blow of a body at `x`, and the body its due.
template <class Real>
void blow(Scene<Real>& scene, std::int32_t k, std::uint16_t slot, Vec2<Real> x,
          Vec2<Real> after) {
    Particles<Real>& particles = scene.particles;
    if constexpr (Stored<Real>::coarse) {  // what cannot be kept is not given, either
        constexpr Real kMost = Real(256);
        after = {clamp(after.x, -kMost, kMost), clamp(after.y, -kMost, kMost)};
    }
    const Vec2<Real> before = particles.velocity[k];
    particles.velocity[k] = after;
    const Liquid kind = particles.kind != nullptr ? particles.kind[k] : Liquid::first;
    if (scene.contacts.blows != nullptr) {
        scene.contacts.blows->record(scene.contacts, scene.walls, slot, kind, x, before - after);
    }
    const Vec2<Real> kept = particles.velocity[k];  // as it is stored
    scene.result.max_speed =
        maximum(scene.result.max_speed, larger_part(kept));
}

/// The surface of a body answers a particle that hits it at `x`.
template <class Real>
[[gnu::noinline]] void answer(Scene<Real>& scene, std::int32_t k, std::uint16_t slot,
                              Vec2<Real> x, Vec2<Real> normal) {
    const Body<Real>& body = scene.walls.body[slot];
    const Vec2<Real> surface =
        surface_velocity(body.surface, velocity_at(scene.walls, slot, x), normal);
    const Vec2<Real> before = scene.particles.velocity[k];
    blow(scene, k, slot, x, reflect(body.surface, surface, before, normal));
}

/// A particle that has met a solid, and stays unless it has no way out. Whoever keeps record of
/// where particles are wants to know of one that a body took along.
template <class Real>
void note(Scene<Real>& scene, std::int32_t k, bool stays, Vec2<Real> before, bool mark) {
    if (!stays) {
        ++scene.result.removed;
        mark ? scene.particles.mark(k) : scene.particles.remove(k);
    } else if constexpr (kHasLanes<Real>) {
        constexpr Real kFar = Real(2.5);
        const Vec2<Real> way = Vec2<Real>(scene.particles.position[k]) - before;
        scene.result.leapt =
            scene.result.leapt || absolute(way.x) > kFar || absolute(way.y) > kFar;
    }
}

}  // namespace weir
