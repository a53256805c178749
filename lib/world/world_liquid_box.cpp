// The liquid in a box: taken out, measured, stirred, tagged.
#include <type_traits>

#include "weir/world.hpp"
#include "world/world_liquid.hpp"

namespace weir {

namespace {

/// Whether a call may go by that box and those liquids now.
template <class Real>
Status check_choice(const detail::WorldState<Real>* state, const Box& box_m, Liquids of) {
    const Status valid = check_box_in(state, box_m);
    if (valid != Status::ok || of == Liquids::all || of == Liquids::first) {
        return valid;
    }
    if (of != Liquids::second) {
        return Status::unknown_option;
    }
    return state->def.capacity.second_liquid ? Status::ok : Status::no_second_liquid;
}

/// What a call is about: the particles in a box that are of some liquids.
template <class Real>
class Chosen {
public:
    Chosen(const detail::WorldState<Real>& state, const Box& box_m, Liquids of)
        : particles_(state.simulation.particles), box_(state, box_m),
          one_alone_(of != Liquids::all && particles_.kind != nullptr),
          kind_(of == Liquids::second ? Liquid::second : Liquid::first) {}

    bool holds(std::int32_t k) const {
        return box_.holds(particles_.position[k]) && !(one_alone_ && particles_.kind[k] != kind_);
    }
    /// Of the particles from that one on, visit(index) for each that is.
    template <class Visit>
    void for_each(std::int32_t first, Visit visit) const {
        for (std::int32_t k = first; k < particles_.count; ++k) {
            if (holds(k)) {
                visit(k);
            }
        }
    }

private:
    const Particles<Real>& particles_;
    BoxInCells<Real> box_;
    bool one_alone_;
    Liquid kind_;
};

/// A sum over many numbers of one kind, exact in fixed point, in double else.
template <class Number>
class Mean {
public:
    void add(Number number) {
        if constexpr (std::is_floating_point<Number>::value) {
            sum_ += static_cast<double>(number);
        } else {
            sum_ += number.raw;
        }
    }
    float over(std::int32_t count) const {
        const float mean = static_cast<float>(sum_) / static_cast<float>(count);
        if constexpr (std::is_floating_point<Number>::value) {
            return mean;
        } else {
            return mean * static_cast<float>(Number::of_raw(1));
        }
    }

private:
    std::conditional_t<std::is_floating_point<Number>::value, double, std::int64_t> sum_{};
};

/// Velocities that come nearer to another one. In fixed point what is left of the difference is
/// rounded towards zero: with any share that counts the last digits get there, too.
template <class Real>
class Approach {
public:
    Approach(Vec2<Real> to, float share)
        : to_{VelocityOf<Real>(to.x), VelocityOf<Real>(to.y)},
          left_(static_cast<Left>(kWhole * (1.0F - share))) {}

    Vec2<VelocityOf<Real>> from(Vec2<VelocityOf<Real>> v) const {
        return {nearer(v.x, to_.x), nearer(v.y, to_.y)};
    }

private:
    static constexpr bool kFloats = std::is_floating_point<Real>::value;
    static constexpr float kWhole = kFloats ? 1.0F : 32768.0F;
    using Left = std::conditional_t<kFloats, Real, std::int32_t>;
    using Product = std::conditional_t<Stored<Real>::coarse, std::int32_t, std::int64_t>;

    VelocityOf<Real> nearer(VelocityOf<Real> v, VelocityOf<Real> to) const {
        if constexpr (kFloats) {
            return to + (v - to) * left_;
        } else {
            const Product way = Product{v.raw} - to.raw;
            v.raw = static_cast<decltype(v.raw)>(to.raw + way * left_ / Product{1 << 15});
            return v;
        }
    }

