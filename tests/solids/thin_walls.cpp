// Walls thinner than a cell: a plate of 0.05 cell and an open polyline hold a column of liquid,
// straight and leaning. Nothing passes, the level stays, and the dry side knows nothing of it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "measure/tank_def.hpp"
#include "problems.hpp"
#include "tank.hpp"
#include "weir/weir.hpp"

namespace solids {

namespace {

using weir::Vec2f;

constexpr float kCell = 0.02F;
constexpr float kFrame = 1.0F / 60.0F;

struct Wall {
    const char* name;
    bool open;
    float lean_rad;
    std::int32_t depth;        ///< of the column, cells
    std::int32_t other_depth;  ///< on the other side
};

/// Side of a particle as the wall's own line sees it: positive on the right of a leaning wall.
double side_of(const Wall& wall, double foot, Vec2f x) {
    const double dx = static_cast<double>(x.x) - foot;
    return dx * std::cos(static_cast<double>(wall.lean_rad)) +
           static_cast<double>(x.y) * std::sin(static_cast<double>(wall.lean_rad));
}

/// Height of the liquid at the end: area of the particles left of the wall over the column's
/// width there, by the trapezoid that the leaning wall cuts off.
struct Column {
    std::int32_t left = 0;
    std::int32_t right = 0;
    double mean_height = 0.0;  ///< twice the mean of y on the left: depth of a full column
};

template <class Real>
Column column_of(const Tank<Real>& tank, const Wall& wall, double foot) {
    Column column;
    double sum = 0.0;
    for (std::int32_t k = 0; k < tank->particle_positions().size; ++k) {
        const auto x = weir::convert<float>(tank->particle_positions()[k]);
        if (side_of(wall, foot, x) < 0.0) {
            ++column.left;
            sum += static_cast<double>(x.y);
        } else {
            ++column.right;
        }
    }
    column.mean_height = column.left > 0 ? 2.0 * sum / column.left : 0.0;
    return column;
}

template <class Real>
void hold(Report& report, const std::string& name, const Wall& wall, std::int32_t steps) {
    const std::int32_t rows = wall.depth + 12;
    weir::WorldDef def = measure::tank_def(48, rows, 4 * 48 * rows, 1, 8);
    def.cell_m = kCell;
    def.capacity.wall_edges = 700;
    Tank<Real> tank(def);
    const float foot = 20.37F;
    const float length = 1.5F * static_cast<float>(rows);
    const std::vector<Vec2f> plate = {{-0.025F * kCell, -length * kCell},
                                      {0.025F * kCell, -length * kCell},
                                      {0.025F * kCell, length * kCell},
                                      {-0.025F * kCell, length * kCell}};
    const std::vector<Vec2f> line = {{0, -length * kCell}, {0, 0.3F * kCell}, {0, length * kCell}};
    weir::BodyDef body;
    body.open = wall.open;
    const std::vector<Vec2f>& outline = wall.open ? line : plate;
    body.polygon = {outline.data(), static_cast<std::int32_t>(outline.size())};
    body.motion.position_m = {foot * kCell, 0.0F};
    body.motion.angle_rad = wall.lean_rad;
    weir::BodyId id;
    require(tank->add_static_body(body, &id));
    // Seeds on the side of the wall to which they belong.
    std::int32_t left = 0;
    std::int32_t right = 0;
    for (std::int32_t j = 0; j < 2 * wall.depth; ++j) {
        for (std::int32_t i = 0; i < 2 * 48; ++i) {
            const Vec2f at{0.5F * static_cast<float>(i) + 0.25F,
                           0.5F * static_cast<float>(j) + 0.25F};
            const double side = side_of(wall, static_cast<double>(foot), at);
            const bool on_left = side < -0.05;
            const bool on_right = side > 0.05 && j < 2 * wall.other_depth;
            if ((on_left || on_right) &&
                tank->add_particle({at.x * kCell, at.y * kCell}, {0, 0}) == weir::Status::ok) {
                (on_left ? left : right) += 1;
            }
        }
    }
    for (std::int32_t step = 0; step < 120; ++step) {
        tank->step(kFrame);
    }
    const Column before = column_of(tank, wall, static_cast<double>(foot));
    double worst = 0.0;
    std::int32_t removed = 0;
    float fastest = 0.0F;
    for (std::int32_t step = 120; step < steps; ++step) {
        const weir::StepReport done = tank->step(kFrame);
        removed += done.particles_removed_stuck;
        if (step % 50 == 0) {
            const Column now = column_of(tank, wall, static_cast<double>(foot));
            worst = std::max(worst, std::abs(now.mean_height / before.mean_height - 1.0));
        }
        fastest = step > steps - 100 ? std::max(fastest, done.max_speed_mps) : 0.0F;
    }
    const Column after = column_of(tank, wall, static_cast<double>(foot));
    report.equals(name + ".through", std::abs(after.left - left) + std::abs(after.right - right),
                  "particles", 0.0);
    report.equals(name + ".removed", removed, "particles", 0.0);
    report.at_most(name + ".level_change", 100.0 * worst, "%", 1.0);
    const double wave = std::sqrt(9.81 * static_cast<double>(kCell) * wall.depth);
    report.figure(name + ".speed_at_end", static_cast<double>(fastest) / wave, "sqrt(gh)");
}

}  // namespace

void thin_walls(Report& report, const Effort& effort) {
    constexpr float kLean = 17.3F * 3.14159265F / 180.0F;
    const Wall walls[] = {
        {"plate.straight", false, 0.0F, 32, 0},   {"plate.rotated", false, kLean, 32, 0},
        {"line.straight", true, 0.0F, 32, 0},     {"line.rotated", true, kLean, 32, 0},
        {"line.both_sides", true, 0.0F, 32, 16},  {"line.both_sides_rotated", true, kLean, 32, 16},
    };
    in_scalar(report, effort.real, [&](auto zero) {
        for (const Wall& wall : walls) {
            const std::string name = std::string("thin.") + wall.name;
            rows(report, name, [&] {
                hold<decltype(zero)>(report, name, wall, effort.full ? 100000 : 2000);
            });
        }
    });
}

}  // namespace solids
