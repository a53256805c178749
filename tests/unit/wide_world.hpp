// Worlds of a tank that is large for their liquid, and what happens in two of them at once: a lump of
// liquid wanders, and bodies come, move and go.
#pragma once

#include <algorithm>
#include <cmath>

#include "busy_world.hpp"

namespace weir {

inline constexpr float kCell = 0.02F;

inline constexpr std::int32_t kKinds = 9;     ///< without bodies
inline constexpr std::int32_t kAllKinds = 15;  ///< and with them

/// Worlds in a tank that is large for their liquid.
inline WorldDef wide_def(std::int32_t kind) {
    WorldDef def = tank_def(250, 150, 500);
    def.walls = every_wall({0.0F, 0.5F, false, 0.0F});
    switch (kind) {
        case 1:
            def.pressure = Pressure::equation_of_state;
            def.sound_speed_mps = 3.0F;
            break;
        case 2:
            def.capacity.second_liquid = true;
            def.second_density_ratio = 3.0F;
            break;
        case 3:
            def.viscosity_m2ps = 1.0e-3F;
            def.walls = every_wall({0.0F, 0.3F, true, 0.2F});
            break;
        case 4:
            def.periodic_x = true;
            def.surface_tension_m3ps2 = 2.0e-4F;
            break;
        case 5: def.surface_tension_m3ps2 = 2.0e-4F; break;
        case 6: def.periodic_y = true; break;
        case 7: def.keep_sorted = true; break;
        case 8: def.sleep.speed_mps = 0.05F; break;
        case 10: def.contour = Contour::mid_edge; break;
        case 11:
            def.pressure = Pressure::equation_of_state;
            def.sound_speed_mps = 3.0F;
            break;
        case 12:
            def.viscosity_m2ps = 2.0e-3F;
            def.capacity.contacts = 6;
            break;
        case 13:
            def.capacity.second_liquid = true;
            def.second_density_ratio = 2.0F;
            break;
        case 14:
            def.capacity.moving_bodies = false;
            def.surface_tension_m3ps2 = 2.0e-4F;
            break;
        default: break;
    }
    if (kind >= kKinds) {
        def.capacity.bodies = 24;
        def.capacity.vertices = 400;
    }
    return def;
}

inline WorldDef windowed(WorldDef def, std::int32_t window_cells) {
    def.capacity.window_cells = window_cells;
    return def;
}

/// A star with that many corners, some of them far out.
inline Ring star(Dice& dice, std::int32_t corners, float radius) {
    Ring ring;
    for (std::int32_t k = 0; k < corners; ++k) {
        const float angle = 6.28F * static_cast<float>(k) / static_cast<float>(corners);
        const float out = radius * dice.uniform(0.4F, 1.0F);
        ring.push_back({out * std::cos(angle), out * std::sin(angle)});
    }
    return ring;
}

/// A lump that is moved about as a whole: gravity turns, and what strays is taken away.
template <class Real>
class Nomads {
public:
    Nomads(std::int32_t kind, std::uint64_t seed) : kind_(kind), dice_(seed) {}

    /// The same happens to both.
    void disturb(World<Real>& one, World<Real>& other) {
        const Vec2f low = lowest(one);
        switch (dice_.below(10)) {
            case 0: {
                const Vec2f gravity{dice_.uniform(-12.0F, 12.0F), dice_.uniform(-12.0F, 12.0F)};
                both(one, other, [&](World<Real>& w) { return w.set_gravity(gravity); });
                break;
            }
            case 1:
            case 2: {
                const Vec2f to{dice_.uniform(0.02F, 0.25F), dice_.uniform(0.02F, 0.25F)};
                const Box box{low, {std::min(low.x + to.x, 4.9F), std::min(low.y + to.y, 2.9F)}};
                const Liquid liquid = (kind_ == 2 || kind_ == 13) && dice_.below(2) == 0 ? Liquid::second
                                                                       : Liquid::first;
                both(one, other, [&](World<Real>& w) { return w.fill(box, nullptr, liquid); });
                break;
            }
            case 3: {
                const Vec2f way{dice_.uniform(-2.0F, 2.0F), dice_.uniform(-2.0F, 2.0F)};
                both(one, other, [&](World<Real>& w) {
                    return w.add_particle({std::min(low.x + 0.1F, 4.9F), low.y}, way);
                });
                break;
            }
            default: break;
        }
        if (kind_ >= kKinds && dice_.below(3) == 0) {
            disturb_bodies(one, other);
        }
        thin_out(one, other);
    }

