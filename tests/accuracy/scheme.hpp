// One face for every way to move the liquid that is measured here.
//
// Lengths are cells, times are whatever unit the problem chose (gravity, sound speed and viscosity
// are given in it). A scheme is started once and then advanced in equal intervals; how many of its
// own steps it takes within an interval is its own affair.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace accuracy {

struct Vector {
    double x = 0.0;
    double y = 0.0;
};

inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
inline Vector operator*(double s, Vector a) { return {s * a.x, s * a.y}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }

struct Particle {
    Vector x;  ///< cells, the tank's lower left corner is the origin
    Vector v;  ///< cells per unit of time
};
using Particles = std::vector<Particle>;

/// What may be varied without changing the problem. Negative: the library's own default.
struct Options {
    double flip_ratio = -1.0;
    int sweeps = -1;
    double volume_gain = -1.0;
    double step_scale = 1.0;   ///< times the interval that the problem asks for
    double sound_scale = 1.0;  ///< times the sound speed that the problem asks for
    double cfl = -1.0;         ///< cells per substep above which the library cuts an interval
};

struct Setup {
    int nx = 0;  ///< tank, cells
    int ny = 0;
    Vector gravity;
    double interval = 0.0;     ///< advance() moves time by this; see Scheme::interval
    double sound_speed = 0.0;  ///< weakly compressible schemes only, cells per unit of time
    bool periodic_x = false;
    bool periodic_y = false;
    double viscosity = 0.0;  ///< kinematic, cells² per unit of time
    bool no_slip = false;    ///< at the tank's walls
    double slide_top = 0.0;  ///< speed of the upper wall along x, without slip
    double top_speed = 0.0;  ///< nothing gets faster along an axis; 0: nobody knows
    Options options;
};

enum class Kind {
    projection,  ///< Weir, Pressure::projection, float
    projection_double,
    projection_fixed,
    projection_small_fixed,
    equation_of_state,  ///< Weir, Pressure::equation_of_state, float
    equation_of_state_double,
    equation_of_state_fixed,
    equation_of_state_small_fixed,
    reference,  ///< the paper's own liquid step (tests/reference)
};
const char* kind_name(Kind kind);
/// Throws if there is none of that name.
Kind kind_named(const std::string& name);
/// The same method in float.
Kind in_float(Kind kind);

/// A scheme cannot hold a problem: its arithmetic is too narrow, or lacks a feature.
class Unable : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class Scheme {
public:
    virtual ~Scheme() = default;

    /// Throws `Unable`.
    virtual void start(const Setup& setup, const Particles& particles) = 0;
    virtual void advance() = 0;
    virtual Particles particles() const = 0;
    /// New positions and velocities for the same particles.
    virtual void replace(const Particles& particles) = 0;
    virtual void set_gravity(Vector gravity) = 0;
    /// p / ρ at the centre of a cell, from the last step.
    virtual double pressure(int i, int j) const = 0;

    /// Whether its pressure comes from density and the sound speed counts.
    virtual bool compressible() const = 0;

    /// The interval, rounded to what the scheme can represent.
    double interval() const { return interval_; }
    /// The last of its own steps: velocities are those of half of it before the positions.
    double own_step() const { return own_step_; }
    /// Wall time spent in the scheme's own steps since the start.
    double seconds() const { return seconds_; }
    /// Physical time since the start, as far as `seconds` counts it.
    double time() const { return time_; }
    std::int64_t steps() const { return steps_; }
    /// Forgets what was counted: a problem's preparation does not count.
    void reset_clock() {
        seconds_ = 0.0;
        time_ = 0.0;
        steps_ = 0;
    }
    /// Particles that had to be put to rest because their state was not finite.
    std::int64_t reset() const { return reset_; }
    /// Steps in which speeds were limited to what the arithmetic bears.
    std::int64_t limited() const { return limited_; }

protected:
    double interval_ = 0.0;
    double own_step_ = 0.0;
    double seconds_ = 0.0;
    double time_ = 0.0;
    std::int64_t steps_ = 0;
    std::int64_t reset_ = 0;
    std::int64_t limited_ = 0;
};

std::unique_ptr<Scheme> make_scheme(Kind kind);

}  // namespace accuracy
