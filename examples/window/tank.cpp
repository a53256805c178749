#include "tank.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "port/port.hpp"

namespace {

constexpr float kPi = 3.14159265F;
constexpr float kReach = 0.12F;        ///< of the hand, m
constexpr float kHandSpeed = 2.0F;     ///< that a body follows it with, m/s
constexpr int kPouredAFrame = 40;
constexpr float kStream = 0.05F;       ///< half of what is poured into in a frame, m
constexpr float kGravity = 9.81F;

using Ring = std::vector<weir::Vec2f>;

void require(weir::Status status) {
    if (status != weir::Status::ok) {
        std::fprintf(stderr, "window_tank: %s\n", weir::status_text(status));
        std::exit(1);
    }
}

Ring box(float width, float height) {
    const float x = 0.5F * width;
    const float y = 0.5F * height;
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

/// Corners at two distances in turn: a star, and with one distance a round body.
Ring star(int corners, float outer, float inner) {
    Ring ring;
    for (int k = 0; k < corners; ++k) {
        const float angle = 2.0F * kPi * static_cast<float>(k) / static_cast<float>(corners);
        const float radius = k % 2 == 0 ? outer : inner;
        ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return ring;
}

/// Of a wheel with four paddles.
Ring wheel(float radius, float half) {
    return {{half, half},   {half, radius},   {-half, radius},  {-half, half},
            {-radius, half}, {-radius, -half}, {-half, -half},   {-half, -radius},
            {half, -radius}, {half, -half},    {radius, -half},  {radius, half}};
}

weir::Vec2f inside(weir::Vec2f at_m, float margin) {
    return {std::clamp(at_m.x, margin, kSize.x - margin),
            std::clamp(at_m.y, margin, kSize.y - margin)};
}

}  // namespace

Tank::Tank() {
    weir::WorldDef def;
    def.cell_m = kCell;
    def.parallel_for = port::parallel_for;
    weir::Capacity& c = def.capacity;
    c.cells_x = kCellsX, c.cells_y = kCellsY, c.particles = 36000;
    c.bodies = 16, c.vertices = 160, c.two_way = true;
    memory_.resize(weir::world_bytes<float>(c) / sizeof(Line) + 1);
    require(world_.init(def, memory_.data(), memory_.size() * sizeof(Line)));

    add_fixed({{-0.2F, 0.0F}, {0.2F, 0.0F}, {0.1F, 0.1F}, {-0.1F, 0.1F}}, {0.9F, 0.0F});
    add(wheel(0.16F, 0.016F), {1.25F, 0.32F}, weir::Hold::hinge);
    for (const float x : {0.62F, 0.75F, 0.88F}) {
        add(box(0.1F, 0.1F), {x, 0.5F}, weir::Hold::none);
    }
    add(star(16, 0.06F, 0.06F), {1.05F, 0.6F}, weir::Hold::none);
    add(star(10, 0.09F, 0.045F), {0.3F, 0.8F}, weir::Hold::none);
    require(world_.fill({{0.0F, 0.0F}, {0.5F, 0.65F}}));
    require(world_.fill({{0.5F, 0.0F}, {kSize.x, 0.15F}}));

    start_.resize(weir::snapshot_bytes<float>(c));
    require(world_.save(start_.data(), start_.size()));
}

void Tank::add(const Ring& ring, weir::Vec2f at_m, weir::Hold hold) {
    Solid solid{ring, {}, false, hold == weir::Hold::none};
    weir::BodyDef def;
    def.polygon = {ring.data(), static_cast<std::int32_t>(ring.size())};
    def.motion.position_m = at_m;
    def.density_ratio = 0.5F;
    def.surface.friction = 0.3F;
    def.hold = hold;
    require(world_.add_free_body(def, &solid.id));
    solids_.push_back(solid);
}

void Tank::add_fixed(const Ring& ring, weir::Vec2f at_m) {
    Solid solid{ring, {}, true, false};
    weir::BodyDef def;
    def.polygon = {ring.data(), static_cast<std::int32_t>(ring.size())};
    def.motion.position_m = at_m;
    require(world_.add_static_body(def, &solid.id));
    solids_.push_back(solid);
}

weir::Motion Tank::motion(const Solid& solid) const {
    weir::Motion motion;
    require(world_.motion(solid.id, &motion));
    return motion;
}

void Tank::start_again() {
    require(world_.restore(start_.data(), start_.size()));
    held_ = -1;
    poured_ = 0;
}

int Tank::nearest(weir::Vec2f at_m) const {
    int found = -1;
    float least = kReach;
    for (std::size_t k = 0; k < solids_.size(); ++k) {
        const weir::Vec2f is = motion(solids_[k]).position_m;
        const float distance = std::hypot(is.x - at_m.x, is.y - at_m.y);
        if (solids_[k].loose && distance < least) {
            found = static_cast<int>(k);
            least = distance;
        }
    }
    return found;
}

/// A body that is led goes as told through the next step, and floats on when it is let go.
void Tank::carry(weir::Vec2f to_m) {
    const Solid& solid = solids_[static_cast<std::size_t>(held_)];
    const weir::Motion now = motion(solid);
    const weir::Vec2f way{to_m.x - now.position_m.x, to_m.y - now.position_m.y};
    const float share = std::min(1.0F, kHandSpeed * kFrame / std::hypot(way.x + 1e-6F, way.y));
    require(world_.move_body(
        solid.id, {now.position_m.x + share * way.x, now.position_m.y + share * way.y},
        now.angle_rad, kFrame));
}

/// Each particle at a place of its own: two with one place and one velocity never part.
void Tank::pour(weir::Vec2f at_m) {
    const auto roll = [&] {
        dice_ = 1664525U * dice_ + 1013904223U;
        return static_cast<float>(dice_ >> 8U) / 16777216.0F - 0.5F;
    };
    for (int k = 0; k < kPouredAFrame; ++k) {
        const weir::Vec2f place =
            inside({at_m.x + kStream * roll(), at_m.y + kStream * roll()}, kCell);
        if (world_.add_particle(place, {0.0F, -1.0F}) != weir::Status::ok) {
            return;  // it is full, or the place is inside a solid
        }
        poured_ += 1;
    }
}

void Tank::step(const Hand& hand) {
    const weir::Vec2f at_m = inside(hand.at_m, kReach);
    held_ = !hand.holds ? -1 : (held_ >= 0 ? held_ : nearest(hand.at_m));
    if (held_ >= 0) {
        carry(at_m);
    }
    if (hand.pours) {
        pour(at_m);
    }
    if (hand.drinks) {
        require(world_.drain({{at_m.x - kStream, at_m.y - kStream},
                              {at_m.x + kStream, at_m.y + kStream}}));
    }
    require(world_.set_gravity({kGravity * std::sin(hand.lean_rad),
                                -kGravity * std::cos(hand.lean_rad)}));
    world_.step(kFrame);
}
