#include "unit/test_world.hpp"

#include "math/scalar.hpp"

namespace weir {

#define WEIR_INSTANTIATE(Real)      \
    template class TestWorld<Real>; \
    template Layout layout<Real>(const Capacity&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

BodyDef body_of(const Ring& ring, Vec2f at_m, float angle_rad) {
    BodyDef def;
    def.polygon = {ring.data(), static_cast<std::int32_t>(ring.size())};
    def.motion.position_m = at_m;
    def.motion.angle_rad = angle_rad;
    return def;
}

Ring rectangle(float width, float height) {
    return {{-0.5F * width, -0.5F * height},
            {0.5F * width, -0.5F * height},
            {0.5F * width, 0.5F * height},
            {-0.5F * width, 0.5F * height}};
}

Ring regular_polygon(int corners, float radius, float first_rad) {
    Ring ring;
    for (int k = 0; k < corners; ++k) {
        const float angle =
            first_rad + 6.2831853F * static_cast<float>(k) / static_cast<float>(corners);
        ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return ring;
}

WorldDef small_def() { return tank_def(16, 16, 200, 3, 12); }

void expect_ok(Status status) { EXPECT_EQ(status, Status::ok) << status_text(status); }

std::int64_t work_of(const StepReport& report) {
    std::int64_t all = 0;
    for (const std::uint32_t work : report.work) {
        all += work;
    }
    return all;
}

void expect_same_report(const StepReport& a, const StepReport& b, bool work) {
    for (std::int32_t stage = 0; work && stage < kStageCount; ++stage) {
        EXPECT_EQ(a.work[stage], b.work[stage]) << stage_name(static_cast<weir::Stage>(stage));
    }
    EXPECT_EQ(a.nodes_rasterized, work ? b.nodes_rasterized : a.nodes_rasterized);
    EXPECT_EQ(a.substeps, b.substeps);
    EXPECT_EQ(a.clamped, b.clamped);
    EXPECT_EQ(a.asleep, b.asleep);
    EXPECT_EQ(a.rung, b.rung);
    EXPECT_EQ(a.walls_held, b.walls_held);
    EXPECT_EQ(a.dt_s, b.dt_s);
    EXPECT_EQ(a.max_speed_mps, b.max_speed_mps);
    EXPECT_EQ(a.particles, b.particles);
    EXPECT_EQ(a.particles_asleep, b.particles_asleep);
    EXPECT_EQ(a.particles_tested, b.particles_tested);
    EXPECT_EQ(a.particles_reflected, b.particles_reflected);
    EXPECT_EQ(a.particles_stuck, b.particles_stuck);
    EXPECT_EQ(a.particles_removed_stuck, b.particles_removed_stuck);
    EXPECT_EQ(a.particles_beyond, b.particles_beyond);
    EXPECT_EQ(a.contacts_missed, b.contacts_missed);
    EXPECT_EQ(a.cells_overfull, b.cells_overfull);
    EXPECT_EQ(a.particles_crowded, b.particles_crowded);
    EXPECT_EQ(a.particles_reset, b.particles_reset);
    EXPECT_EQ(a.particles_slowed, b.particles_slowed);
    EXPECT_EQ(a.bodies_slowed, b.bodies_slowed);
}

}  // namespace weir

template class std::vector<weir::Vec2f>;