    Vec2<VelocityOf<Real>> to_;
    Left left_;
};

}  // namespace

template <class Real>
Status World<Real>::drain(const Box& box_m, std::int32_t* removed, Liquids of) {
    const Status valid = check_choice(state_, box_m, of);
    if (valid != Status::ok) {
        return valid;
    }
    Simulation<Real>& simulation = state_->simulation;
    const Chosen<Real> chosen(*state_, box_m, of);
    const std::int32_t before = simulation.particles.count;
    for (std::int32_t k = before - 1; k >= 0; --k) {  // who takes a place was looked at
        if (chosen.holds(k)) {
            take_out(simulation, k);
        }
    }
    const std::int32_t gone = before - simulation.particles.count;
    if (gone > 0) {
        note_changed(*state_);
    }
    if (removed != nullptr) {
        *removed = gone;
    }
    return Status::ok;
}

template <class Real>
Status World<Real>::liquid_in(const Box& box_m, LiquidIn* found, Liquids of) const {
    const Status valid = check_choice(state_, box_m, of);
    if (valid != Status::ok) {
        return valid;
    }
    if (found == nullptr) {
        return Status::output_missing;
    }
    const Particles<Real>& particles = state_->simulation.particles;
    Mean<PositionOf<Real>> x, y;
    Mean<VelocityOf<Real>> u, v;
    *found = {};
    Chosen<Real>(*state_, box_m, of).for_each(0, [&](std::int32_t k) {
        ++found->particles;
        x.add(particles.position[k].x);
        y.add(particles.position[k].y);
        u.add(particles.velocity[k].x);
        v.add(particles.velocity[k].y);
    });
    if (found->particles > 0) {
        const std::int32_t n = found->particles;
        const float cell_m = state_->def.cell_m;
        const float mps = velocity_scale();
        found->area_m2 = static_cast<float>(n) * cell_m * cell_m /
                         static_cast<float>(state_->def.particles_per_cell);
        found->centroid_m = {x.over(n) * cell_m, y.over(n) * cell_m};
        found->velocity_mps = {u.over(n) * mps, v.over(n) * mps};
    }
    return Status::ok;
}

template <class Real>
Status World<Real>::stir(const Box& box_m, Vec2f velocity_mps, float share, Liquids of) {
    const Status valid = check_choice(state_, box_m, of);
    if (valid != Status::ok) {
        return valid;
    }
    if (!in_range(*state_, velocity_mps)) {
        return Status::velocity_out_of_range;
    }
    if (!within(share, 0.0F, 1.0F)) {
        return Status::share_out_of_range;
    }
    const bool calms = velocity_mps.x == 0.0F && velocity_mps.y == 0.0F;
    if (calms && is_asleep(*state_)) {
        return Status::ok;
    }
    Simulation<Real>& simulation = state_->simulation;
    const Particles<Real>& particles = simulation.particles;
    Regions<Real>* const regions = simulation.regions;
    const Vec2<Real> velocity = inner_velocity(*state_, velocity_mps);
    const Approach<Real> approach(velocity, share);
    const std::int32_t first = calms && regions != nullptr ? regions->asleep : 0;
    bool any = false;
    Chosen<Real>(*state_, box_m, of).for_each(first, [&](std::int32_t k) {
        particles.velocity[k] = approach.from(particles.velocity[k]);
        any = true;
        if (!calms && regions != nullptr) {
            regions->stages->touch_at(*regions, particles.position[k]);
        }
    });
    if (any && !calms) {
        note_speed(simulation, velocity);
        wake(*state_);
    }
    return Status::ok;
}

template <class Real>
Status World<Real>::tag(const Box& box_m, std::uint8_t tag, Liquids of) {
    const Status valid = check_choice(state_, box_m, of);
    if (valid != Status::ok) {
        return valid;
    }
    const Particles<Real>& particles = state_->simulation.particles;
    if (particles.tag == nullptr) {
        return Status::no_particle_tags;
    }
    Chosen<Real>(*state_, box_m, of).for_each(0, [&](std::int32_t k) { particles.tag[k] = tag; });
    return Status::ok;
}

#define WEIR_INSTANTIATE(Real)                                                    \
    template Status World<Real>::tag(const Box&, std::uint8_t, Liquids);          \
    template Status World<Real>::drain(const Box&, std::int32_t*, Liquids);       \
    template Status World<Real>::liquid_in(const Box&, LiquidIn*, Liquids) const; \
    template Status World<Real>::stir(const Box&, Vec2f, float, Liquids);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
