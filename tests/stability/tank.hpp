// A world under watch: after each step everything that must hold is looked at and counted. Scenes
// are written in cells; a cell's edge is a power of two of a metre, so nothing is rounded between.
#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "measure/world_memory.hpp"
#include "weir/weir.hpp"

namespace stability {

inline constexpr float kCell = 1.0F / 64.0F;
inline constexpr float kFrame = 1.0F / 60.0F;

/// What is run: how volume is kept, where walls are, in which arithmetic.
struct Scheme {
    weir::Pressure pressure = weir::Pressure::projection;
    weir::Contour contour = weir::Contour::interpolated;

    bool elastic() const { return pressure == weir::Pressure::equation_of_state; }
    /// A frame for the projection, a quarter of it for the equation of state.
    float dt_s() const { return elastic() ? 0.25F * kFrame : kFrame; }
    std::string name() const;
};

/// In which arithmetic; `usual`: float, and double where a case asks for both.
enum class Scalar { usual, single, twice, fixed, small_fixed };

template <class Real>
inline constexpr bool kIsFixed = !std::is_floating_point<Real>::value;

/// Numbers in which a tank is looked at: its own, but for fixed point, which is what is looked at.
template <class Real>
using Look = std::conditional_t<kIsFixed<Real>, double, Real>;

/// What a number is known to: the last digit of fixed point; 0 for others.
template <class Number>
constexpr double unit_of() {
    if constexpr (std::is_floating_point<Number>::value) {
        return 0.0;
    } else {
        return static_cast<double>(Number::of_raw(1));
    }
}

/// A world's answer that was not expected.
class Refused : public std::runtime_error {
public:
    explicit Refused(weir::Status status)
        : std::runtime_error(std::string("refused: ") + weir::status_text(status)),
          status_(status) {}
    weir::Status status() const { return status_; }

private:
    weir::Status status_;
};

using Ring = std::vector<weir::Vec2f>;

/// A world's definition for the scheme: water, sound at 10 m/s, room for substeps.
weir::WorldDef tank_def(const Scheme& scheme, std::int32_t cells_x, std::int32_t cells_y,
                        std::int32_t particles, std::int32_t bodies = 0,
                        std::int32_t vertices = 0);

/// What was seen, over all steps so far. Particles that stay wrong are counted in every step.
struct Tally {
    std::int64_t steps = 0;
    std::int64_t substeps = 0;
    std::int64_t not_finite = 0;
    std::int64_t outside = 0;
    std::int64_t lost = 0;          ///< steps after which particles are missing, not by report
    std::int64_t removed = 0;       ///< particles that the report says had no way out of a solid
    std::int64_t reset = 0;
    std::int64_t slowed = 0;
    std::int64_t inconsistent = 0;  ///< steps whose report contradicts the state or itself
    std::uint32_t clamped = 0;
    double energy_ratio = 0.0;      ///< highest energy, of what was put in since gravity turned
    double energy_of_all = 0.0;     ///< the same, with what was lost before that
    double deepest = 0.0;       ///< behind the contour of a solid two cells thick or more, cells
    double deepest_thin = 0.0;  ///< the same in thinner ones, which are not tight
    double fastest = 0.0;           ///< along an axis, cells/s
    bool solids = false;

    bool whole() const {
        return not_finite == 0 && outside == 0 && lost == 0 && inconsistent == 0;
    }
    bool saw(weir::Clamped what) const { return (clamped & static_cast<std::uint32_t>(what)) != 0; }
};

template <class Real>
class Tank {
public:
    /// @param dirt every byte of the memory before init.
    explicit Tank(const weir::WorldDef& def, unsigned char dirt = 0xA5);
    Tank(const Tank&) = delete;
    Tank& operator=(const Tank&) = delete;

    weir::World<Real>& world() { return world_; }
    const weir::World<Real>& world() const { return world_; }
    const weir::WorldDef& def() const { return def_; }
    const Tally& tally() const { return tally_; }
    weir::Vec2<Look<Real>> position(std::int32_t index) const {
        const auto x = world_.particle_positions()[index];
        return {static_cast<Look<Real>>(x.x), static_cast<Look<Real>>(x.y)};
    }
    /// Cells a second.
    weir::Vec2<double> velocity(std::int32_t index) const {
        const auto v = world_.particle_velocities()[index];
        return {to_cells_ * static_cast<double>(v.x), to_cells_ * static_cast<double>(v.y)};
    }
    /// What places and velocities are known to, cells, cells a second.
    double place_unit() const { return unit_of<weir::PositionOf<Real>>(); }
    /// And steps, s.
    double time_unit() const { return kIsFixed<Real> ? std::ldexp(1.0 / to_cells_, -30) : 0.0; }
    double speed_unit() const { return to_cells_ * unit_of<weir::VelocityOf<Real>>(); }

