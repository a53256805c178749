// S16: numbers that are none, through every door: refused with a name, or contained and reported.
#include <limits>

#include "cases.hpp"

namespace stability {

using weir::Clamped;
using weir::Status;
using weir::StepReport;
using weir::Vec2f;

namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

template <class Real>
class Doors {
public:
    Doors(Report& report, const Scheme& scheme)
        : report_(report),
          name_(label<Real>("S16", scheme)),
          dt_s_(scheme.dt_s()),
          tank_(tank_def(scheme, 16, 16, 600, 2, 8)) {
        tank_.add_static({{10, -1}, {14, -1}, {12, 3}}, {0, 0});
        paddle_ = tank_.add_moving({{-2, -1}, {2, -1}, {2, 1}, {-2, 1}}, {8, 12}, {0, 0}, 1);
        tank_.fill(0, 0, 8, 8);
        tank_.run(5, dt_s_);
    }

    void refused_particles() {
        unchanged("add_particle", [&] {
            bool all = true;
            for (const float bad : {kNan, kInf, -kInf}) {
                all = all && add({bad, 0.1F}, {0, 0}) == Status::particle_not_finite &&
                      add({0.1F, bad}, {0, 0}) == Status::particle_not_finite &&
                      add({0.1F, 0.1F}, {bad, 0}) == Status::particle_not_finite &&
                      add({0.1F, 0.1F}, {0, bad}) == Status::particle_not_finite;
            }
            return all && add({0.1F, 0.1F}, {1e30F, 0}) == Status::velocity_out_of_range &&
                   add({-1e30F, 0.1F}, {0, 0}) == Status::particle_outside_domain;
        });
        unchanged("remove_particle", [&] {
            const std::int32_t count = tank_.particles();
            auto& world = tank_.world();
            return world.remove_particle(-1) == Status::no_such_particle &&
                   world.remove_particle(count) == Status::no_such_particle &&
                   world.remove_particle(2147483647) == Status::no_such_particle;
        });
        unchanged("fill", [&] {
            auto& world = tank_.world();
            return world.fill({{kNan, 0}, {0.1F, 0.1F}}) == Status::box_not_finite &&
                   world.fill({{0, 0}, {0.1F, kInf}}) == Status::box_not_finite &&
                   world.fill({{0.1F, 0.1F}, {0, 0}}) == Status::box_is_empty;
        });
        unchanged("set_motion", [&] {
            auto& world = tank_.world();
            bool all = true;
            for (const float bad : {kNan, kInf}) {
                all = all &&
                      world.set_motion(paddle_, {{bad, 0}, 0, {0, 0}, 0}) ==
                          Status::motion_not_finite &&
                      world.set_motion(paddle_, {{0, 0}, bad, {0, 0}, 0}) ==
                          Status::motion_not_finite &&
                      world.set_motion(paddle_, {{0, 0}, 0, {0, bad}, 0}) ==
                          Status::motion_not_finite &&
                      world.set_motion(paddle_, {{0, 0}, 0, {0, 0}, bad}) ==
                          Status::motion_not_finite;
            }
            return all && world.set_motion(paddle_, {{0, 0}, 0, {1e30F, 0}, 0}) ==
                              Status::motion_out_of_range;
        });
        tank_.run(20, dt_s_);
    }

    void gravity() {
        for (const float bad : {kNan, kInf, -kInf}) {
            report_.holds(name_ + ".gravity.refused",
                          tank_.world().set_gravity({0, bad}) == Status::gravity_not_finite);
            report_.holds(name_ + ".gravity.reported", tank_.step(dt_s_).has(Clamped::gravity));
            report_.holds(name_ + ".gravity.reported_once",
                          !tank_.step(dt_s_).has(Clamped::gravity));
        }
        const bool taken = tank_.world().set_gravity({1e30F, -1e30F}) == Status::ok;
        const StepReport report = tank_.step(dt_s_);
        report_.holds(name_ + ".gravity.limited", taken && report.has(Clamped::gravity));
        tank_.run(60, dt_s_);
        tank_.set_gravity({0, -9.81F});
    }

