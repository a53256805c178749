#include "paper_fluid.hpp"

#include <algorithm>

// Legend: x, v position and velocity of a particle; w, d weight and its derivative; a acceleration.

namespace paper {
namespace {

constexpr float kClamp = 1.0F;  // the stencil of a particle here still lies within the grid

// Cubic Hermite along an edge of length 1: values f0, f1 and slopes g0, g1 at its ends.
float hermite(float f0, float f1, float g0, float g1, float t) {
    const float rise = f1 - f0;
    return f0 + t * (g0 + t * (3.0F * rise - 2.0F * g0 - g1 + t * (g0 + g1 - 2.0F * rise)));
}

float mix(float a, float b, float t) {
    return a + t * (b - a);
}

}  // namespace

Fluid::Fluid(const FluidConfig& config)
    : config_(config),
      nodes_x_(config.cells_x + 2 * kMargin + 1),
      nodes_y_(config.cells_y + 2 * kMargin + 1),
      solids_(nodes_x_, nodes_y_) {
    nodes_.resize(static_cast<std::size_t>(nodes_x_) * static_cast<std::size_t>(nodes_y_));
}

void Fluid::add_particle(Point position, Point velocity) {
    Particle particle{};
    particle.x = {position.x + kMargin, position.y + kMargin};
    particle.v = velocity;
    move(particle, {});
    set_weights(particle);
    particles_.push_back(particle);
}

void Fluid::add_static(const Polygon& polygon) {
    solids_.add_static(placed(polygon, {kMargin, kMargin}, 0.0F));
}

void Fluid::add_dynamic(const Polygon& local, Point position, float angle_rad, float spin_rad) {
    solids_.add_dynamic(local, {position.x + kMargin, position.y + kMargin}, angle_rad, spin_rad);
}

Point Fluid::position(int index) const {
    const Point x = particles_[static_cast<std::size_t>(index)].x;
    return {x.x - kMargin, x.y - kMargin};
}

Point Fluid::velocity(int index) const {
    return particles_[static_cast<std::size_t>(index)].v;
}

double Fluid::grid_mass() const {
    double sum = 0.0;
    for (int k = first_node_; k < last_node_; ++k) {
        sum += static_cast<double>(nodes_[static_cast<std::size_t>(k)].mass);
    }
    return sum;
}

void Fluid::step() {
    if (config_.interaction && !solids_.empty()) {
        solids_.rebuild();
    }
    clear_nodes();
    scatter_mass();
    momentum_to_velocity();
    scatter_forces();
    force_to_acceleration();
    if (config_.velocity == Velocity::scattered_again) {
        scatter_velocity_again();
    }
    gather_velocity();
}

// Steffen, Kirby and Berzins 2008, Int. J. Numer. Methods Eng. 76:922, quadratic B-spline.
void Fluid::set_weights(Particle& particle) const {
    const int i = static_cast<int>(particle.x.x - 0.5F);
    const int j = static_cast<int>(particle.x.y - 0.5F);
    particle.base = j * nodes_x_ + i;
    const auto fill = [](float t, float* w, float* d) {  // t in [0.5, 1.5): from the first node
        const float right = t - 0.5F;
        const float left = 1.5F - t;
        const float middle = t - 1.0F;
        w[0] = 0.5F * left * left;
        w[1] = 0.75F - middle * middle;
        w[2] = 0.5F * right * right;
        d[0] = -left;
        d[1] = -2.0F * middle;
        d[2] = right;
    };
    fill(particle.x.x - static_cast<float>(i), particle.wx, particle.dx);
    fill(particle.x.y - static_cast<float>(j), particle.wy, particle.dy);
}

// Only the rows between the lowest and the highest particle: the rest is never looked at.
void Fluid::clear_nodes() {
    int low = static_cast<int>(nodes_.size());
    int high = 0;
    for (const Particle& p : particles_) {
        low = std::min(low, p.base);
        high = std::max(high, p.base);
    }
    first_node_ = particles_.empty() ? 0 : low;
    last_node_ = particles_.empty() ? 0 : high + 2 * nodes_x_ + 3;
    std::fill(nodes_.begin() + first_node_, nodes_.begin() + last_node_, Node{});
}

void Fluid::scatter_mass() {
    for (const Particle& p : particles_) {
        Node* row = &nodes_[static_cast<std::size_t>(p.base)];
        for (int j = 0; j < 3; ++j, row += nodes_x_) {
            for (int i = 0; i < 3; ++i) {
                Node& node = row[i];
                const float w = p.wx[i] * p.wy[j];
                node.mass += w;
                // The field's slope at the node: minus the weight's slope at the particle.
                node.gradient.x -= p.dx[i] * p.wy[j];
                node.gradient.y -= p.wx[i] * p.dy[j];
                node.velocity.x += w * p.v.x;
                node.velocity.y += w * p.v.y;
            }
        }
    }
}

void Fluid::momentum_to_velocity() {
    for (int k = first_node_; k < last_node_; ++k) {
        Node& node = nodes_[static_cast<std::size_t>(k)];
        if (node.mass > 0.0F) {
            const float inverse = 1.0F / node.mass;
            node.velocity = {node.velocity.x * inverse, node.velocity.y * inverse};
        }
    }
}

// The 12-parameter rectangle (Adini and Clough 1960, Melosh 1963) written as a Boolean sum:
// cubics along the horizontal edges blended upwards, plus cubics along the vertical edges blended
// sideways, minus the bilinear part that both contain.
float Fluid::density_at(const Particle& p) const {
    const int i = static_cast<int>(p.x.x);
    const int j = static_cast<int>(p.x.y);
    const float u = p.x.x - static_cast<float>(i);
    const float v = p.x.y - static_cast<float>(j);
    const Node* low = &nodes_[static_cast<std::size_t>(j * nodes_x_ + i)];
    const Node* high = low + nodes_x_;
    const Node& a = low[0];
    const Node& b = low[1];
    const Node& c = high[0];
    const Node& d = high[1];
    const float bottom = hermite(a.mass, b.mass, a.gradient.x, b.gradient.x, u);
    const float top = hermite(c.mass, d.mass, c.gradient.x, d.gradient.x, u);
    const float left = hermite(a.mass, c.mass, a.gradient.y, c.gradient.y, v);
    const float right = hermite(b.mass, d.mass, b.gradient.y, d.gradient.y, v);
    const float bilinear = mix(mix(a.mass, b.mass, u), mix(c.mass, d.mass, u), v);
    return mix(bottom, top, v) + mix(left, right, u) - bilinear;
}

// A spring beyond the wall, as stiff as the liquid.
Point Fluid::wall_force(const Particle& p) const {
    const auto push = [this](float x, int cells) {
        const float below = kMargin - x;
        const float above = x - static_cast<float>(kMargin + cells);
        return config_.stiffness * (std::max(below, 0.0F) - std::max(above, 0.0F));
    };
    return {push(p.x.x, config_.cells_x), push(p.x.y, config_.cells_y)};
}

// Force on a node = wall force x weight - stress x slope of the weight (particle volume 1, which
// makes stiffness the square of the sound speed).
void Fluid::scatter_forces() {
    const bool viscous = config_.viscosity > 0.0F || config_.bulk_viscosity > 0.0F;
    const float pressure_scale = config_.stiffness / config_.rest_density;
    for (const Particle& p : particles_) {
        const float p_raw = pressure_scale * (density_at(p) - config_.rest_density);
        const float pressure = std::clamp(p_raw, -config_.max_tension * config_.stiffness,
                                          config_.max_compression * config_.stiffness);
        float sxx = -pressure;
        float syy = -pressure;
        float sxy = 0.0F;
        Node* const base = &nodes_[static_cast<std::size_t>(p.base)];
        if (viscous) {
            float ux = 0.0F, uy = 0.0F, vx = 0.0F, vy = 0.0F;
            const Node* row = base;
            for (int j = 0; j < 3; ++j, row += nodes_x_) {
                for (int i = 0; i < 3; ++i) {
                    const float gx = p.dx[i] * p.wy[j];
                    const float gy = p.wx[i] * p.dy[j];
                    ux += row[i].velocity.x * gx;
                    uy += row[i].velocity.x * gy;
                    vx += row[i].velocity.y * gx;
                    vy += row[i].velocity.y * gy;
                }
            }
            const float bulk = config_.bulk_viscosity * (ux + vy);
            sxx += bulk + config_.viscosity * (ux - vy);  // 2 (ux - half the divergence)
            syy += bulk - config_.viscosity * (ux - vy);
            sxy = config_.viscosity * (uy + vx);
        }
        const Point wall = wall_force(p);
        Node* row = base;
        for (int j = 0; j < 3; ++j, row += nodes_x_) {
            for (int i = 0; i < 3; ++i) {
                const float w = p.wx[i] * p.wy[j];
                const float gx = p.dx[i] * p.wy[j];
                const float gy = p.wx[i] * p.dy[j];
                row[i].acceleration.x += w * wall.x - (gx * sxx + gy * sxy);
                row[i].acceleration.y += w * wall.y - (gx * sxy + gy * syy);
            }
        }
    }
}

// Afterwards `velocity` is the new one: it is what the particles move with.
void Fluid::force_to_acceleration() {
    for (int k = first_node_; k < last_node_; ++k) {
        Node& node = nodes_[static_cast<std::size_t>(k)];
        if (node.mass > 0.0F) {
            const float inverse = 1.0F / node.mass;
            node.acceleration.x = node.acceleration.x * inverse + config_.gravity.x;
            node.acceleration.y = node.acceleration.y * inverse + config_.gravity.y;
            node.velocity.x += node.acceleration.x;
            node.velocity.y += node.acceleration.y;
        }
    }
}

void Fluid::scatter_velocity_again() {
    for (int k = first_node_; k < last_node_; ++k) {
        nodes_[static_cast<std::size_t>(k)].velocity = {};
    }
    for (Particle& p : particles_) {
        Node* const base = &nodes_[static_cast<std::size_t>(p.base)];
        const Node* from = base;
        for (int j = 0; j < 3; ++j, from += nodes_x_) {
            for (int i = 0; i < 3; ++i) {
                const float w = p.wx[i] * p.wy[j];
                p.v.x += w * from[i].acceleration.x;
                p.v.y += w * from[i].acceleration.y;
            }
        }
        Node* row = base;
        for (int j = 0; j < 3; ++j, row += nodes_x_) {
            for (int i = 0; i < 3; ++i) {
                const float w = p.wx[i] * p.wy[j];
                row[i].velocity.x += w * p.v.x;
                row[i].velocity.y += w * p.v.y;
            }
        }
    }
    momentum_to_velocity();
}

void Fluid::gather_velocity() {
    const bool has_acceleration = config_.velocity == Velocity::scattered_again;
    const bool collide = config_.interaction && !solids_.empty();
    for (Particle& p : particles_) {
        Point grid{};
        Point a{};
        const Node* row = &nodes_[static_cast<std::size_t>(p.base)];
        for (int j = 0; j < 3; ++j, row += nodes_x_) {
            for (int i = 0; i < 3; ++i) {
                const float w = p.wx[i] * p.wy[j];
                grid.x += w * row[i].velocity.x;
                grid.y += w * row[i].velocity.y;
                a.x += w * row[i].acceleration.x;
                a.y += w * row[i].acceleration.y;
            }
        }
        if (!has_acceleration) {
            p.v = {p.v.x + a.x, p.v.y + a.y};
        }
        p.v.x += config_.smoothing * (grid.x - p.v.x);
        p.v.y += config_.smoothing * (grid.y - p.v.y);
        // Nobody moves more than a cell: the look-up below and the clamp rely on it.
        grid = {std::clamp(grid.x, -1.0F, 1.0F), std::clamp(grid.y, -1.0F, 1.0F)};
        if (collide) {
            const Contact contact = solids_.contact({p.x.x + grid.x, p.x.y + grid.y});
            if (contact.side == Side::behind_line) {
                p.v = reflected(p.v, contact.normal);
                grid = reflected(grid, contact.normal);
            } else if (contact.side == Side::buried) {
                // No line to reflect about: back the way it came.
                p.v = {-p.v.x, -p.v.y};
                grid = {-grid.x, -grid.y};
            }
        }
        move(p, grid);
        set_weights(p);
    }
}

void Fluid::move(Particle& p, Point step) const {
    const auto held = [](float x, int nodes, float& v) {
        const float high = static_cast<float>(nodes - 1) - kClamp;
        if (x < kClamp) {
            v = std::max(v, 0.0F);
            return kClamp;
        }
        if (x > high) {
            v = std::min(v, 0.0F);
            return high;
        }
        return x;
    };
    p.x.x = held(p.x.x + step.x, nodes_x_, p.v.x);
    p.x.y = held(p.x.y + step.y, nodes_y_, p.v.y);
}

}  // namespace paper
