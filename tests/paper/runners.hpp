// One face for both methods: a scene goes in, `step` comes out.
#pragma once

#include <memory>

#include "paper_fluid.hpp"
#include "paper_scenes.hpp"

namespace paper_bench {

/// What one call of `step` did. The reference takes one step; Weir cuts a frame into as many
/// substeps as its liquid's speed asks for, and a substep is what compares to a step.
struct Progress {
    int steps = 0;
    double simulated_s = 0.0;
};

class Runner {
public:
    virtual ~Runner() = default;
    virtual Progress step() = 0;
    virtual int particles() const = 0;
    /// Particles that are not finite or not in the tank (the reference: nor in its margin).
    virtual int astray() const = 0;
};

/// Sound speed over sqrt(g H) with which the reference runs: its liquid gives by about a tenth,
/// the least that still looks like a liquid. `kStrictSound` would hold it to one hundredth.
inline constexpr float kLooseSound = 3.0F;
inline constexpr float kStrictSound = 10.0F;

/// Seconds per step of the reference on that scene.
double reference_step_s(const Scene& scene, float sound_ratio);

std::unique_ptr<Runner> make_reference(const Scene& scene, bool interaction,
                                       paper::Velocity velocity);
/// Null, after a word on stderr, if the library refuses the scene.
std::unique_ptr<Runner> make_weir(const Scene& scene, bool interaction);

/// The scene as Weir has it after so many frames with interaction. Ends the program if it refuses one.
Scene scene_after(const Scene& scene, int frames);

}  // namespace paper_bench
