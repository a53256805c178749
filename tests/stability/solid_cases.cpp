// S6, S7, S8: liquid meets solids that are hard to meet.
#include <cmath>

#include "cases.hpp"

namespace stability {

using weir::BodyId;
using weir::Status;
using weir::StepReport;
using weir::Vec2f;

namespace {

constexpr double kPi = 3.14159265358979323846;

Ring box(float x0, float y0, float x1, float y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// A star of so many points about the origin, radii in turn.
Ring star(std::int32_t vertices, double inner, double outer) {
    Ring ring;
    for (std::int32_t k = 0; k < vertices; ++k) {
        const double angle = 2.0 * kPi * k / vertices;
        const double radius = k % 2 == 0 ? outer : inner;
        ring.push_back({static_cast<float>(radius * std::cos(angle)),
                        static_cast<float>(radius * std::sin(angle))});
    }
    return ring;
}

struct Shape {
    const char* name;
    Ring ring;
    Vec2f at;
    Status expected;
};

std::vector<Shape> shapes() {
    const float nan = std::nanf("");
    const Vec2f middle{12, 8};
    return {
        {"zero_area", {{0, 0}, {4, 4}, {8, 8}}, middle, Status::polygon_zero_area},
        {"repeated_vertex", {{0, 0}, {4, 0}, {4, 0}, {0, 4}}, middle, Status::ok},
        {"closed_ring", {{0, 0}, {4, 0}, {0, 4}, {0, 0}}, middle, Status::ok},
        {"self_crossing", {{0, 0}, {4, 4}, {5, 0}, {0, 5}}, middle, Status::polygon_crosses_itself},
        {"hole_by_a_slit",
         {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {2, 2}, {2, 6}, {6, 6}, {6, 2}, {2, 2}},
         middle, Status::polygon_crosses_itself},
        {"clockwise", {{0, 0}, {0, 4}, {4, 0}}, middle, Status::ok},
        {"two_vertices", {{0, 0}, {4, 0}}, middle, Status::polygon_too_few_vertices},
        {"nan_vertex", {{0, 0}, {4, nan}, {0, 4}}, middle, Status::polygon_not_finite},
        {"outside", star(5, 2, 2), {60, 8}, Status::polygon_outside_domain},
        {"far_outside", star(5, 2, 2), {3e6F, 8}, Status::position_out_of_range},
        {"partly_outside", star(7, 6, 6), {24, 4}, Status::ok},
        {"ten_thousand_vertices", star(10000, 4.0, 4.0), middle, Status::ok},
        {"ten_thousand_teeth", star(10000, 3.5, 4.5), middle, Status::ok},
        {"star", star(24, 1.5, 5.5), middle, Status::ok},
        {"vertices_on_nodes", box(-4, -3, 4, 3), {12, 7}, Status::ok},
        {"edges_on_faces", box(-4.5F, -2.5F, 4.5F, 2.5F), {12, 7}, Status::ok},
        {"one_cell_on_a_node", box(-0.5F, -0.5F, 0.5F, 0.5F), {12, 7}, Status::ok},
        {"one_cell_on_nodes", box(0, 0, 1, 1), {12, 7}, Status::ok},
        {"thin_bar", box(-6, -0.2F, 6, 0.2F), {12.03F, 7.4F}, Status::ok},
        {"needle", {{-6, 0}, {6, -0.01F}, {6, 0.01F}}, {12, 7.6F}, Status::ok},
        {"thick_cup", {{-7, -5}, {7, -5}, {7, 4}, {4.9F, 4}, {4.9F, -2.9F}, {-4.9F, -2.9F},
                       {-4.9F, 4}, {-7, 4}}, {12.3F, 5.2F}, Status::ok},
        {"thin_cup", {{-6, -4}, {6, -4}, {6, 4}, {4.9F, 4}, {4.9F, -2.9F}, {-4.9F, -2.9F},
                      {-4.9F, 4}, {-6, 4}}, {12.3F, 5.2F}, Status::ok},
        {"larger_than_the_tank_but_a_slot",
         {{-1, -1}, {25, -1}, {25, 25}, {14.5F, 25}, {14.5F, 3}, {9.5F, 3}, {9.5F, 25}, {-1, 25}},
         {0, 0}, Status::ok},
    };
}

template <class Real>
void pour_over(Report& report, const Scheme& scheme, const Shape& shape, float angle) {
    const std::string name = label<Real>("S7", scheme) + "." + shape.name;
    Tank<Real> tank(tank_def(scheme, 24, 24, 400, 1, 10000));
    Ring metres;
    for (const Vec2f p : shape.ring) {
        metres.push_back({p.x * kCell, p.y * kCell});
    }
    weir::BodyDef def;
    def.polygon = {metres.data(), static_cast<std::int32_t>(metres.size())};
    def.motion.position_m = {shape.at.x * kCell, shape.at.y * kCell};
    const std::uint64_t before = tank.world().state_hash();
    BodyId id;
    const Status status = tank.world().add_static_body(def, &id);
    if (shape.expected != Status::ok || status != Status::ok) {
        report.holds(name + ".status", status == shape.expected);
        report.holds(name + ".changes_nothing", tank.world().state_hash() == before);
        return;
    }
    if (tank.world().remove_body(id) != Status::ok) {
        report.holds(name + ".removed", false);
        return;
    }
    tank.add_static(shape.ring, shape.at, angle);
    tank.fill(8, 13, 16, 23);
    tank.run(scheme.elastic() ? 600 : 300, scheme.dt_s());
    report.run(name + (angle != 0.0F ? ".turned" : ""), tank.tally(), bounds_of(scheme));
}

template <class Real>
void squeeze(Report& report, const Scheme& scheme, float to_share) {
    constexpr float kLength = 20.0F;
    Tank<Real> tank(tank_def(scheme, 24, 12, 4 * 20 * 12, 1, 4));
    const BodyId piston = tank.add_moving(box(-8, -2, 4, 14), {0, 0}, {0, 0}, 0);
    tank.fill(4, 0, 24, 12);
    const float way = kLength * (1.0F - to_share);
    constexpr float kSeconds = 1.0F;
    const auto steps = static_cast<std::int32_t>(kSeconds / scheme.dt_s());
    const auto go = [&](float from, float velocity) {
        tank.move(piston, {from, 0}, {velocity, 0}, 0, 0);
        tank.run(steps, scheme.dt_s());
    };
    go(0, way / kSeconds);
    go(way, 0);
    const std::string name = label<Real>("S8", scheme) + (to_share > 0.9F ? ".to_95" : ".to_50");
    report.figure(name + ".most_in_a_cell", tank.highest_density(), "of full");
    const double rms = tank.rms_speed();
    const double sound = static_cast<double>(10.0F / kCell);
    report.figure(name + ".rms_speed_while_squeezed", rms, "cells/s");
    go(way, -way / kSeconds);
    go(0, 0);
    report.run(name, tank.tally(), kOnlyKept);
    report.figure(name + ".deepest_in_the_piston", tank.tally().deepest, "cells");
    report.at_most(name + ".fastest", tank.tally().fastest, "cells/s", sound);
}

}  // namespace

void jet_into_wedge(Report& report, const Effort& effort) {
    const float half = 20.0F * static_cast<float>(std::tan(5.0 * kPi / 180.0));
    each_scheme(effort.scalar, true, true, [&](const Scheme& scheme, auto real) {
        using Real = decltype(real);
        for (const float shift : {0.0F, 0.3F}) {
            weir::WorldDef def = tank_def(scheme, 33, 44, 400, 2, 10);
            def.top_speed_mps = 2000.0F * kCell;
            Tank<Real> tank(def);
            const float apex = 16.5F + shift;
            tank.add_static({{-1, -1}, {apex, -1}, {apex, 0}, {apex - half, 20}, {-1, 20}}, {0, 0});
            tank.add_static({{apex, -1}, {34, -1}, {34, 20}, {apex + half, 20}, {apex, 0}}, {0, 0});
            tank.fill_moving(15, 22, 18, 42, {0, -300});
            tank.run(scheme.elastic() ? 1200 : 300, scheme.dt_s());
            const std::string name = label<Real>("S6", scheme) + (shift > 0 ? ".shifted" : "");
            report.run(name, tank.tally(), bounds_of(scheme));
        }
    });
}

void hostile_polygons(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, true, effort.full, [&](const Scheme& scheme, auto real) {
        for (const Shape& shape : shapes()) {
            pour_over<decltype(real)>(report, scheme, shape, 0.0F);
            if (shape.expected == Status::ok && shape.at.y < 8.5F && shape.at.x > 0) {
                pour_over<decltype(real)>(report, scheme, shape, 0.37F);
            }
        }
    });
}

void squeezing_body(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, true, true, [&](const Scheme& scheme, auto real) {
        squeeze<decltype(real)>(report, scheme, 0.95F);
        squeeze<decltype(real)>(report, scheme, 0.5F);
    });
}

}  // namespace stability
