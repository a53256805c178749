// Calls at random, sane and absurd, of worlds of random definitions.
#pragma once

#include <limits>

#include "call_effects.hpp"
#include "random_def.hpp"
#include "weir/display.hpp"

namespace weir {

/// Now and then what no caller should say.
inline float number(Dice& dice, float low, float high) {
    using Limits = std::numeric_limits<float>;
    constexpr float kAbsurd[] = {Limits::quiet_NaN(), Limits::infinity(), -1e30F, 3e38F,
                                 -0.0F, Limits::denorm_min()};
    const float sane = dice.uniform(low, high);
    const float absurd = dice.one_of(kAbsurd);
    return dice.chance(0.02F) ? absurd : sane;
}

inline Vec2f vector(Dice& dice, float low, float high) {
    const float x = number(dice, low, high);
    return {x, number(dice, low, high)};
}

/// A body that there is, or was, or may be one day; or of another world.
template <class Real>
BodyId any_body(const World<Real>& world, Dice& dice, const RandomDef& random) {
    BodyId id;
    static_cast<void>(world.body_in_slot(dice.below(random.def.capacity.bodies + 1), &id));
    if (dice.chance(0.08F)) {
        switch (dice.below(4)) {
            case 0: ++id.generation; break;
            case 1: --id.generation; break;
            case 2: id.slot = static_cast<std::uint16_t>(dice.bits()); break;
            default: ++id.world; break;
        }
    }
    return id;
}

/// Of the tank.
inline Vec2f place(Dice& dice, const RandomDef& random, float share = 1.0F) {
    const Vec2f tank = random.tank_m();
    const float x = number(dice, 0.0F, share * tank.x);
    return {x, number(dice, 0.0F, share * tank.y)};
}

/// A star about its origin, in cells; now and then one that crosses itself, or lies within a line.
inline Ring star(Dice& dice) {
    const float outer = any_size(dice, 0.02F, dice.chance(0.2F) ? 300.0F : 6.0F);
    const float inner = dice.uniform(0.0F, 1.0F) * outer;
    const std::int32_t count = dice.integer(3, 12);
    const float turns = dice.chance(0.1F) ? 2.0F : 1.0F;
    const float flat = dice.chance(0.2F) ? any_size(dice, 1.0e-5F, 1.0F) : 1.0F;
    Ring ring;
    for (std::int32_t k = 0; k < count; ++k) {
        const float angle = turns * 6.2831853F / static_cast<float>(count) *
                            (static_cast<float>(k) + dice.uniform(0.0F, 0.8F));
        const float radius = dice.uniform(inner, outer);
        ring.push_back({radius * std::cos(angle), flat * radius * std::sin(angle)});
        if (dice.chance(0.05F)) {
            ring.push_back(ring.back());
        }
    }
    if (dice.chance(0.3F)) {
        std::reverse(ring.begin(), ring.end());
    }
    return ring;
}

/// In metres. Busy ones are made for cells of 2 cm.
inline Ring any_ring(Dice& dice, float cell_m) {
    const std::int32_t what = dice.below(10);
    Ring ring = what < 6 ? busy_ring(dice)
                         : (what < 8 ? star(dice)
                                     : Ring{vector(dice, -0.1F, 0.1F), {0.05F, 0.0F},
                                            {0.0F, 0.05F}});
    const float scale = what == 6 || what == 7 ? cell_m : cell_m / 0.02F;
    for (Vec2f& vertex : ring) {
        vertex = {vertex.x * scale, vertex.y * scale};
    }
    return ring;
}

inline Surface call_surface(Dice& dice, float fastest) {
    const float restitution = number(dice, 0, 1);
    const float friction = dice.chance(0.1F) ? number(dice, 0, 1000) : number(dice, 0, 1);
    return {restitution, friction, dice.chance(0.5F), number(dice, -fastest, fastest)};
}

/// Mostly what is sane; or up to the limits, and where nothing of it is in the tank.
inline void choose_motion(Dice& dice, const RandomDef& random, Motion& motion) {
    const float fastest = 0.5F * random.speed_mps;
    motion.velocity_mps = vector(dice, -fastest, fastest);
    motion.spin_radps = number(dice, -5.0F, 5.0F);
    if (dice.chance(0.05F)) {
        const Vec2f tank = random.tank_m();
        motion.position_m = vector(dice, -3.0F * (tank.x + tank.y), 3.0F * (tank.x + tank.y));
        motion.angle_rad = number(dice, -kMaxAngle, kMaxAngle);
        const float most = any_size(dice, 1.0F, kMaxSpeed) * random.def.cell_m;
        motion.velocity_mps = vector(dice, -most, most);
        motion.spin_radps = number(dice, -kMaxAngle, kMaxAngle);
    }
}

template <class Real>
Status add_some_body(World<Real>& world, Dice& dice, const RandomDef& random) {
    const float c = random.def.cell_m;
    const Ring ring = any_ring(dice, c);
    BodyDef def = body_of(ring, place(dice, random), number(dice, -3.0F, 3.0F));
    choose_motion(dice, random, def.motion);
    Ring hole = {{0.5F * c, 0.5F * c}, {1.5F * c, 0.5F * c}, {0.5F * c, 1.5F * c}};
    const View<Vec2f> holes[] = {{hole.data(), 3}, {hole.data(), 3}};
    def.holes = {holes, dice.chance(0.2F) ? dice.integer(1, 2) : 0};  // two are the same one
    def.open = dice.chance(0.1F);
    def.surface = call_surface(dice, 0.5F * random.speed_mps);
    def.density_ratio = dice.chance(0.1F) ? any_size(dice, 0.9e-3F, 1.1e3F)
                                          : number(dice, 0.1F, 3.0F);
    def.hold = static_cast<Hold>(dice.below(dice.chance(0.05F) ? 9 : 5));
    if (dice.chance(0.02F)) {
        def.polygon = {nullptr, 4};
    }
    BodyId id;
    Status status = Status::ok;
    switch (dice.below(3)) {
        case 0: status = world.add_static_body(def, &id); break;
        case 1: status = world.add_moving_body(def, &id); break;
        default: status = world.add_free_body(def, &id); break;
    }
    if (status == Status::ok) {
        expect_put(world, id, def.motion);
    }
    return status;
}

/// Set elsewhere, led, given another surface, or removed.
template <class Real>
Status change_some_body(World<Real>& world, Dice& dice, const RandomDef& random) {
    const BodyId id = any_body(world, dice, random);
    Motion motion;
    static_cast<void>(world.motion(id, &motion));
    const Motion before = motion;
    const float furthest = 1.5F * random.def.cell_m;
    const Vec2f way = vector(dice, -furthest, furthest);
    if (dice.chance(0.4F)) {
        choose_motion(dice, random, motion);
    }
    if (dice.chance(0.6F)) {
        motion.position_m = {before.position_m.x + way.x, before.position_m.y + way.y};
        motion.spin_radps = number(dice, -5.0F, 5.0F);
    }
    if (dice.chance(0.2F)) {
        motion.angle_rad = motion.angle_rad + number(dice, -4.0F, 4.0F);
    }
    const std::int32_t what = dice.below(4);
    Status status = Status::ok;
    switch (what) {
        case 0:
            status = world.set_motion(id, motion);
            if (status == Status::ok) {
                expect_put(world, id, motion);
            }
            return status;
        case 1: return world.move_body(id, motion.position_m, motion.angle_rad,
                                       dice.chance(0.1F) ? any_size(dice, 1e-12F, 1e6F)
                                                         : number(dice, 0.0F, 0.03F));
        case 2: return world.set_surface(id, call_surface(dice, 0.5F * random.speed_mps));
        default:
            status = world.remove_body(id);
            if (status == Status::ok) {
                EXPECT_EQ(world.motion(id, &motion), Status::stale_body);
            }
            return status;
    }
}

/// Somewhere in the tank, or all of it, which `fill` takes to its edge.
inline Box any_box(Dice& dice, const RandomDef& random) {
    const Vec2f low = place(dice, random, 0.8F);
    const Vec2f size = place(dice, random, dice.chance(0.5F) ? 0.3F : 0.6F);
    return dice.chance(0.05F) ? Box{{}, random.tank_m()}
                              : Box{low, {low.x + size.x, low.y + size.y}};
}

template <class Real>
Status change_liquid(World<Real>& world, Dice& dice, const RandomDef& random) {
    const Box box = any_box(dice, random);
    const float most = dice.chance(0.03F) ? kMaxSpeed * random.def.cell_m : random.speed_mps;
    const Vec2f speed = vector(dice, -most, most);
    const std::int32_t index = dice.below(world.particle_positions().size + 4) - 2;
    const auto tag = static_cast<std::uint8_t>(dice.below(256));
    const bool second = dice.chance(world.particle_kinds().data != nullptr ? 0.5F : 0.05F);
    const Liquid kind = second ? Liquid::second : Liquid::first;
    const auto of = static_cast<Liquids>(dice.chance(0.6F) ? 0 : dice.below(4));
    switch (dice.below(9)) {
        case 0: return add_and_look(world, box.min_m, speed, kind);
        case 1: return world.remove_particle(index);
        case 2: return drain_and_look(world, box, of);
        case 3: return stir_and_look(world, box, dice.chance(0.3F) ? Vec2f{} : speed,
                                     number(dice, 0.0F, 1.0F), of);
        case 4: return tag_and_look(world, box, tag, of);
        case 5: return world.tag_particle(index, tag);
        default: return fill_and_look(world, box, kind);
    }
}

/// From none to more than there can be.
template <class Real>
Status change_gravity(World<Real>& world, Dice& dice, const RandomDef& random) {
    const float pull = random.gravity_mps2;
    switch (dice.below(8)) {
        case 0: return world.set_gravity({});
        case 1: return world.set_gravity(vector(dice, -1.2F * kMaxGravity, 1.2F * kMaxGravity));
        case 2: {
            const float size = any_size(dice, 1.0e-9F, 1.0e9F);
            return world.set_gravity({dice.one_of({-size, 0.0F, size}), -size});
        }
        default: return world.set_gravity(vector(dice, -pull, pull));
    }
}

/// Any, whether the definition has some or none: for most worlds none is right, and it comes back.
template <class Real>
Status change_settings(World<Real>& world, Dice& dice, const RandomDef& random) {
    const WorldDef& def = random.def;
    const float c = def.cell_m;
    const float share = dice.chance(0.3F) ? 0.0F : any_size(dice, 1.0e-2F, 1.0e2F);
    const float fastest = 0.5F * random.speed_mps;
    TankWalls walls = def.walls;
    Surface* const sides[] = {&walls.bottom, &walls.right, &walls.top, &walls.left};
    for (Surface* side : sides) {
        *side = dice.chance(0.5F) ? call_surface(dice, fastest) : *side;
    }
    switch (dice.below(4)) {
        case 0:
            return world.set_viscosity(dice.chance(0.5F)
                                           ? share * def.viscosity_m2ps
                                           : c * c * any_size(dice, 1.0e-6F, 1.1e6F));
        case 1: return world.set_viscosity(number(dice, 0.0F, 10.0F * c * c));
        case 2:
            return world.set_surface_tension(
                dice.chance(0.5F) ? share * def.surface_tension_m3ps2
                                  : number(dice, 0.0F, 3.1e4F * c * c * c));
        default: return world.set_walls(dice.chance(0.2F) ? def.walls : walls);
    }
}

template <class Real>
Status call(World<Real>& world, Dice dice, const RandomDef& random) {
    switch (dice.below(10)) {
        case 0:
        case 1: return add_some_body(world, dice, random);
        case 2:
        case 3: return change_some_body(world, dice, random);
        case 4: return change_gravity(world, dice, random);
        case 5: return world.restore(&dice, sizeof dice);
        case 6: return change_settings(world, dice, random);
        default: return change_liquid(world, dice, random);
    }
}

/// The lowest rung that is sure to fit.
template <class Real>
void expect_rung(const World<Real>& world, float dt_s, std::int64_t work) {
    const std::int32_t rung = world.rung_within(dt_s, work);
    ASSERT_LT(rung, kRungs);
    WorkBound bound;
    expect_ok(world.work_bound(dt_s, &bound, rung));
    EXPECT_TRUE(bound.step <= work || rung == kRungs - 1);
    if (rung > 0) {
        expect_ok(world.work_bound(dt_s, &bound, rung - 1));
        EXPECT_GT(bound.step, work);
    }
}

/// What is told of bodies.
template <class Real>
void look_at_bodies(const World<Real>& world, Dice& dice, const RandomDef& random) {
    double sum = 0.0;
    BodyForce force;
    if (world.tank_force(&force) == Status::ok) {
        sum += static_cast<double>(force.impulse_m3ps.x) + static_cast<double>(force.dt_s);
    }
    for (std::int32_t slot = 0; slot < random.def.capacity.bodies; ++slot) {
        BodyId id;
        Motion motion;
        BodyMass mass;
        static_cast<void>(world.body_in_slot(slot, &id));
        if (world.force(id, &force) == Status::ok && world.mass(id, &mass) == Status::ok) {
            sum += static_cast<double>(force.impulse_m3ps.x + force.impulse_m3ps.y) +
                   static_cast<double>(force.angular_impulse_m4ps) +
                   static_cast<double>(mass.inertia_m4);
        }
        if (world.motion(id, &motion) == Status::ok) {
            sum += static_cast<double>(motion.position_m.x) +
                   static_cast<double>(motion.velocity_mps.y) +
                   static_cast<double>(motion.angle_rad) + static_cast<double>(motion.spin_radps);
        }
    }
    for (const Contact& contact : world.contacts()) {
        sum += static_cast<double>(contact.impulse_m3ps.x) +
               static_cast<double>(contact.place_m.y);
        EXPECT_GT(contact.blows, 0);
        EXPECT_LT(contact.body.slot, random.def.capacity.bodies);
    }
    EXPECT_EQ(sum - sum, 0.0);
    static_cast<void>(world.force(any_body(world, dice, random), &force));
}

/// All that may be asked and drawn; numbers are numbers.
template <class Real>
void look(World<Real>& world, Dice dice, const RandomDef& random) {
    Diagnostics sums;
    expect_ok(world.diagnose(&sums));
    double sum = sums.mass_m2 + sums.kinetic_energy_m4ps2 + sums.volume_m2;
    const auto density = world.density();
    const auto pressure = world.pressure();
    for (std::int32_t k = 0; k < density.columns * density.rows; ++k) {
        const std::int32_t i = k % density.columns;
        sum += static_cast<double>(density.at(i, k / density.columns)) +
               static_cast<double>(pressure.at(i, k / density.columns));
    }
    EXPECT_EQ(sum - sum, 0.0);
    LiquidIn found;
    const Vec2f low = place(dice, random);
    const Box corner{{-low.x, -low.y}, low};
    const auto of = static_cast<Liquids>(dice.below(4));
    if (world.liquid_in(corner, &found, of) == Status::ok) {
        expect_as_seen(world, corner, of, found);
    }
    look_at_bodies(world, dice, random);
    expect_rung(world, number(dice, 0.0F, 0.1F), dice.below(100000));
    std::byte room[100];
    EXPECT_NE(world.save(room, sizeof room), Status::ok);
    Display display;
    display.width = dice.integer(1, 60);
    display.height = dice.integer(1, 40);
    std::vector<std::uint8_t> pixels(
        static_cast<std::size_t>((display.width + 1) / 2 * display.height));
    display.pixels = pixels.data();
    const Vec2f size = place(dice, random, dice.one_of({0.1F, 1.0F, 1000.0F}));
    display.shown_m = {{low.x - size.x, low.y - size.y}, {low.x + size.x, low.y + size.y}};
    EXPECT_LT(draw(world, display).last, display.height);
}

}  // namespace weir
