#include "step/momentum_ledger.hpp"

namespace weir {

namespace {

/// Particles are summed by so many, and these sums with what rounding left off (Kahan 1965): a sum
/// over a million particles is then as exact as its numbers, wherever a step is cut.
constexpr std::int32_t kSummed = 64;

/// Packed worlds have one liquid.
template <class Real>
constexpr std::int32_t kLiquids = Stored<Real>::shares_momentum ? 1 : 2;

/// Nor have they free bodies.
template <class Real>
constexpr bool kHasFreeBodies = !Stored<Real>::shares_momentum;

/// Of either liquid.
template <class Number>
struct Sums {
    Vec2<Number> velocity[2];
    Number count[2] = {};
};

/// Of particles first … end − 1, in the numbers that `as` makes of theirs.
template <class Number, class Real, class As>
Sums<Number> sums_of(const Particles<Real>& particles, std::int32_t first, std::int32_t end,
                     As as) {
    Sums<Number> sums;
    for (std::int32_t k = first; k < end; ++k) {
        const bool second = kLiquids<Real> > 1 && particles.kind != nullptr &&
                            particles.kind[k] == Liquid::second;
        const std::int32_t kind = second ? 1 : 0;
        sums.velocity[kind] = sums.velocity[kind] + as(Vec2<Real>(particles.velocity[k]));
        sums.count[kind] += Number(1);
    }
    return sums;
}

/// Of those with whom the rest is settled. What has weight the tank bears, and it lifts what lies
/// in it: free bodies have a part only where there is no gravity.
template <class Real>
Face<Real> size_of_received(const BodyLoad<Real>& load, Vec2<Real> gravity) {
    const bool weighs = gravity.x != Real(0) || gravity.y != Real(0);
    return kHasFreeBodies<Real> && weighs && load.is_free()
               ? Face<Real>(0)
               : absolute(load.received.linear.x) + absolute(load.received.linear.y);
}

template <class Real>
Face<Real> sizes_of_received(const BodyTable<Real>& table, Vec2<Real> gravity) {
    Face<Real> all = Face<Real>(0);
    for (std::int32_t slot = 0; slot <= table.capacity; ++slot) {
        all += size_of_received(table.load[slot], gravity);
    }
    return all;
}

/// Free bodies answer their part before the next pressure, as they do blows.
template <class Real>
void give(const BodyTable<Real>& table, Vec2<Real> gravity, Vec2<Face<Real>> rest) {
    const Face<Real> all = sizes_of_received(table, gravity);
    const bool any = all > Face<Real>(0);
    if (any || kLedgerRecords<Real> > 0) {
        settled(table) = settled(table) + rest;
    }
    for (std::int32_t slot = 0; any && slot <= table.capacity; ++slot) {
        BodyLoad<Real>& load = table.load[slot];
        const Vec2<Face<Real>> part = (size_of_received(load, gravity) / all) * rest;
        load.received.linear = load.received.linear + part;
        if (kHasFreeBodies<Real> && load.is_free()) {
            load.blows.linear = load.blows.linear + part;
        }
    }
}

/// The tank's record is that of a body that is not there, so it has room.
template <class Real, bool Whole = (kLedgerRecords<Real> > 0)>
struct Ledger {
    explicit Ledger(Simulation<Real>& of, bool)
        : simulation(of), tank(of.bodies.load[of.bodies.capacity]), before(tank.blows.linear),
          sum(tank.unpressed.velocity), off(tank.change.velocity), mass(tank.blow_mass) {}

    Simulation<Real>& simulation;
    BodyLoad<Real>& tank;
    Vec2<Face<Real>>& before;  ///< momentum of the liquid + received by all
    Vec2<Face<Real>>& sum;     ///< of what has been summed, the liquid's momentum
    Vec2<Face<Real>>& off;     ///< what rounding put too much into it
    Face<Real>& mass;          ///< of the same particles

    void begin() {
        sum = {};
        off = {};
        mass = Face<Real>(0);
    }
    void add(std::int32_t first, std::int32_t end) {
        const Face<Real>* masses = simulation.layers.walls.particle_mass;
        const Sums<Face<Real>> sums = sums_of<Face<Real>>(
            simulation.particles, first, end,
            [](Vec2<Real> velocity) { return convert<Face<Real>>(velocity); });
        const Vec2<Face<Real>> more =
            (masses[0] * sums.velocity[0] + masses[1] * sums.velocity[1]) - off;
        const Vec2<Face<Real>> now = sum + more;
        off = (now - sum) - more;
        sum = now;
        mass += masses[0] * sums.count[0] + masses[1] * sums.count[1];
    }
    Vec2<Face<Real>> received_by_all() const {
        const BodyTable<Real>& table = simulation.bodies;
        Vec2<Face<Real>> all;
        for (std::int32_t slot = 0; slot <= table.capacity; ++slot) {
            all = all + table.load[slot].received.linear;
        }
        return all;
    }
    void open() { before = sum + received_by_all(); }
    void close(Seconds<Real> dt_s) {
        const Vec2<Face<Real>> gravity = (mass * static_cast<Face<Real>>(dt_s)) *
                                         convert<Face<Real>>(simulation.settings.gravity);
        give(simulation.bodies, simulation.settings.gravity,
             (before + gravity) - (sum + received_by_all()));
    }
};

/// Floats as whole momentum and back, over the mass of a particle.
constexpr float kUnit = 1.0F / 4294967296.0F;
std::uint64_t whole(float momentum) {
    constexpr float kMost = 4611686018427387904.0F;  // 2⁶²
    const float units = momentum / kUnit;
    return absolute(units) < kMost ? static_cast<std::uint64_t>(static_cast<std::int64_t>(units))
                                   : 0;
}
float as_float(std::uint64_t units) {
    return kUnit * static_cast<float>(static_cast<std::int64_t>(units));
}
template <class Real>
WholeMomentum counted(const Simulation<Real>& simulation, std::int32_t slot) {
    const float each = simulation.layers.walls.particle_mass[0];
    const Vec2<float> received = simulation.bodies.load[slot].received.linear;
    return {whole(received.x / each), whole(received.y / each)};
}
template <class Real>
WholeMomentum counted_before(const Simulation<Real>& simulation, std::int32_t end) {
    WholeMomentum sum;
    for (std::int32_t slot = 0; slot < end; ++slot) {
        sum = sum + counted(simulation, slot);
    }
    return sum;
}

/// Of gravity in a substep: whole raw numbers of a velocity.
std::uint64_t fall(std::int32_t gravity, std::int32_t dt, std::int32_t& owed) {
    constexpr int kShift = Seconds<Fixed>::fraction;
    const std::int64_t exact = fixed::wide_product(gravity, dt) + owed;
    owed = static_cast<std::int32_t>(exact & ((std::int64_t{1} << kShift) - 1));
    return static_cast<std::uint64_t>(exact >> kShift);
}

template <class Real>
struct Ledger<Real, true> {
    Ledger(Simulation<Real>& of, bool opens)
        : simulation(of), book(whole_ledger(of.bodies)), opens_(opens) {}

