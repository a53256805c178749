#include "random_scene.hpp"

#include <algorithm>
#include <cmath>

namespace stability {

using weir::Vec2f;

namespace {

constexpr float kPi = 3.14159265F;
constexpr std::int32_t kMostParticles = 1200;

/// Star-shaped about its origin, 3 to 12 vertices counter-clockwise, not convex as a rule.
Ring random_ring(Random& random, float largest) {
    const std::int32_t count = random.integer(3, 12);
    const float outer = random.uniform(0.4F, largest);
    const float inner = random.uniform(0.2F, 1.0F) * outer;
    const float turn = random.uniform(0.0F, 2.0F * kPi);
    Ring ring;
    for (std::int32_t k = 0; k < count; ++k) {
        const float angle = turn + 2.0F * kPi / static_cast<float>(count) *
                                       (static_cast<float>(k) + random.uniform(0.0F, 0.8F));
        const float radius = random.uniform(inner, outer);
        ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return ring;
}

/// What a program would choose, or anything that the world accepts.
void choose_quality(Random& random, bool tame, weir::WorldDef& def) {
    if (tame) {
        def.particles_per_cell = random.one_of({4, 4, 9, 16});
        def.cfl = random.uniform(0.3F, 1.0F);
        def.max_substeps = random.one_of({16, 32});
        def.pressure_sweeps = random.one_of({8, 16, 40});
        def.flip_ratio = random.one_of({0.9F, 0.95F, 0.97F, 0.99F});
    } else {
        def.particles_per_cell = random.one_of({1, 4, 9, 16});
        def.cfl = random.uniform(0.1F, 2.0F);
        def.max_substeps = random.one_of({1, 4, 16, 32});
        def.pressure_sweeps = random.one_of({1, 2, 4, 8, 16, 40});
        def.flip_ratio = random.one_of({0.0F, 0.5F, 0.9F, 0.97F, 1.0F});
    }
}

void choose_settings(Random& random, RandomScene& scene) {
    weir::WorldDef& def = scene.def;
    def.volume_gain = random.one_of({0.0F, 0.25F, 0.25F, 1.0F});
    weir::Surface wall;
    wall.restitution = random.chance(0.3F) ? random.uniform(0.0F, 1.0F) : 0.0F;
    wall.no_slip = random.chance(0.3F);
    def.walls = weir::every_wall(wall);
    def.sound_speed_mps = scene.scheme.elastic() ? random.uniform(2.0F, 20.0F) : 0.0F;
    if (random.chance(0.3F)) {
        const float amount = std::exp(random.uniform(-4.0F, 4.0F));  // ν dt, cells²
        def.viscosity_m2ps = amount * kCell * kCell / kFrame;
    }
    const float strength = random.chance(0.1F) ? 0.0F : random.uniform(1.0F, 30.0F);
    const float angle = random.chance(0.5F) ? -0.5F * kPi : random.uniform(0.0F, 2.0F * kPi);
    def.gravity_mps2 = {strength * std::cos(angle), strength * std::sin(angle)};
}

void choose_liquid(Random& random, RandomScene& scene) {
    const auto width = static_cast<float>(scene.def.capacity.cells_x);
    const auto height = static_cast<float>(scene.def.capacity.cells_y);
    scene.liquid_overlaps = !scene.tame && random.chance(0.3F);
    // Side by side, so that none overlaps; or anywhere.
    const std::int32_t boxes = random.integer(1, 4);
    const float column = width / static_cast<float>(boxes);
    // Boxes are cut so that all of them together stay small enough.
    const float share = std::min(
        1.0F, std::sqrt(static_cast<float>(kMostParticles / scene.def.particles_per_cell) /
                        (width * height)));
    for (std::int32_t k = 0; k < boxes; ++k) {
        const float left =
            scene.liquid_overlaps ? random.uniform(0.0F, width - column)
                                  : column * static_cast<float>(k);
        const float w = share * column * random.uniform(0.2F, 1.0F);
        const float h = share * height * random.uniform(0.2F, 1.0F);
        const float x = left + random.uniform(0.0F, column - w);
        const float y = random.uniform(0.0F, height - h);
        scene.liquid.push_back({{x, y}, {x + w, y + h}});
    }
}

void choose_solids(Random& random, RandomScene& scene) {
    const auto width = static_cast<float>(scene.def.capacity.cells_x);
    const auto height = static_cast<float>(scene.def.capacity.cells_y);
    const std::int32_t standing = random.chance(0.25F) ? 0 : random.integer(0, 6);
    const std::int32_t moving = random.chance(0.5F) ? 0 : random.integer(1, 3);
    const float largest = 0.35F * std::min(width, height);
    for (std::int32_t k = 0; k < standing + moving; ++k) {
        Polygon solid;
        solid.ring = random_ring(random, largest);
        solid.at = {random.uniform(0.0F, width), random.uniform(0.0F, height)};
        solid.restitution = random.chance(0.3F) ? random.uniform(0.0F, 1.0F) : 0.0F;
        solid.moving = k >= standing;
        if (solid.moving) {
            const float fastest = random.one_of({3.0F, 30.0F, 30.0F, 300.0F});
            solid.velocity = {random.uniform(-fastest, fastest), random.uniform(-fastest, fastest)};
            solid.spin = random.uniform(-0.5F * fastest, 0.5F * fastest);
            solid.teleports = random.chance(0.3F);
        }
        scene.solids.push_back(solid);
    }
    scene.solids_late = !scene.tame && random.chance(0.2F);
}

}  // namespace

bool RandomScene::any_moving() const {
    return std::any_of(solids.begin(), solids.end(), [](const Polygon& p) { return p.moving; });
}

bool RandomScene::energy_only_falls() const {
    return solids_stand() && !liquid_overlaps;
}

std::string RandomScene::text() const {
    char line[400];
    const auto moving = std::count_if(solids.begin(), solids.end(),
                                      [](const Polygon& p) { return p.moving; });
    std::snprintf(line, sizeof line,
                  "seed=%llu %s%s %dx%d ppc %d, %zu boxes%s, %zu solids (%d moving)%s, gravity "
                  "(%.3g %.3g)%s, nu %.3g, cfl %.3g, sub %d, sweeps %d, flip %g, gain %g, "
                  "restitution %.2g%s, sound %.3g, dt %.3g +-%.2g, %d steps",
                  static_cast<unsigned long long>(seed), scheme.name().c_str(),
                  is_double ? " double" : "", def.capacity.cells_x, def.capacity.cells_y,
                  def.particles_per_cell, liquid.size(), liquid_overlaps ? " overlapping" : "",
                  solids.size(), static_cast<int>(moving), solids_late ? " late" : "",
                  static_cast<double>(def.gravity_mps2.x), static_cast<double>(def.gravity_mps2.y),
                  gravity_changes ? " changing" : "", static_cast<double>(def.viscosity_m2ps),
                  static_cast<double>(def.cfl), def.max_substeps, def.pressure_sweeps,
                  static_cast<double>(def.flip_ratio), static_cast<double>(def.volume_gain),
                  static_cast<double>(def.walls.left.restitution),
                  def.walls.left.no_slip ? " no slip" : "",
                  static_cast<double>(def.sound_speed_mps), static_cast<double>(dt_s),
                  static_cast<double>(jitter), steps);
    return line;
}

RandomScene random_scene(std::uint64_t seed) {
    Random random(seed);
    RandomScene scene;
    scene.seed = seed;
    scene.scheme.pressure = random.chance(0.5F) ? weir::Pressure::projection
                                                : weir::Pressure::equation_of_state;
    scene.tame = random.chance(0.5F);
    scene.scheme.contour = scene.tame || random.chance(0.5F) ? weir::Contour::interpolated
                                                             : weir::Contour::mid_edge;
    scene.is_double = random.chance(0.2F);
    // Small tanks more often than large ones.
    const auto side = [&] {
        const float towards_small = std::pow(random.uniform(0.0F, 1.0F), 1.5F);
        return static_cast<std::int32_t>(8.0F * std::exp2(3.0F * towards_small));
    };
    const std::int32_t cells_x = side();
    const std::int32_t cells_y = side();
    scene.def = tank_def(scene.scheme, cells_x, cells_y, 8 * kMostParticles, 9, 108);
    choose_quality(random, scene.tame, scene.def);
    choose_settings(random, scene);
    choose_liquid(random, scene);
    choose_solids(random, scene);
    scene.gravity_changes = !scene.tame && random.chance(0.5F);
    scene.dt_s = kFrame * random.one_of({0.1F, 0.5F, 1.0F, 1.0F, 2.0F, 6.0F});
    scene.jitter = random.chance(0.5F) ? random.uniform(0.0F, 0.9F) : 0.0F;
    scene.steps = random.integer(100, 300);
    // Packed worlds alone have a use for it.
    scene.def.top_speed_mps = kCell * random.one_of({0.0F, 100.0F, 500.0F, 2000.0F});
    return scene;
}

}  // namespace stability
