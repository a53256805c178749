// R10 with walls that are bodies without slip: viscous liquid between two that move. Worlds with
// bodies are closed, so the plane channel is one whose ends are shut. Couette flow, u/U = 2y − 1, is
// between walls that move against each other: nothing flows on the whole. Past one that is at rest
// what the other drags along flows back, u/U = 3y² − 2y: half of what is 0.3 % there is that a
// particle knows the velocity between two faces as a straight line. Between a disc that turns and
// a ring flow goes round: u = Ar + B/r.
#include <cmath>

#include "math/vec2.hpp"
#include "measure/tank_def.hpp"
#include "problems.hpp"
#include "tank.hpp"

namespace solids {

namespace {

using Vec2d = weir::Vec2<double>;

constexpr double kCell = 1.0 / 64.0;
constexpr double kReynolds = 10.0;
constexpr int kGaps = 8;  // that a channel is long: within 1½ of an end flow is off by 2 permille
constexpr double kSettled = 0.24;  // of gap²/viscosity: what is not steady has fallen to 1e-4

/// Of a gap of so many cells whose wall goes a gap a second.
weir::WorldDef definition(int gap, int cells_x, int cells_y) {
    weir::WorldDef def = measure::tank_def(cells_x, cells_y, 4 * cells_x * cells_y, 2, 2048);
    def.cell_m = static_cast<float>(kCell);
    def.gravity_mps2 = {};
    def.capacity.two_way = true;
    def.max_substeps = 64;  // with 16 what 64 cells have of viscosity is limited
    def.viscosity_m2ps = static_cast<float>(gap * kCell * gap * kCell / kReynolds);
    return def;
}

weir::BodyDef sticky(const Ring& ring, double x, double y) {
    weir::BodyDef body = body_of(ring, x * kCell, y * kCell);
    body.surface.no_slip = true;
    return body;
}

/// Root of the mean square difference to a flow, over that of the flow; where `counts` says so.
template <class Real, class Flow, class Counts>
double difference(const Tank<Real>& tank, Flow flow, Counts counts) {
    double wrong = 0.0;
    double all = 0.0;
    for (int k = 0; k < tank->particle_positions().size; ++k) {
        const Vec2d x = tank.position(k);
        const Vec2d v = tank.velocity(k);
        if (counts(x)) {
            const Vec2d exact = flow(x);
            wrong += weir::dot(v - exact, v - exact);
            all += weir::dot(exact, exact);
        }
    }
    return 100.0 * std::sqrt(wrong / all);
}

template <class Real>
void simulate(Tank<Real>& tank, double seconds) {
    for (double time = 0.0; time < seconds;) {
        time += static_cast<double>(tank->step(1.0F / 60.0F).dt_s);
    }
}

/// Along the channel, over its speed, at a height of 0 … 1.
using Profile = double (*)(double);
constexpr Profile kCouette = [](double y) { return 2.0 * y - 1.0; };
constexpr Profile kFlowsBack = [](double y) { return 3.0 * y * y - 2.0 * y; };

/// In the middle of a channel whose bottom is at `floor`.
template <class Real>
double plane_error(const Tank<Real>& tank, int gap, double floor, Profile profile) {
    const auto flow = [&](Vec2d x) {
        return Vec2d{gap * profile((x.y - floor) / gap), 0.0};
    };
    return difference(tank, flow,
                      [&](Vec2d x) { return std::abs(x.x - 0.5 * kGaps * gap) < 0.5 * gap; });
}

/// Between walls of the tank, for what the rest of the scheme leaves.
template <class Real>
double between_tank_walls(int gap, Profile profile) {
    weir::WorldDef def = definition(gap, kGaps * gap, gap);
    def.walls.bottom.no_slip = true;
    def.walls.bottom.conveyor_mps = static_cast<float>(gap * kCell * profile(0.0));
    def.walls.top.no_slip = true;
    def.walls.top.conveyor_mps = static_cast<float>(-gap * kCell * profile(1.0));
    Tank<Real> tank(def);
    require(tank->fill({{0.0F, 0.0F},
                        {static_cast<float>(kGaps * gap * kCell), static_cast<float>(gap * kCell)}}));
    simulate(tank, kSettled * kReynolds);
    return plane_error(tank, gap, 0.0, profile);
}

/// Between bodies, neither on the grid's lines: belts 8 cells thick, or lines.
template <class Real>
double between_bodies(int gap, Profile profile, bool lines = false) {
    const double length = kGaps * gap;
    const double floor = 2.37;
    const double ceiling = floor + gap;
    const double half = lines ? 0.0 : 4.0;
    weir::WorldDef def = definition(gap, kGaps * gap, gap + 6);
    def.capacity.wall_edges = lines ? 37 * kGaps * gap + 100 : 0;
    Tank<Real> tank(def);
    Ring belt = rectangle(6.0 * length * kCell, 2.0 * half * kCell);
    belt.resize(lines ? 2 : 4);
    const auto add_belt = [&](double y, double speed) {
        weir::BodyDef moving = sticky(belt, 0.5 * length - 1.2 * gap * speed, y);
        moving.open = lines;
        moving.motion.velocity_mps = {static_cast<float>(gap * kCell * speed), 0.0F};
        weir::BodyId id;
        require(tank->add_moving_body(moving, &id));
    };
    add_belt(floor - half, profile(0.0));
    add_belt(ceiling + half, profile(1.0));
    require(tank->fill({{0.0F, static_cast<float>(floor * kCell)},
                        {static_cast<float>(length * kCell), static_cast<float>(ceiling * kCell)}}));
    simulate(tank, kSettled * kReynolds);
    return plane_error(tank, gap, floor, profile);
}

template <class Real>
void plane(Report& report, int gap) {
    const std::string n = std::to_string(gap);
    accurate<Real>(report, "R10.couette.velocity_error." + n,
                   between_bodies<Real>(gap, kCouette), "%", gap > 16 ? 0.2 : 0.8);
    report.figure("R10.couette.the_same_between_tank_walls." + n,
                  between_tank_walls<Real>(gap, kCouette), "%");
    if (kThinWalls<Real>) {
        report.figure("R10.couette.the_same_between_lines." + n,
                      between_bodies<Real>(gap, kCouette, true), "%");
    }
    accurate<Real>(report, "R10.flow_back.velocity_error." + n,
                   between_bodies<Real>(gap, kFlowsBack), "%", gap > 16 ? 0.4 : 1.2);
    report.figure("R10.flow_back.the_same_between_tank_walls." + n,
                  between_tank_walls<Real>(gap, kFlowsBack), "%");
}

Ring circle(double radius, int corners) {
    Ring ring;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * M_PI * k / corners;
        ring.push_back({static_cast<float>(radius * kCell * std::cos(angle)),
                        static_cast<float>(radius * kCell * std::sin(angle))});
    }
    return ring;
}

template <class Real>
void annulus(Report& report, int gap) {
    const double inner = 0.5 * gap;
    const double outer = inner + gap;
    const int side = static_cast<int>(2.0 * outer) + 8;
    const Vec2d centre{0.5 * side + 0.21, 0.5 * side - 0.13};
    Tank<Real> tank(definition(gap, side, side));
    const Ring disc = circle(inner, 256);
    const Ring hole = circle(outer, 512);
    const Ring frame = rectangle(2.0 * side * kCell, 2.0 * side * kCell);
    const weir::View<weir::Vec2f> holes[] = {
        {hole.data(), static_cast<std::int32_t>(hole.size())}};
    weir::BodyId id;
    weir::BodyDef ring = sticky(frame, centre.x, centre.y);
    ring.holes = {holes, 1};
    require(tank->add_static_body(ring, &id));
    weir::BodyDef turning = sticky(disc, centre.x, centre.y);
    const double spin = gap / inner;
    turning.motion.spin_radps = static_cast<float>(spin);
    require(tank->add_moving_body(turning, &id));
    const auto room = static_cast<float>(side * kCell);
    require(tank->fill({{0.0F, 0.0F}, {room, room}}));
    simulate(tank, 1.0 * kReynolds);
    const double wide = outer * outer - inner * inner;
    const double a = -spin * inner * inner / wide;
    const double b = spin * inner * inner * outer * outer / wide;
    const auto flow = [&](Vec2d x) {
        const Vec2d r = x - centre;
        return (a + b / weir::dot(r, r)) * Vec2d{-r.y, r.x};
    };
    const std::string n = std::to_string(gap);
    // Flow along circles is stirred by the straight lines it is known along: bounds, no targets.
    accurate<Real>(report, "R10.annulus.velocity_error." + n,
                   difference(tank, flow, [](Vec2d) { return true; }), "%", gap > 16 ? 2.0 : 3.5);
    // Torque on the disc, 4πνB over the density; means of a second.
    double torque = 0.0;
    double time = 0.0;
    while (time < 1.0) {
        time += static_cast<double>(tank->step(1.0F / 60.0F).dt_s);
        weir::BodyForce force;
        require(tank->force(id, &force));
        torque += static_cast<double>(force.angular_impulse_m4ps);
    }
    const double viscosity = gap * gap / kReynolds;
    const double exact = -4.0 * M_PI * viscosity * b * kCell * kCell * kCell * kCell;
    accurate<Real>(report, "R10.annulus.torque_on_the_disc_error." + n,
                   100.0 * std::abs(torque / time / exact - 1.0), "%", gap > 16 ? 5.0 : 10.0);
}

}  // namespace

void couette(Report& report, const Effort& effort) {
    at_resolutions(report, effort, {16, 32, 64}, [&](auto zero, int gap) {
        using Real = decltype(zero);
        const std::string n = "." + std::to_string(gap);
        rows(report, "R10.channel" + n, [&] { plane<Real>(report, gap); });
        rows(report, "R10.annulus" + n, [&] { annulus<Real>(report, gap); });
    });
}

}  // namespace solids