    void time_steps() {
        const std::uint64_t before = tank_.world().state_hash();
        report_.holds(name_ + ".dt.pause_is_none", !tank_.step(0.0F).has(Clamped::time_step));
        for (const float bad : {kNan, kInf, -kInf, -1.0F, 1e-30F}) {
            const StepReport report = tank_.step(bad);
            report_.holds(name_ + ".dt.reported", report.has(Clamped::time_step));
        }
        report_.holds(name_ + ".dt.nothing_happened", tank_.world().state_hash() == before);
        const StepReport report = tank_.step(1e30F);
        report_.holds(name_ + ".dt.shortened",
                      report.has(Clamped::time_step) && report.dt_s > 0 && report.dt_s < 10);
        tank_.run(60, dt_s_);
    }

    /// Memory goes bad under the world: a velocity becomes NaN or infinite, or in fixed point,
    /// where every bit pattern is a number, the largest that there is: packed ones bear it.
    void bad_memory() {
        using Velocity = weir::VelocityOf<Real>;
        if constexpr (kIsFixed<Real>) {
            using Bits = decltype(Velocity::raw);
            for (const Bits bad : {std::numeric_limits<Bits>::max(),
                                   std::numeric_limits<Bits>::min()}) {
                const std::int32_t slowed = step_with(Velocity::of_raw(bad)).particles_slowed;
                report_.at_least(name_ + ".bad_memory.particles_slowed", slowed, "1",
                                 std::is_same<Real, weir::Fixed>::value ? 1 : 0);
            }
        } else {
            for (const Velocity bad : {std::numeric_limits<Velocity>::quiet_NaN(),
                                       std::numeric_limits<Velocity>::infinity()}) {
                const StepReport report = step_with(bad);
                report_.at_least(name_ + ".bad_memory.particles_reset", report.particles_reset,
                                 "1", 1);
                report_.holds(name_ + ".bad_memory.reported", report.has(Clamped::not_finite));
            }
        }
        // Put to rest where they were: everything is sound again in the next step, and moves.
        report_.holds(name_ + ".bad_memory.over", !tank_.step(dt_s_).has(Clamped::not_finite));
        tank_.set_gravity({9.81F, 0.0F});
        tank_.run(60, dt_s_);
        report_.at_least(name_ + ".bad_memory.flows_again", tank_.rms_speed(), "cells/s", 1.0);
    }

    void finish() {
        Bounds bounds = kNoEnergy;
        bounds.resets = true;
        report_.run(name_, tank_.tally(), bounds);
    }

private:
    Status add(Vec2f at_m, Vec2f velocity) { return tank_.world().add_particle(at_m, velocity); }

    StepReport step_with(weir::VelocityOf<Real> bad) {
        const auto view = tank_.world().particle_velocities();
        const_cast<weir::Vec2<weir::VelocityOf<Real>>*>(view.data)[view.size / 2].x = bad;
        return tank_.step(dt_s_);
    }

    template <class Call>
    void unchanged(const char* what, Call call) {
        const std::uint64_t before = tank_.world().state_hash();
        report_.holds(name_ + "." + what + ".refused", call());
        report_.holds(name_ + "." + what + ".changes_nothing",
                      tank_.world().state_hash() == before);
    }

    Report& report_;
    std::string name_;
    float dt_s_;
    Tank<Real> tank_;
    weir::BodyId paddle_;
};

}  // namespace

void bad_numbers(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, true, [&](const Scheme& scheme, auto real) {
        Doors<decltype(real)> doors(report, scheme);
        doors.refused_particles();
        doors.gravity();
        doors.time_steps();
        doors.bad_memory();
        doors.finish();
    });
}

}  // namespace stability