    /// All of these throw if the world refuses. Cells, cells a second.
    std::int32_t fill(float x0, float y0, float x1, float y1);
    /// Liquid on the lattice that moves from the start.
    void fill_moving(float x0, float y0, float x1, float y1, weir::Vec2f velocity);
    void add(weir::Vec2f at, weir::Vec2f velocity);
    void remove(std::int32_t index);
    weir::BodyId add_static(const Ring& ring, weir::Vec2f at, float angle_rad = 0.0F,
                            float restitution = 0.0F);
    weir::BodyId add_moving(const Ring& ring, weir::Vec2f at, weir::Vec2f velocity, float spin,
                            float restitution = 0.0F);
    void move(weir::BodyId id, weir::Vec2f at, weir::Vec2f velocity, float angle, float spin);
    /// What is put in is counted anew from here.
    void set_gravity(weir::Vec2f gravity_mps2);
    /// What is put in is what is there now, and what liquid under pressure will give back.
    void energy_from_now() { put_in_ = energy() + stored_energy(); }
    /// Counts as put in what cells that are fuller than at rest will lift: beside solids, which cut
    /// the lattice, some are, and more beside those that are drawn larger than they were when the
    /// liquid was placed around them; after a blow. Takes a step so short that nothing moves.
    void count_compression();

    weir::StepReport step(float dt_s);
    void run(std::int32_t steps, float dt_s);

    /// Kinetic and potential energy per mass of a particle, cells²/s², potential from the corner of
    /// the tank that gravity points to.
    double energy() const;
    double kinetic_energy() const;
    /// What rounding may make of the energy that was put in: fixed point puts each particle on the
    /// nearest place that it knows, and gives it the nearest speed, so that all of them may stand
    /// a unit higher and go a unit faster than they should. None in floating point.
    double rounding_room() const;
    double mean_height() const;
    double rms_speed() const;
    /// Height of the centre of mass against that of the same liquid at rest, −1 … A box without
    /// solids, gravity downwards, settled.
    double volume_error() const;
    /// The same as a height of the surface, cells.
    double level_error() const { return volume_error() * depth_at_rest(); }
    double depth_at_rest() const;
    /// Most particles in one cell, of those at rest in a full one.
    double highest_density() const;
    std::int32_t particles() const { return expected_; }

private:
    struct AtRest {
        double surface;  ///< gravity times its place
        double energy;
    };

    weir::BodyId add_body(const Ring& ring, const weir::Motion& motion, float restitution,
                          bool moving);
    bool consistent(const weir::StepReport& report, float dt_s, double fastest) const;
    void look_at_depths();
    double depth(weir::Vec2<Look<Real>> x) const;
    bool thick_at(weir::Vec2<Look<Real>> x) const;
    double energy_of(std::int32_t index) const;
    double stored_energy() const;
    double open_share(std::int32_t i, std::int32_t j) const;
    /// What gravity gains on the way from the origin, cells²/s².
    double fall(weir::Vec2<double> x) const;
    weir::Vec2<double> lowest_corner() const;
    AtRest at_rest() const;
    /// Of the energy, of what may be there.
    double share_of(double put_in) const { return energy() / (put_in + rounding_room()); }
    weir::Vec2f to_m(weir::Vec2f cells) const {
        return {cells.x * def_.cell_m, cells.y * def_.cell_m};
    }

    weir::WorldDef def_;
    measure::WorldMemory memory_;
    weir::World<Real> world_;
    weir::Vec2f gravity_mps2_;
    double to_cells_ = 1.0;  ///< what the world's velocities are in, cells a second
    std::int32_t expected_ = 0;
    double put_in_ = 0.0;
    double lost_ = 0.0;  ///< of what was put in before gravity turned
    Tally tally_;
};

extern template class Tank<float>;
extern template class Tank<double>;
extern template class Tank<weir::Fixed>;
extern template class Tank<weir::SmallFixed>;

/// Calls visit(scheme, Real{}) for both pressures, both contours where solids take part, and the
/// arithmetic that is asked for; usually float, and double, too, if `twice`.
template <class Visit>
void each_scheme(Scalar scalar, bool solids, bool twice, Visit visit) {
    for (const auto pressure : {weir::Pressure::projection, weir::Pressure::equation_of_state}) {
        for (const auto contour : {weir::Contour::interpolated, weir::Contour::mid_edge}) {
            const Scheme scheme{pressure, contour};
            const bool exact = contour == weir::Contour::interpolated;
            if (!exact && !solids) {
                continue;
            }
            switch (scalar) {
                case Scalar::usual:
                    visit(scheme, float{});
                    if (twice && exact) {
                        visit(scheme, double{});
                    }
                    break;
                case Scalar::single: visit(scheme, float{}); break;
                case Scalar::twice: visit(scheme, double{}); break;
                case Scalar::fixed: visit(scheme, weir::Fixed{}); break;
                case Scalar::small_fixed: visit(scheme, weir::SmallFixed{}); break;
            }
        }
    }
}

template <class Real>
const char* real_name() {
    if constexpr (std::is_same<Real, weir::SmallFixed>::value) {
        return ".small_fixed";
    } else if constexpr (kIsFixed<Real>) {
        return ".fixed";
    } else {
        return sizeof(Real) == sizeof(float) ? ".float" : ".double";
    }
}

/// `S5.projection.float` and the like.
template <class Real>
std::string label(const char* name, const Scheme& scheme) {
    return std::string(name) + "." + scheme.name() + real_name<Real>();
}

}  // namespace stability
