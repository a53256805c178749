// What calls must have done, told from the views and from what may be asked.
#pragma once

#include <cmath>

#include "test_world.hpp"

namespace weir {

/// How a world's numbers round, cells: edges of boxes and places in the views.
constexpr double kRounded = 0.008;
/// As far from the tank's walls particles are put at least, and digits are no finer, cells.
constexpr double kPlaced = 0.025;
/// The same of velocities, in units of the views.
template <class Real>
constexpr float kLastDigit = std::is_same_v<Real, SmallFixed> ? 1.0F / 128.0F : 1e-3F;

/// Whether a particle is of the liquids that a call is about.
template <class Real>
bool is_of(const World<Real>& world, std::int32_t k, Liquids of) {
    const auto kinds = world.particle_kinds();
    const bool second = kinds.size > 0 && kinds[k] == Liquid::second;
    return of == Liquids::all || (of == Liquids::second) == second;
}

/// Whether a particle is in a box that is larger by so much on each side, cells.
template <class Real>
bool is_in(const World<Real>& world, std::int32_t k, const Box& box_m, double more) {
    const auto cell = static_cast<double>(world.cell_m());
    const auto at = world.particle_positions()[k];
    const auto within = [&](double place, float low, float high) {
        return place >= static_cast<double>(low) / cell - more &&
               place < static_cast<double>(high) / cell + more;
    };
    return within(static_cast<double>(at.x), box_m.min_m.x, box_m.max_m.x) &&
           within(static_cast<double>(at.y), box_m.min_m.y, box_m.max_m.y);
}

/// What the views show in a box, in cells and in units of their velocities.
struct Seen {
    std::int32_t count = 0;
    Vec2<double> place;
    Vec2<double> velocity;
};

template <class Real>
Seen seen_in(const World<Real>& world, const Box& box_m, Liquids of, double more) {
    const auto positions = world.particle_positions();
    const auto velocities = world.particle_velocities();
    Seen seen;
    for (std::int32_t k = 0; k < positions.size; ++k) {
        if (is_of(world, k, of) && is_in(world, k, box_m, more)) {
            ++seen.count;
            seen.place.x += static_cast<double>(positions[k].x);
            seen.place.y += static_cast<double>(positions[k].y);
            seen.velocity.x += static_cast<double>(velocities[k].x);
            seen.velocity.y += static_cast<double>(velocities[k].y);
        }
    }
    return seen;
}

/// Fastest component in the views, m/s.
template <class Real>
float fastest_particle(const World<Real>& world) {
    float most = 0.0F;
    for (const auto& v : world.particle_velocities()) {
        most = std::fmax(most, std::fmax(std::fabs(static_cast<float>(v.x)),
                                         std::fabs(static_cast<float>(v.y))));
    }
    return most * world.velocity_scale();
}

/// What is found in a box is what the views show there.
template <class Real>
void expect_as_seen(const World<Real>& world, const Box& box_m, Liquids of,
                    const LiquidIn& found) {
    const Seen most = seen_in(world, box_m, of, kRounded);
    const Seen least = seen_in(world, box_m, of, -kRounded);
    EXPECT_GE(found.particles, least.count);
    EXPECT_LE(found.particles, most.count);
    if (most.count != least.count || most.count == 0) {
        return;
    }
    const double share = 1.0 / most.count;
    const auto cell = static_cast<double>(world.cell_m());
    const double scale = static_cast<double>(world.velocity_scale()) * share;
    const double fine = 1e-3 * static_cast<double>(world.velocity_scale()) +
                        1e-4 * static_cast<double>(fastest_particle(world));
    EXPECT_NEAR(found.centroid_m.x, cell * share * most.place.x, 0.01 * cell);
    EXPECT_NEAR(found.centroid_m.y, cell * share * most.place.y, 0.01 * cell);
    EXPECT_NEAR(found.velocity_mps.x, scale * most.velocity.x, fine);
    EXPECT_NEAR(found.velocity_mps.y, scale * most.velocity.y, fine);
}

/// `World::fill`, and what it added.
template <class Real>
Status fill_and_look(World<Real>& world, const Box& box, Liquid kind) {
    const std::int32_t before = world.particle_positions().size;
    std::int32_t added = 0;
    const Status status = world.fill(box, &added, kind);
    if (status == Status::ok) {
        EXPECT_EQ(world.particle_positions().size, before + added);
        for (std::int32_t k = before; k < before + added; ++k) {
            EXPECT_TRUE(is_in(world, k, box, kPlaced));
            EXPECT_TRUE(is_of(world, k,
                              kind == Liquid::second ? Liquids::second : Liquids::first));
        }
    }
    return status;
}

template <class Real>
Status add_and_look(World<Real>& world, Vec2f at, Vec2f speed, Liquid kind) {
    const std::int32_t before = world.particle_positions().size;
    const Status status = world.add_particle(at, speed, kind);
    if (status == Status::ok) {
        EXPECT_EQ(world.particle_positions().size, before + 1);
        EXPECT_TRUE(is_in(world, before, {at, at}, kPlaced));
        const auto v = world.particle_velocities()[before];
        const float fine = kLastDigit<Real> * world.velocity_scale() +
                           1e-5F * (std::fabs(speed.x) + std::fabs(speed.y));
        EXPECT_NEAR(static_cast<float>(v.x) * world.velocity_scale(), speed.x, fine);
        EXPECT_NEAR(static_cast<float>(v.y) * world.velocity_scale(), speed.y, fine);
    }
    return status;
}

template <class Real>
Status drain_and_look(World<Real>& world, const Box& box, Liquids of) {
    const std::int32_t before = world.particle_positions().size;
    std::int32_t removed = 0;
    const Status status = world.drain(box, &removed, of);
    LiquidIn left;
    if (status == Status::ok) {
        EXPECT_EQ(world.particle_positions().size, before - removed);
        expect_ok(world.liquid_in(box, &left, of));
        EXPECT_EQ(left.particles, 0);
    }
    return status;
}

/// The mean velocity has gone its share of the way.
template <class Real>
Status stir_and_look(World<Real>& world, const Box& box, Vec2f speed, float share, Liquids of) {
    LiquidIn before;
    LiquidIn after;
    const bool known = world.liquid_in(box, &before, of) == Status::ok;
    const float fastest = fastest_particle(world) + std::fabs(speed.x) + std::fabs(speed.y);
    const bool calms = speed.x == 0.0F && speed.y == 0.0F;
    const Status status = world.stir(box, speed, share, of);
    if (status == Status::ok && known && !calms) {  // who sleeps is not calmed
        expect_ok(world.liquid_in(box, &after, of));
        EXPECT_EQ(after.particles, before.particles);
        const float fine =
            2.0F * kLastDigit<Real> * world.velocity_scale() + 1e-4F * fastest;
        const auto gone = [&](float from, float to) {
            return before.particles > 0 ? from + share * (to - from) : 0.0F;
        };
        EXPECT_NEAR(after.velocity_mps.x, gone(before.velocity_mps.x, speed.x), fine);
        EXPECT_NEAR(after.velocity_mps.y, gone(before.velocity_mps.y, speed.y), fine);
    }
    return status;
}

template <class Real>
Status tag_and_look(World<Real>& world, const Box& box, std::uint8_t tag, Liquids of) {
    const auto tags = world.particle_tags();
    const std::vector<std::uint8_t> before(tags.begin(), tags.end());
    const Status status = world.tag(box, tag, of);
    for (std::int32_t k = 0; status == Status::ok && k < tags.size; ++k) {
        const bool asked = is_of(world, k, of);
        if (asked && is_in(world, k, box, -kRounded)) {
            EXPECT_EQ(tags[k], tag);
        } else if (!asked || !is_in(world, k, box, kRounded)) {
            EXPECT_EQ(tags[k], before[static_cast<std::size_t>(k)]);
        }
    }
    return status;
}

/// A body that was put somewhere is there.
template <class Real>
void expect_put(const World<Real>& world, BodyId id, const Motion& asked) {
    Motion now;
    expect_ok(world.motion(id, &now));
    const auto near = [](float a, float b, float cell) {
        EXPECT_NEAR(a, b, 1e-4F * cell + 1e-6F * std::fabs(b));
    };
    near(now.position_m.x, asked.position_m.x, world.cell_m());
    near(now.position_m.y, asked.position_m.y, world.cell_m());
    const double off = static_cast<double>(now.angle_rad) - static_cast<double>(asked.angle_rad);
    EXPECT_NEAR(std::remainder(off, 6.283185307179586), 0.0, 2e-3);
}

}  // namespace weir
