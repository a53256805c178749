// R1: one particle meets a half plane at any angle. Exact: a straight line, and the mirrored
// velocity.
#include <cmath>
#include <vector>

#include "measure/tank_def.hpp"
#include "problems.hpp"
#include "vessel.hpp"

namespace solids {

namespace {

constexpr int kCells = 64;
constexpr double kSpeed = 16.0;  // cells/s: a quarter of a cell a step

struct Contact {
    double angle_error = 0.0;  ///< deg
    double loss = 0.0;         ///< of the speed along the wall
    double penetration = 0.0;  ///< cells
    double stand_off = 0.0;    ///< distance at which the velocity first changes, cells
    bool happened = false;
};

/// A wall whose face goes through the middle of the tank and whose normal is n.
Points half_plane(Vec n) {
    const Vec middle{0.5 * kCells + 0.13, 0.5 * kCells - 0.29};
    const Vec along{-n.y, n.x};
    const double far = 2.0 * kCells;
    return {middle + far * along, middle + far * along - far * n, middle - far * along - far * n,
            middle - far * along};
}

template <class Real>
class Flight {
public:
    Flight(Vec n, weir::Contour contour, int particles_per_cell)
        : n_(n), tank_(definition(contour, particles_per_cell)) {
        std::vector<weir::Vec2f> ring;
        for (const Vec p : half_plane(n)) {
            ring.push_back({static_cast<float>(p.x) * kCell_m, static_cast<float>(p.y) * kCell_m});
        }
        weir::BodyDef body;
        body.polygon = {ring.data(), 4};
        body.surface.restitution = 1.0F;
        weir::BodyId id;
        require(tank_->add_static_body(body, &id));
    }

    static weir::WorldDef definition(weir::Contour contour, int particles_per_cell) {
        weir::WorldDef def = measure::tank_def(kCells, kCells, 1, 1, 4);
        def.cell_m = kCell_m;
        def.contour = contour;
        def.particles_per_cell = particles_per_cell;
        def.gravity_mps2 = {};
        def.top_speed_mps = 1.25F * static_cast<float>(kSpeed) * kCell_m;
        return def;
    }

    /// A particle from ten cells off, at that angle to the normal.
    Contact fly(double incidence) {
        Contact contact;
        const Vec along{-n_.y, n_.x};
        const Vec v = kSpeed * (std::sin(incidence) * along - std::cos(incidence) * n_);
        const Vec on{0.5 * kCells + 0.13, 0.5 * kCells - 0.29};
        const double back = 10.0 / std::cos(incidence);
        const double start = back < 24.0 ? back : 24.0;
        const Vec from = on - (start / kSpeed) * v;
        const auto metre = static_cast<double>(kCell_m);
        require(tank_->add_particle(weir::convert<float>(metre * from),
                                    weir::convert<float>(metre * v)));
        for (int step = 0; step < 600; ++step) {
            tank_->step(kFrame_s);
            const Vec x = tank_.position(0);
            const Vec now = tank_.velocity(0);
            const double off = weir::dot(x - on, n_);
            contact.penetration = std::max(contact.penetration, -off);
            if (!contact.happened && weir::length(now - v) > 1e-3 * kSpeed) {
                contact.happened = true;
                contact.stand_off = off;
            }
            if (contact.happened && off > 3.0) {
                const Vec mirrored = v - 2.0 * weir::dot(v, n_) * n_;
                contact.angle_error = std::abs(std::atan2(weir::cross(now, mirrored),
                                                          weir::dot(now, mirrored))) *
                                      180.0 / M_PI;
                const double tangential = std::abs(weir::dot(v, along));
                contact.loss = tangential > 1.0
                                   ? std::abs(weir::dot(now, along) / weir::dot(v, along) - 1.0)
                                   : 0.0;
                break;
            }
        }
        require(tank_->remove_particle(0));
        return contact;
    }

private:
    Vec n_;
    Tank<Real> tank_;
};

std::vector<double> wall_angles() {
    std::vector<double> degrees;
    for (int k = 0; k < 72; ++k) {
        degrees.push_back(5.0 * k);
    }
    degrees.insert(degrees.end(), {17.3, 31.7, 58.2, 73.1});
    return degrees;
}

template <class Real>
void all_walls(Report& report, const std::string& name, weir::Contour contour,
               int particles_per_cell, bool targets) {
    Contact worst;
    double nearest = 1e9;
    double furthest = -1e9;
    int missed = 0;
    for (const double degrees : wall_angles()) {
        const double a = degrees * M_PI / 180.0;
        Flight<Real> flight({std::cos(a), std::sin(a)}, contour, particles_per_cell);
        for (const double incidence : {0.0, 30.0, 60.0, 80.0}) {
            const Contact one = flight.fly(incidence * M_PI / 180.0);
            missed += one.happened ? 0 : 1;
            worst.angle_error = std::max(worst.angle_error, one.angle_error);
            worst.loss = std::max(worst.loss, one.loss);
            worst.penetration = std::max(worst.penetration, one.penetration);
            nearest = std::min(nearest, one.stand_off);
            furthest = std::max(furthest, one.stand_off);
        }
    }
    if (!targets) {
        report.figure(name + ".angle_error", worst.angle_error, "deg");
        report.figure(name + ".penetration", worst.penetration, "cells");
        return;
    }
    report.equals(name + ".flights_without_contact", missed, "1", 0.0);
    accurate<Real>(report, name + ".angle_error", worst.angle_error, "deg", 0.1);
    accurate<Real>(report, name + ".loss_along_the_wall", 100.0 * worst.loss, "%", 0.5);
    report.at_most(name + ".penetration", worst.penetration, "cells", 0.05);
    accurate<Real>(report, name + ".stand_off_anisotropy", furthest - nearest, "cells", 0.1);
}

}  // namespace

void one_particle(Report& report, const Effort& effort) {
    in_scalar(report, effort.real, [&](auto zero) {
        using Real = decltype(zero);
        all_walls<Real>(report, "R1", weir::Contour::interpolated, 4, true);
        all_walls<Real>(report, "R1.sixteen_a_cell", weir::Contour::interpolated, 16, true);
        all_walls<Real>(report, "R1.binary", weir::Contour::mid_edge, 4, false);
    });
}

}  // namespace solids