    Simulation<Real>& simulation;
    WholeLedger& book;

    /// Before its first substep a step has forgotten what all received: that sum is forgotten, too.
    void begin() {
        const WholeMomentum none;
        book.weight = 0;
        if (opens_ && !any_received()) {
            book.received = none;
        }
    }
    /// All receive what the liquid had and has no longer.
    void add(std::int32_t first, std::int32_t end) {
        const Settings<Real>& settings = simulation.settings;
        const Sums<std::uint64_t> sums = sums_of<std::uint64_t>(
            simulation.particles, first, end, [](Vec2<Real> velocity) {
                return convert<std::uint64_t>(Vec2<std::int32_t>{velocity.x.raw, velocity.y.raw});
            });
        for (std::int32_t kind = 0; kind < kLiquids<Real>; ++kind) {
            const std::uint64_t each = whole_weight(settings, kind == 1);
            const WholeMomentum momentum = each * sums.velocity[kind];
            book.received = opens_ ? book.received + momentum : book.received - momentum;
            book.weight += each * sums.count[kind];
        }
    }
    void open() {}
    void close(Seconds<Real> dt_s) {
        const BodyTable<Real>& table = simulation.bodies;
        const Vec2<Real> g = simulation.settings.gravity;
        const WholeMomentum gravity =
            book.weight * WholeMomentum{fall(g.x.raw, dt_s.raw, book.owed.x),
                                        fall(g.y.raw, dt_s.raw, book.owed.y)};
        book.gravity = book.gravity + gravity;
        book.received = book.received + gravity;
        give(table, g,
             in_floats(book.received - counted_before(simulation, table.capacity + 1)));
        tank_received(table).linear =
            in_floats(book.received - counted_before(simulation, table.capacity));
    }

private:
    bool any_received() const {
        const BodyTable<Real>& table = simulation.bodies;
        bool any = false;
        for (std::int32_t slot = 0; slot <= table.capacity; ++slot) {
            const Vec2<float> received = table.load[slot].received.linear;
            any = any || received.x != 0.0F || received.y != 0.0F;
        }
        return any;
    }
    Vec2<float> in_floats(WholeMomentum momentum) const {
        const float each = simulation.layers.walls.particle_mass[0];
        return {each * as_float(momentum.x), each * as_float(momentum.y)};
    }

    bool opens_;
};

template <class Real>
void sum_liquid(Simulation<Real>& simulation, Ledger<Real>& ledger, Work work) {
    if (work.once(1)) {
        ledger.begin();
    }
    const std::int32_t count = simulation.particles.count;
    const Part part = work.take((count + kSummed - 1) / kSummed, kSummed);
    for (std::int32_t at = part.first; at < part.end; ++at) {
        ledger.add(kSummed * at, minimum(kSummed * (at + 1), count));
    }
}

}  // namespace

template <class Real>
WholeMomentum whole_received(const Simulation<Real>& simulation, std::int32_t slot) {
    const BodyTable<Real>& table = simulation.bodies;
    return slot < table.capacity
               ? counted(simulation, slot)
               : whole_ledger(table).received - counted_before(simulation, table.capacity);
}

template <class Real>
void open_ledger(Simulation<Real>& simulation, Work work) {
    Ledger<Real> ledger(simulation, true);
    sum_liquid(simulation, ledger, work);
    if (work.once(simulation.bodies.capacity + 1)) {
        ledger.open();
    }
}

template <class Real>
void close_ledger(Simulation<Real>& simulation, Seconds<Real> dt_s, Work work) {
    Ledger<Real> ledger(simulation, false);
    sum_liquid(simulation, ledger, work);
    if (work.once(simulation.bodies.capacity + 1)) {
        ledger.close(dt_s);
    }
}

#define WEIR_INSTANTIATE(Real)                                                      \
    template WholeMomentum whole_received(const Simulation<Real>&, std::int32_t);
WEIR_INSTANTIATE(Fixed)
WEIR_FOR_PACKED(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

#define WEIR_INSTANTIATE(Real)                                          \
    template void open_ledger(Simulation<Real>&, Work);                 \
    template void close_ledger(Simulation<Real>&, Seconds<Real>, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
