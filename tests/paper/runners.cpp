#include "runners.hpp"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "measure/world_memory.hpp"
#include "paper_scaling.hpp"
#include "weir/weir.hpp"

namespace paper_bench {
namespace {

constexpr float kFrame_s = 1.0F / 120.0F;

paper::Scaling scaling_of(const Scene& scene, float sound_ratio) {
    paper::Scaling scaling;
    scaling.cell_m = scene.cell_m;
    scaling.gravity_mps2 = scene.gravity_mps2;
    scaling.depth_m = scene.depth_cells * scene.cell_m;
    scaling.sound_ratio = sound_ratio;
    return scaling;
}

int count_astray(const Runner& runner, float slack, int cells_x, int cells_y, const Point* points) {
    int astray = 0;
    for (int k = 0; k < runner.particles(); ++k) {
        const Point p = points[k];
        const bool inside = p.x >= -slack && p.x <= static_cast<float>(cells_x) + slack &&
                            p.y >= -slack && p.y <= static_cast<float>(cells_y) + slack;
        astray += inside ? 0 : 1;  // not-a-number compares false
    }
    return astray;
}

class ReferenceRunner final : public Runner {
public:
    ReferenceRunner(const Scene& scene, const paper::FluidConfig& config)
        : fluid_(config), step_s_(reference_step_s(scene, kLooseSound)) {
        for (const Solid& solid : scene.solids) {
            for (const paper::Polygon& piece : solid.pieces) {
                add(solid, piece);
            }
        }
        for (const Point& p : scene.particles) {
            fluid_.add_particle(p);
        }
    }
    Progress step() override {
        fluid_.step();
        return {1, step_s_};
    }
    int particles() const override { return fluid_.size(); }
    int astray() const override {
        std::vector<Point> points;
        for (int k = 0; k < fluid_.size(); ++k) {
            points.push_back(fluid_.position(k));
        }
        return count_astray(*this, paper::kMargin, fluid_.config().cells_x,
                            fluid_.config().cells_y, points.data());
    }

private:
    void add(const Solid& solid, const paper::Polygon& piece) {
        if (solid.spin_radps == 0.0F) {
            fluid_.add_static(paper::placed(piece, solid.position, solid.angle_rad));
        } else {
            fluid_.add_dynamic(piece, solid.position, solid.angle_rad,
                               solid.spin_radps * static_cast<float>(step_s_));
        }
    }

    paper::Fluid fluid_;
    double step_s_;
};

class WeirRunner final : public Runner {
public:
    weir::Status set_up(const Scene& scene, bool interaction) {
        weir::WorldDef def;
        def.capacity.particles = static_cast<std::int32_t>(scene.particles.size());
        def.capacity.cells_x = scene.cells_x;
        def.capacity.cells_y = scene.cells_y;
        if (interaction) {
            def.capacity.bodies = static_cast<std::int32_t>(scene.solids.size());
            for (const Solid& solid : scene.solids) {
                def.capacity.vertices += static_cast<std::int32_t>(solid.outline.size());
            }
        }
        def.cell_m = scene.cell_m;
        def.gravity_mps2 = {0.0F, -scene.gravity_mps2};
        memory_ = measure::memory_for<float>(def);
        weir::Status status = world_.init(def, memory_.data(), memory_.size());
        for (std::size_t k = 0; interaction && k < scene.solids.size(); ++k) {
            status = status == weir::Status::ok ? add(scene.solids[k], scene.cell_m) : status;
        }
        for (std::size_t k = 0; status == weir::Status::ok && k < scene.particles.size(); ++k) {
            const Point p = scene.particles[k];
            const Point v = scene.velocities_mps.empty() ? Point{} : scene.velocities_mps[k];
            status = world_.add_particle({p.x * scene.cell_m, p.y * scene.cell_m}, {v.x, v.y});
            // What touched a solid that has turned may be in it by a rounding: it is left out.
            const bool touched = status == weir::Status::particle_inside_solid &&
                                 !scene.velocities_mps.empty();
            status = touched ? weir::Status::ok : status;
        }
        return status;
    }
    Progress step() override {
        const weir::StepReport report = world_.step(kFrame_s);
        stepped_s_ += static_cast<double>(report.dt_s);
        return {report.substeps, static_cast<double>(report.dt_s)};
    }
    /// Liquid and turned solids as they are by now.
    void copy_to(Scene& scene) const {
        scene.particles.clear();
        scene.velocities_mps.clear();
        for (int k = 0; k < particles(); ++k) {
            const weir::Vec2f p = world_.particle_positions()[k];
            const weir::Vec2f v = world_.particle_velocities()[k];
            scene.particles.push_back({p.x, p.y});
            scene.velocities_mps.push_back({v.x * scene.cell_m, v.y * scene.cell_m});
        }
        for (Solid& solid : scene.solids) {
            solid.angle_rad += solid.spin_radps * static_cast<float>(stepped_s_);
        }
    }
    int particles() const override { return world_.particle_positions().size; }
    int astray() const override {
        std::vector<Point> points;
        for (const weir::Vec2f& p : world_.particle_positions()) {
            points.push_back({p.x, p.y});
        }
        return count_astray(*this, 0.0F, world_.cells_x(), world_.cells_y(), points.data());
    }

private:
    weir::Status add(const Solid& solid, float cell_m) {
        std::vector<weir::Vec2f> outline;
        for (const Point& p : solid.outline) {
            outline.push_back({p.x * cell_m, p.y * cell_m});
        }
        weir::BodyDef def;
        def.polygon = {outline.data(), static_cast<std::int32_t>(outline.size())};
        def.motion.position_m = {solid.position.x * cell_m, solid.position.y * cell_m};
        def.motion.angle_rad = solid.angle_rad;
        def.motion.spin_radps = solid.spin_radps;
        weir::BodyId id;
        return solid.spin_radps == 0.0F ? world_.add_static_body(def, &id)
                                        : world_.add_moving_body(def, &id);
    }

    weir::World<float> world_{};
    measure::WorldMemory memory_;
    double stepped_s_ = 0.0;
};

}  // namespace

double reference_step_s(const Scene& scene, float sound_ratio) {
    return static_cast<double>(scaling_of(scene, sound_ratio).seconds_per_step());
}

std::unique_ptr<Runner> make_reference(const Scene& scene, bool interaction,
                                       paper::Velocity velocity) {
    paper::FluidConfig config;
    config.cells_x = scene.cells_x;
    config.cells_y = scene.cells_y;
    config.interaction = interaction;
    config.velocity = velocity;
    scaling_of(scene, kLooseSound).apply(config);
    return std::make_unique<ReferenceRunner>(scene, config);
}

std::unique_ptr<Runner> make_weir(const Scene& scene, bool interaction) {
    auto runner = std::make_unique<WeirRunner>();
    const weir::Status status = runner->set_up(scene, interaction);
    if (status != weir::Status::ok) {
        std::fprintf(stderr, "weir refuses scene '%s': %s\n", scene.name.c_str(),
                     weir::status_text(status));
        return nullptr;
    }
    return runner;
}

Scene scene_after(const Scene& scene, int frames) {
    WeirRunner runner;
    if (runner.set_up(scene, true) != weir::Status::ok) {
        std::fprintf(stderr, "weir refuses scene '%s'\n", scene.name.c_str());
        std::exit(EXIT_FAILURE);
    }
    for (int frame = 0; frame < frames; ++frame) {
        runner.step();
    }
    Scene after = scene;
    runner.copy_to(after);
    return after;
}

}  // namespace paper_bench
