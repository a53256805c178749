#include "pour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "math/vec2.hpp"
#include "measure/tank_def.hpp"
#include "tank.hpp"

namespace solids {

namespace {

constexpr std::int32_t kTank = 64;
constexpr float kLargest = 40.0F;
constexpr int kSteps = 400;
constexpr float kStep_s = 0.05F;  // cells of 1 m: the block falls for 3 s

/// Scaled by a power of two, so that not a bit of its shape changes, and set on the ground.
ListedPolygon fitted(ListedPolygon polygon) {
    weir::Vec2f low = polygon.rings[0][0];
    weir::Vec2f high = low;
    for (const weir::Vec2f v : polygon.rings[0]) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y)};
    }
    const float size = std::max(high.x - low.x, high.y - low.y);
    const float scale = std::exp2(std::floor(std::log2(kLargest / size)));
    for (auto& ring : polygon.rings) {
        for (weir::Vec2f& v : ring) {
            v = {scale * (v.x - low.x), scale * (v.y - low.y)};
        }
    }
    return polygon;
}

/// How deep a point is inside, cells; 0 outside. By the parity of a ray's crossings.
double depth_in(const ListedPolygon& polygon, weir::Vec2<double> p) {
    bool inside = false;
    double nearest = 1e9;
    for (const auto& ring : polygon.rings) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const auto a = weir::convert<double>(ring[k]);
            const auto b = weir::convert<double>(ring[(k + 1) % ring.size()]);
            if ((a.y > p.y) != (b.y > p.y) &&
                p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
                inside = !inside;
            }
            const double along = weir::dot(p - a, b - a) / weir::dot(b - a, b - a);
            const double share = std::min(1.0, std::max(0.0, along));
            nearest = std::min(nearest, weir::length(p - (a + share * (b - a))));
        }
    }
    return inside ? nearest : 0.0;
}

}  // namespace

template <class Real>
PourResult pour(const ListedPolygon& drawn) {
    const ListedPolygon polygon = fitted(drawn);
    weir::WorldDef def = measure::tank_def(kTank, kTank, 4000, 1, weir::kMaxBodyVertices);
    def.cell_m = 1.0F;
    Tank<Real> tank(def);
    std::vector<weir::View<weir::Vec2f>> views;
    weir::BodyDef body = body_of(polygon, views);
    const weir::Vec2f at{12.3F, 2.7F};  // off the grid's lines
    body.motion.position_m = at;
    weir::BodyId id;
    require(tank->add_static_body(body, &id));
    PourResult result;
    require(tank->fill({{2, 46}, {62, 62}}, &result.particles));
    int removed = 0;
    for (int step = 0; step < kSteps; ++step) {
        removed += tank->step(kStep_s).particles_removed_stuck;
    }
    const std::int32_t left = tank->particle_positions().size;
    for (std::int32_t k = 0; k < left; ++k) {
        const double depth = depth_in(polygon, tank.position(k) - weir::convert<double>(at));
        result.deepest = std::max(result.deepest, depth);
        result.inside += depth > kTrappedDepth ? 1 : 0;
    }
    result.lost = result.particles - removed - left;
    return result;
}

template PourResult pour<float>(const ListedPolygon&);
template PourResult pour<double>(const ListedPolygon&);
template PourResult pour<weir::Fixed>(const ListedPolygon&);
template PourResult pour<weir::SmallFixed>(const ListedPolygon&);

}  // namespace solids
