// The paper's own liquid step (tests/reference) as a scheme: it counts in cells and steps, so
// velocities and gravity are scaled by its step on the way in and out.
#include "reference_scheme.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "paper_scaling.hpp"
#include "reference_pressure.hpp"

namespace accuracy {

namespace {

/// Way of sound in a step, cells; paper_scaling.hpp says why.
constexpr double kSoundCfl = 0.5;

class ReferenceScheme final : public Scheme {
public:
    void start(const Setup& setup, const Particles& particles) override {
        if (setup.periodic_x || setup.periodic_y || setup.viscosity > 0.0 || setup.no_slip) {
            throw Unable("the paper's method has no periodic tank and no viscosity");
        }
        interval_ = setup.interval * setup.options.step_scale;
        const double sound = setup.sound_speed * setup.options.sound_scale;
        substeps_ = std::max(1, static_cast<int>(std::ceil(interval_ * sound / kSoundCfl)));
        step_ = interval_ / substeps_;
        own_step_ = step_;
        config_ = {};
        config_.cells_x = setup.nx;
        config_.cells_y = setup.ny;
        const double cfl = sound * step_;
        config_.stiffness = static_cast<float>(cfl * cfl);
        config_.viscosity = paper::kShearShare * static_cast<float>(cfl);
        config_.bulk_viscosity = paper::kBulkShare * static_cast<float>(cfl);
        config_.gravity = in_steps(setup.gravity, step_ * step_);
        replace(particles);
        reset_clock();
    }

    void advance() override {
        const auto begin = std::chrono::steady_clock::now();
        for (int k = 0; k < substeps_; ++k) {
            fluid_->step();
        }
        const auto end = std::chrono::steady_clock::now();
        seconds_ += std::chrono::duration<double>(end - begin).count();
        time_ += interval_;
        steps_ += substeps_;
        pressure_known_ = false;
    }

    Particles particles() const override {
        Particles result(static_cast<std::size_t>(fluid_->size()));
        for (int k = 0; k < fluid_->size(); ++k) {
            const paper::Point x = fluid_->position(k);
            const paper::Point v = fluid_->velocity(k);
            result[static_cast<std::size_t>(k)] = {{double(x.x), double(x.y)},
                                                   {double(v.x) / step_, double(v.y) / step_}};
        }
        return result;
    }

    /// Between steps its state is the particles and nothing else: a new one goes on as the old.
    void replace(const Particles& particles) override {
        fluid_ = std::make_unique<paper::Fluid>(config_);
        for (const Particle& p : particles) {
            fluid_->add_particle({static_cast<float>(p.x.x), static_cast<float>(p.x.y)},
                                 in_steps(p.v, step_));
        }
        pressure_known_ = false;
    }

    void set_gravity(Vector gravity) override {
        config_.gravity = in_steps(gravity, step_ * step_);
        replace(particles());
    }

    double pressure(int i, int j) const override {
        if (!pressure_known_) {
            pressure_.compute(*fluid_);
            pressure_known_ = true;
        }
        return pressure_.at(i, j) / (step_ * step_);
    }

    bool compressible() const override { return true; }

private:
    static paper::Point in_steps(Vector v, double scale) {
        return {static_cast<float>(v.x * scale), static_cast<float>(v.y * scale)};
    }

    paper::FluidConfig config_;
    std::unique_ptr<paper::Fluid> fluid_;
    int substeps_ = 1;
    double step_ = 0.0;
    mutable ReferencePressure pressure_;
    mutable bool pressure_known_ = false;
};

}  // namespace

std::unique_ptr<Scheme> make_reference() {
    return std::make_unique<ReferenceScheme>();
}

}  // namespace accuracy