    void disturb_bodies(World<Real>& one, World<Real>& other) {
        const std::int32_t slot = dice_.below(24);
        switch (dice_.below(4)) {
            case 0:
                both(one, other, [&](World<Real>& w) {
                    BodyId id;
                    return w.body_in_slot(slot, &id) == Status::ok ? w.remove_body(id)
                                                                   : Status::stale_body;
                });
                break;
            case 1: {
                Motion motion = any_motion(one);
                both(one, other, [&](World<Real>& w) {
                    BodyId id;
                    return w.body_in_slot(slot, &id) == Status::ok ? w.set_motion(id, motion)
                                                                   : Status::stale_body;
                });
                break;
            }
            default: put_body_in(one, other); break;
        }
    }

private:
    void put_body_in(World<Real>& one, World<Real>& other) {
        const float radius = dice_.below(5) == 0 ? dice_.uniform(0.3F, 1.5F)
                                                 : dice_.uniform(0.03F, 0.3F);
        const Ring ring = dice_.below(3) == 0
                              ? rectangle(std::floor(radius / kCell) * 2.0F * kCell, 6.0F * kCell)
                              : star(dice_, 3 + dice_.below(8), radius);
        BodyDef def = body_of(ring, {});
        def.surface = {dice_.uniform(0.0F, 1.0F), dice_.uniform(0.0F, 0.5F), dice_.below(2) == 0,
                       dice_.uniform(-0.2F, 0.2F)};
        const bool fixed = dice_.below(3) != 0;
        def.motion = any_motion(one);
        both(one, other, [&](World<Real>& w) {
            BodyId id;
            return fixed ? w.add_static_body(def, &id) : w.add_moving_body(def, &id);
        });
    }

    /// Mostly around the liquid, sometimes anywhere.
    Motion any_motion(World<Real>& world) {
        Motion motion;
        const Vec2f low = lowest(world);
        motion.position_m = dice_.below(4) == 0
                                ? Vec2f{dice_.uniform(0.0F, 5.0F), dice_.uniform(0.0F, 3.0F)}
                                : Vec2f{low.x + dice_.uniform(-1.2F, 1.2F),
                                        low.y + dice_.uniform(-0.8F, 0.8F)};
        if (dice_.below(2) == 0) {
            motion.position_m = {kCell * std::round(motion.position_m.x / kCell),
                                 kCell * std::round(motion.position_m.y / kCell)};
        } else {
            motion.angle_rad = dice_.uniform(-3.0F, 3.0F);
        }
        motion.velocity_mps = {dice_.uniform(-2.0F, 2.0F), dice_.uniform(-2.0F, 2.0F)};
        motion.spin_radps = dice_.below(2) == 0 ? 0.0F : dice_.uniform(-8.0F, 8.0F);
        return motion;
    }

    template <class Do>
    void both(World<Real>& one, World<Real>& other, Do what) {
        const Status did = what(one);
        EXPECT_EQ(what(other), did);
    }

    /// Of the box around the last particle: where what is added belongs.
    Vec2f lowest(const World<Real>& world) {
        const auto position = world.particle_positions();
        if (position.size == 0) {
            return {dice_.uniform(0.0F, 4.0F), dice_.uniform(0.0F, 2.0F)};
        }
        const auto last = position[position.size / 2];
        return {std::clamp(kCell * static_cast<float>(last.x) - 0.05F, 0.0F, 4.7F),
                std::clamp(kCell * static_cast<float>(last.y) - 0.05F, 0.0F, 2.8F)};
    }

    /// So that the rest fits: 49 × 33 cells about the middle one.
    void thin_out(World<Real>& one, World<Real>& other) {
        const auto position = one.particle_positions();
        if (position.size == 0) {
            return;
        }
        const auto middle = position[position.size / 2];
        for (std::int32_t k = one.particle_positions().size - 1; k >= 0; --k) {
            const auto at = one.particle_positions()[k];
            const float x = static_cast<float>(at.x) - static_cast<float>(middle.x);
            const float y = static_cast<float>(at.y) - static_cast<float>(middle.y);
            if ((kind_ != 4 && std::abs(x) > 24.0F) || (kind_ != 6 && std::abs(y) > 16.0F)) {
                both(one, other, [&](World<Real>& w) { return w.remove_particle(k); });
            }
        }
    }

    std::int32_t kind_;
    Dice dice_;
};

}  // namespace weir
