// The library as a scheme: World with cell_m = 1, so that metres are cells.
#include "weir_scheme.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <new>
#include <stdexcept>

#include "measure/world_memory.hpp"
#include "weir/weir.hpp"
#include "world/world_state.hpp"

namespace accuracy {

namespace {

/// Enough for any interval here: no scheme shall be softened behind the problem's back.
constexpr std::int32_t kMostSubsteps = 1000;

/// Of an interval, by its parts.
constexpr double kRounding = 1e-5;

float narrow(double value) {
    return static_cast<float>(value);
}

weir::WorldDef definition(const Setup& setup, weir::Pressure pressure, std::size_t particles) {
    weir::WorldDef def;
    def.capacity.particles = static_cast<std::int32_t>(particles);
    def.capacity.cells_x = setup.nx;
    def.capacity.cells_y = setup.ny;
    def.cell_m = 1.0F;
    def.gravity_mps2 = {narrow(setup.gravity.x), narrow(setup.gravity.y)};
    def.pressure = pressure;
    def.max_substeps = kMostSubsteps;
    const Options& options = setup.options;
    def.pressure_sweeps = options.sweeps < 0 ? def.pressure_sweeps : options.sweeps;
    def.cfl = options.cfl < 0.0 ? def.cfl : narrow(options.cfl);
    def.flip_ratio = options.flip_ratio < 0.0 ? def.flip_ratio : narrow(options.flip_ratio);
    def.volume_gain = options.volume_gain < 0.0 ? def.volume_gain : narrow(options.volume_gain);
    def.sound_speed_mps = narrow(setup.sound_speed * options.sound_scale);
    def.periodic_x = setup.periodic_x;
    def.periodic_y = setup.periodic_y;
    def.viscosity_m2ps = narrow(setup.viscosity);
    def.walls = weir::every_wall({0.0F, 0.0F, setup.no_slip, 0.0F});
    def.walls.top.conveyor_mps = -narrow(setup.slide_top);
    def.top_speed_mps = narrow(setup.top_speed);
    return def;
}

template <class Real>
class WeirScheme final : public Scheme {
public:
    explicit WeirScheme(weir::Pressure pressure) : pressure_(pressure) {}

    void start(const Setup& setup, const Particles& particles) override {
        const weir::WorldDef def = definition(setup, pressure_, particles.size());
        memory_ = measure::memory_for<Real>(def);
        check(world_.init(def, memory_.data(), memory_.size()));
        for (const Particle& p : particles) {
            check(world_.add_particle({narrow(p.x.x), narrow(p.x.y)},
                                      {narrow(p.v.x), narrow(p.v.y)}));
        }
        periodic_x_ = setup.periodic_x;
        periodic_y_ = setup.periodic_y;
        replace(particles);
        step_ = narrow(setup.interval * setup.options.step_scale);
        interval_ = static_cast<double>(step_);
        reset_clock();
        reset_ = 0;
        limited_ = 0;
    }

    void advance() override {
        const auto begin = std::chrono::steady_clock::now();
        const weir::StepReport report = world_.step(step_);
        const auto end = std::chrono::steady_clock::now();
        seconds_ += std::chrono::duration<double>(end - begin).count();
        time_ += interval_;
        steps_ += report.substeps;
        own_step_ = interval_ / report.substeps;
        reset_ += report.particles_reset;
        limited_ += report.has(weir::Clamped::speed) ? 1 : 0;
        if (std::fabs(double(report.dt_s) / interval_ - 1.0) > kRounding) {
            throw std::runtime_error("the library shortened a step");
        }
    }

    Particles particles() const override {
        const auto x = world_.particle_positions();
        const auto v = world_.particle_velocities();
        const double scale = double(world_.velocity_scale());
        Particles result(static_cast<std::size_t>(x.size));
        for (std::int32_t k = 0; k < x.size; ++k) {
            result[static_cast<std::size_t>(k)] = {{double(x[k].x), double(x[k].y)},
                                                   scale * Vector{double(v[k].x), double(v[k].y)}};
        }
        return result;
    }

    /// The face takes particles in float and one at a time; the state behind it is at the head of
    /// the memory.
    void replace(const Particles& particles) override {
        weir::Simulation<Real>& simulation = state().simulation;
        const double unit = double(weir::detail::unit_of(state()));
        Real fastest = Real(0);
        for (std::size_t k = 0; k < particles.size(); ++k) {
            const Particle& p = particles[k];
            const weir::GridShape& tank = simulation.grid.shape;
            const weir::Vec2<Real> v{Real(unit * p.v.x), Real(unit * p.v.y)};
            simulation.particles.position[k] = weir::Vec2<Real>{
                inside(p.x.x, tank.nx, periodic_x_), inside(p.x.y, tank.ny, periodic_y_)};
            simulation.particles.velocity[k] = v;
            fastest = weir::maximum(fastest, weir::absolute(v.x));
            fastest = weir::maximum(fastest, weir::absolute(v.y));
        }
        simulation.max_speed = fastest;
    }

    void set_gravity(Vector gravity) override {
        check(world_.set_gravity({narrow(gravity.x), narrow(gravity.y)}));
    }

    double pressure(int i, int j) const override {
        return double(world_.pressure().at(i, j)) * double(world_.pressure_scale());
    }

    bool compressible() const override {
        return pressure_ == weir::Pressure::equation_of_state;
    }

private:
    using State = weir::detail::WorldState<Real>;

    static Real inside(double x, std::int32_t cells, bool periodic) {
        if (periodic) {
            const Real size = static_cast<Real>(cells);
            return Real(x) < size ? Real(x) : Real(x) - size;
        }
        return weir::clamp(Real(x), weir::kWallGap<Real>, Real(cells) - weir::kWallGap<Real>);
    }
    State& state() { return *std::launder(static_cast<State*>(static_cast<void*>(memory_.data()))); }
    static void check(weir::Status status) {
        if (status != weir::Status::ok) {
            throw Unable(weir::status_text(status));
        }
    }

    weir::Pressure pressure_;
    weir::World<Real> world_{};
    measure::WorldMemory memory_;
    float step_ = 0.0F;
    bool periodic_x_ = false;
    bool periodic_y_ = false;
};

}  // namespace

std::unique_ptr<Scheme> make_weir(bool projection, Format format) {
    const weir::Pressure pressure =
        projection ? weir::Pressure::projection : weir::Pressure::equation_of_state;
    switch (format) {
        case Format::in_double: return std::make_unique<WeirScheme<double>>(pressure);
        case Format::fixed: return std::make_unique<WeirScheme<weir::Fixed>>(pressure);
        case Format::small_fixed: return std::make_unique<WeirScheme<weir::SmallFixed>>(pressure);
        case Format::in_float: break;
    }
    return std::make_unique<WeirScheme<float>>(pressure);
}

}  // namespace accuracy
