#include "vessel.hpp"

#include <algorithm>
#include <cmath>

namespace solids {

namespace {

Vec rotate(Vec v, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

weir::Vec2f metres(Vec cells) {
    return {static_cast<float>(cells.x) * kCell_m, static_cast<float>(cells.y) * kCell_m};
}

std::vector<Vec> lattice(const Vessel& vessel) {
    std::vector<Vec> places;
    const Vec first{0.25 + std::fmod(vessel.lattice.x, 0.5), 0.25 + std::fmod(vessel.lattice.y, 0.5)};
    for (int b = 0; b < 2 * vessel.cells_y; ++b) {
        for (int a = 0; a < 2 * vessel.cells_x; ++a) {
            const Vec p = first + 0.5 * Vec{1.0 * a, 1.0 * b};
            if (vessel.liquid(vessel.to_frame(p))) {
                places.push_back(p);
            }
        }
    }
    return places;
}

weir::WorldDef definition(const Vessel& vessel, std::size_t particles) {
    weir::WorldDef def;
    def.cell_m = kCell_m;
    def.capacity.cells_x = vessel.cells_x;
    def.capacity.cells_y = vessel.cells_y;
    def.capacity.particles = static_cast<std::int32_t>(particles);
    def.capacity.bodies = static_cast<std::int32_t>(vessel.walls.size());
    def.capacity.wall_edges = vessel.wall_edges;
    def.max_substeps = 32;
    for (const Points& wall : vessel.walls) {
        def.capacity.vertices += static_cast<std::int32_t>(wall.size());
    }
    const Vec down = vessel.gravity_tilts ? vessel.turned({0.0, -9.81}) : Vec{0.0, -9.81};
    def.gravity_mps2 = weir::convert<float>(down);
    return def;
}

}  // namespace

Vec Vessel::turned(Vec v) const {
    return rotate(v, tilt);
}
Vec Vessel::turned_back(Vec v) const {
    return rotate(v, -tilt);
}
Vec Vessel::to_tank(Vec p) const {
    return middle() + turned(p - middle());
}
Vec Vessel::to_frame(Vec p) const {
    return middle() + turned_back(p - middle());
}

template <class Real>
Pool<Real>::Pool(const Vessel& vessel) : Pool(vessel, lattice(vessel)) {}

template <class Real>
Pool<Real>::Pool(const Vessel& vessel, const std::vector<Vec>& places)
    : vessel_(vessel), tank_(definition(vessel, places.size())) {
    for (const Points& wall : vessel.walls) {
        std::vector<weir::Vec2f> ring;
        for (const Vec p : wall) {
            ring.push_back(metres(vessel.to_tank(p)));
        }
        weir::BodyDef body;
        body.polygon = {ring.data(), static_cast<std::int32_t>(ring.size())};
        weir::BodyId id;
        require(tank_->add_static_body(body, &id));
    }
    for (const Vec p : places) {
        const weir::Status status = tank_->add_particle(metres(p), {});
        if (status != weir::Status::particle_inside_solid) {  // a hair from a wall
            require(status);
        }
    }
}

template <class Real>
void Pool<Real>::step(float dt_s) {
    report_ = tank_->step(dt_s);
}

template <class Real>
void Pool<Real>::run(int steps) {
    for (int k = 0; k < steps; ++k) {
        step();
    }
}

template <class Real>
Vec Pool<Real>::position(int k) const {
    return vessel_.to_frame(tank_.position(k));
}

template <class Real>
Vec Pool<Real>::velocity(int k) const {
    return vessel_.turned_back(tank_.velocity(k));
}

template <class Real>
void Pool<Real>::stir(const std::function<Vec(Vec)>& velocity) {
    std::vector<Vec> places;
    for (int k = 0; k < particles(); ++k) {
        places.push_back(tank_.position(k));
    }
    while (particles() > 0) {
        require(tank_->remove_particle(particles() - 1));
    }
    for (const Vec p : places) {
        require(tank_->add_particle(metres(p),
                                    metres(vessel_.turned(velocity(vessel_.to_frame(p))))));
    }
}

template <class Real>
double Pool<Real>::rms_speed() const {
    double sum = 0.0;
    for (int k = 0; k < particles(); ++k) {
        const Vec v = tank_.velocity(k);
        sum += weir::dot(v, v);
    }
    return std::sqrt(sum / std::max(particles(), 1));
}

template <class Real>
double Pool<Real>::mean_height() const {
    double sum = 0.0;
    for (int k = 0; k < particles(); ++k) {
        sum += position(k).y;
    }
    return sum / std::max(particles(), 1);
}

template <class Real>
double Pool<Real>::pressure(int i, int j) const {
    return static_cast<double>(tank_->pressure().at(i, j)) *
           static_cast<double>(tank_->pressure_scale()) * 64.0 * 64.0;
}

template class Pool<float>;
template class Pool<double>;
template class Pool<weir::Fixed>;
template class Pool<weir::SmallFixed>;

AtRest at_rest(const std::function<bool(Vec)>& region, double area, Vec low, Vec high, Vec up) {
    constexpr double kStep = 1.0 / 16.0;
    std::vector<double> heights;
    for (double y = low.y + 0.5 * kStep; y < high.y; y += kStep) {
        for (double x = low.x + 0.5 * kStep; x < high.x; x += kStep) {
            if (region({x, y})) {
                heights.push_back(weir::dot(Vec{x, y}, up));
            }
        }
    }
    std::sort(heights.begin(), heights.end());
    const auto count = std::min(heights.size(),
                                static_cast<std::size_t>(area / (kStep * kStep) + 0.5));
    AtRest rest;
    for (std::size_t k = 0; k < count; ++k) {
        rest.mean_height += heights[k] / static_cast<double>(count);
    }
    rest.surface = count > 0 ? heights[count - 1] : 0.0;
    return rest;
}

}  // namespace solids
