#include "step/momentum_ledger.hpp"

namespace weir {

namespace {

/// Particles are summed by so many, and these sums with what rounding left off (Kahan 1965): a sum
/// over a million particles is then as exact as its numbers, wherever a step is cut.
constexpr std::int32_t kSummed = 64;

/// The tank's record is that of a body that is not there, so it has room.
template <class Real>
struct Ledger {
    explicit Ledger(const BodyTable<Real>& table)
        : Ledger(table.load[table.capacity]) {}
    explicit Ledger(BodyLoad<Real>& tank)
        : before(tank.blows.linear), sum(tank.unpressed.velocity), off(tank.change.velocity),
          mass(tank.blow_mass) {}

    Vec2<Face<Real>>& before;  ///< momentum of the liquid + received by all
    Vec2<Face<Real>>& sum;     ///< of what has been summed, the liquid's momentum
    Vec2<Face<Real>>& off;     ///< what rounding put too much into it
    Face<Real>& mass;          ///< of the same particles
};

/// Particles first … end − 1 give their momentum.
template <class Real>
void add_particles(const Simulation<Real>& simulation, std::int32_t first, std::int32_t end,
                   Ledger<Real>& ledger) {
    const Particles<Real>& particles = simulation.particles;
    const Face<Real>* masses = simulation.layers.walls.particle_mass;
    Vec2<Face<Real>> velocity[2];
    Face<Real> count[2] = {};
    for (std::int32_t k = first; k < end; ++k) {
        const std::int32_t kind =
            particles.kind != nullptr && particles.kind[k] == Liquid::second ? 1 : 0;
        velocity[kind] = velocity[kind] + convert<Face<Real>>(Vec2<Real>(particles.velocity[k]));
        count[kind] += Face<Real>(1);
    }
    const Vec2<Face<Real>> more =
        (masses[0] * velocity[0] + masses[1] * velocity[1]) - ledger.off;
    const Vec2<Face<Real>> sum = ledger.sum + more;
    ledger.off = (sum - ledger.sum) - more;
    ledger.sum = sum;
    ledger.mass += masses[0] * count[0] + masses[1] * count[1];
}

template <class Real>
void sum_liquid(Simulation<Real>& simulation, Ledger<Real>& ledger, Work work) {
    if (work.once(1)) {
        ledger.sum = {};
        ledger.off = {};
        ledger.mass = Face<Real>(0);
    }
    const std::int32_t count = simulation.particles.count;
    const Part part = work.take((count + kSummed - 1) / kSummed, kSummed);
    for (std::int32_t at = part.first; at < part.end; ++at) {
        add_particles(simulation, kSummed * at, minimum(kSummed * (at + 1), count), ledger);
    }
}

template <class Real>
Vec2<Face<Real>> received_by_all(const BodyTable<Real>& table) {
    Vec2<Face<Real>> sum;
    for (std::int32_t slot = 0; slot <= table.capacity; ++slot) {
        sum = sum + table.load[slot].received.linear;
    }
    return sum;
}

template <class Real>
Face<Real> size_of_received(const BodyLoad<Real>& load) {
    return load.is_free() ? Face<Real>(0)
                          : absolute(load.received.linear.x) + absolute(load.received.linear.y);
}

template <class Real>
void give(const BodyTable<Real>& table, Vec2<Face<Real>> rest) {
    Face<Real> all = Face<Real>(0);
    for (std::int32_t slot = 0; slot <= table.capacity; ++slot) {
        all += size_of_received(table.load[slot]);
    }
    if (!(all > Face<Real>(0))) {
        return;
    }
    settled(table) = settled(table) + rest;
    for (std::int32_t slot = 0; slot <= table.capacity; ++slot) {
        BodyLoad<Real>& load = table.load[slot];
        load.received.linear = load.received.linear + (size_of_received(load) / all) * rest;
    }
}

}  // namespace

template <class Real>
void open_ledger(Simulation<Real>& simulation, Work work) {
    Ledger<Real> ledger(simulation.bodies);
    sum_liquid(simulation, ledger, work);
    if (work.once(simulation.bodies.capacity + 1)) {
        ledger.before = ledger.sum + received_by_all(simulation.bodies);
    }
}

template <class Real>
void close_ledger(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work) {
    Ledger<Real> ledger(simulation.bodies);
    sum_liquid(simulation, ledger, work);
    if (work.once(simulation.bodies.capacity + 1)) {
        const Vec2<Face<Real>> gravity =
            (ledger.mass * static_cast<Face<Real>>(dt_s)) *
            convert<Face<Real>>(simulation.settings.gravity);
        give(simulation.bodies, (ledger.before + gravity) -
                                    (ledger.sum + received_by_all(simulation.bodies)));
    }
}

#define WEIR_INSTANTIATE(Real)                                          \
    template void open_ledger(Simulation<Real>&, Work);                 \
    template void close_ledger(Simulation<Real>&, Seconds<Real>, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
