// A small tank for long runs: a pool that rests, or a dam that breaks over bodies while gravity
// swings.
#pragma once

#include <cmath>
#include <stdexcept>

#include "measure/tank_def.hpp"
#include "measure/world_memory.hpp"

namespace measure {

struct Stirred {
    bool bodies = false;   ///< a static box, and a bar that turns
    bool floating = false;  ///< a free body
    bool second = false;   ///< half of the liquid is denser
    bool swings = false;   ///< gravity
};

template <class Real>
class StirredTank {
public:
    static constexpr float kFrame = 1.0F / 120.0F;

    explicit StirredTank(const Stirred& how)
        : how_(how), memory_(memory_for<Real>(definition(how))) {
        require(world_.init(definition(how), memory_.data(), memory_.size()));
        if (how.bodies) {
            add({0.20F, 0.03F}, {0.04F, 0.06F}, 0.0F, Kind::fixed);
            add({0.12F, 0.15F}, {0.08F, 0.02F}, 2.0F, Kind::moving);
        }
        if (how.floating) {
            add({0.06F, 0.18F}, {0.05F, 0.04F}, 0.0F, Kind::free);
        }
        const float width = how.swings ? 0.08F : 0.24F;
        fill({{0.0F, 0.0F}, {width, 0.08F}},
             how.second ? weir::Liquid::second : weir::Liquid::first);
        fill({{0.0F, 0.08F}, {width, 0.16F}}, weir::Liquid::first);
    }
    StirredTank(const StirredTank&) = delete;

    weir::World<Real>& world() { return world_; }
    std::byte* memory() { return memory_.data(); }
    std::size_t snapshot_bytes() const {
        return weir::snapshot_bytes<Real>(definition(how_).capacity);
    }
    std::int32_t particles() const { return particles_; }  ///< as filled in

    /// As gravity stands before step k.
    void swing(int k) {
        if (how_.swings) {
            const float angle = 0.02F * static_cast<float>(k % 100'000);
            require(world_.set_gravity({5.0F * std::sin(angle), -8.0F + 2.0F * std::cos(angle)}));
        }
    }

private:
    enum class Kind { fixed, moving, free };

    static weir::WorldDef definition(const Stirred& how) {
        weir::WorldDef def = measure::tank_def(12, 12, 500, 3, 12);
        def.cell_m = 0.02F;
        def.capacity.second_liquid = how.second;
        def.capacity.two_way = true;
        def.second_density_ratio = how.second ? 1.7F : 1.0F;
        return def;
    }
    static void require(weir::Status status) {
        if (status != weir::Status::ok) {
            throw std::runtime_error(weir::status_text(status));
        }
    }
    void fill(const weir::Box& box, weir::Liquid kind) {
        std::int32_t added = 0;
        require(world_.fill(box, &added, kind));
        particles_ += added;
    }
    void add(weir::Vec2f at, weir::Vec2f size, float spin, Kind kind) {
        const float x = 0.5F * size.x;
        const float y = 0.5F * size.y;
        const weir::Vec2f ring[] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
        weir::BodyDef body;
        body.polygon = {ring, 4};
        body.density_ratio = 0.5F;
        body.surface.friction = 0.3F;
        body.motion.position_m = at;
        body.motion.spin_radps = spin;
        weir::BodyId id;
        require(kind == Kind::fixed    ? world_.add_static_body(body, &id)
                : kind == Kind::moving ? world_.add_moving_body(body, &id)
                                       : world_.add_free_body(body, &id));
    }

    Stirred how_;
    WorldMemory memory_;
    weir::World<Real> world_;
    std::int32_t particles_ = 0;
};

}  // namespace measure
