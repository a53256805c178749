// Time of a whole step by number of particles, threads and solids, of a pass that only reads and
// writes the same bytes, and of the paper's method. Ratios between them are bench.py's.
//
// `ns` is the thread's own time, which others on the machine disturb least; `wall_ns`, of which
// threads are judged, is what passes meanwhile.
//
//     weir_bench --benchmark_format=json …        names: what/particles/threads
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "measure/world_memory.hpp"
#include "port/port.hpp"
#include "runners.hpp"
#include "weir/weir.hpp"

namespace {

using Clock = std::chrono::steady_clock;

constexpr float kCell = 0.02F;
constexpr float kFrame = 1.0F / 60.0F;

/// Of the time in which something falls √(height/g) far: the column has come down by a fifth and
/// its tongue is on its way. The same for all sizes, or they would not be comparable.
constexpr double kFrom = 0.7;
constexpr double kTo = 0.85;
constexpr int kWarmUp = 12;  // steps of the paper's scene

/// A dam that breaks in a tank twice as wide as high, 4 particles a cell; a ramp and a turning
/// block in its way, or none.
class Dam {
public:
    Dam(int particles, bool solids, bool shared) {
        const int side = 4 * static_cast<int>(std::ceil(std::sqrt(particles / 3.0) / 4.0));
        weir::WorldDef def;
        def.capacity.particles = particles + particles / 8;
        def.capacity.cells_x = 2 * side;
        def.capacity.cells_y = side;
        def.capacity.bodies = solids ? 2 : 0;
        def.capacity.vertices = solids ? 16 : 0;
        def.cell_m = kCell;
        def.keep_sorted = particles >= 100000;
        def.ticks = port::ticks;
        def.parallel_for = shared ? port::parallel_for : nullptr;
        memory_ = measure::memory_for<float>(def);
        const float size = kCell * static_cast<float>(side);
        sound_ = world_.init(def, memory_.data(), memory_.size()) == weir::Status::ok &&
                 (!solids || put_solids(size)) &&
                 world_.fill({{0.0F, 0.0F}, {size, static_cast<float>(particles) * 0.25F * kCell /
                                                       static_cast<float>(side)}}) ==
                     weir::Status::ok;
        const double fall_s = std::sqrt(static_cast<double>(size) / 9.81);
        for (double now = 0.0; sound_ && now < kFrom * fall_s; now += static_cast<double>(kFrame)) {
            world_.step(kFrame);
        }
        frames_ = std::max(1, static_cast<int>((kTo - kFrom) * fall_s / static_cast<double>(kFrame)));
        start_.resize(static_cast<std::size_t>(weir::snapshot_bytes<float>(def.capacity)));
        sound_ = sound_ && world_.save(start_.data(), start_.size()) == weir::Status::ok;
    }

    bool sound() const { return sound_; }
    std::size_t bytes() const { return memory_.size(); }
    weir::StepReport step() {
        ++frame_;
        return world_.step(kFrame);
    }
    /// Back to `kFrom` if `kTo` is reached.
    void rewind() {
        if (frame_ >= frames_) {
            frame_ = 0;
            sound_ = sound_ && world_.restore(start_.data(), start_.size()) == weir::Status::ok;
        }
    }

private:
    bool put_solids(float size) {
        const weir::Vec2f ramp[] = {{0.0F, 0.0F}, {0.4F * size, 0.0F}, {0.4F * size, 0.2F * size}};
        const weir::Vec2f block[] = {{-0.1F * size, -0.05F * size}, {0.1F * size, -0.05F * size},
                                     {0.1F * size, 0.05F * size}, {-0.1F * size, 0.05F * size}};
        weir::BodyDef still, turning;
        weir::BodyId id;
        still.polygon = {ramp, 3};
        still.motion.position_m = {1.55F * size, 0.0F};
        turning.polygon = {block, 4};
        turning.motion.position_m = {1.3F * size, 0.3F * size};
        turning.motion.spin_radps = 2.0F;
        return world_.add_static_body(still, &id) == weir::Status::ok &&
               world_.add_moving_body(turning, &id) == weir::Status::ok;
    }

    measure::WorldMemory memory_;
    weir::World<float> world_;
    std::vector<std::byte> start_;
    int frames_ = 0;
    int frame_ = 0;
    bool sound_ = false;
};

/// One for each name: repetitions go on where the last one ended.
template <class Thing, class Make>
Thing& kept(const std::string& name, const Make& make) {
    static std::map<std::string, std::unique_ptr<Thing>> things;
    std::unique_ptr<Thing>& thing = things[name];
    if (thing == nullptr) {
        thing = make();
    }
    return *thing;
}

/// Of this thread.
double cpu_ns() {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

struct Time {
    double wall = 0.0;
    double cpu = 0.0;

    template <class Work>
    void measure(const Work& work) {
        const Clock::time_point start = Clock::now();
        const double cpu_start = cpu_ns();
        work();
        cpu += cpu_ns() - cpu_start;
        wall += std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    }
    void report(benchmark::State& state, double particle_steps) const {
        state.counters["ns"] = cpu / particle_steps;
        state.counters["wall_ns"] = wall / particle_steps;
    }
};

void whole_step(benchmark::State& state, const std::string& name, int particles, int threads,
                bool solids) {
    port::set_threads(threads);
    Dam& dam = kept<Dam>(name, [&] { return std::make_unique<Dam>(particles, solids, threads > 1); });
    if (!dam.sound()) {
        state.SkipWithError("the library refuses the scene");
        return;
    }
    Time time;
    double work = 0.0, steps = 0.0, ticks = 0.0;
    double stage[weir::kStageCount] = {};
    for ([[maybe_unused]] auto _ : state) {
        dam.rewind();
        weir::StepReport report;
        time.measure([&] { report = dam.step(); });
        steps += report.substeps;
        work += static_cast<double>(report.substeps) * report.particles;
        for (int k = 0; k < weir::kStageCount; ++k) {
            stage[k] += static_cast<double>(report.ticks[k]);
            ticks += static_cast<double>(report.ticks[k]);
        }
    }
    time.report(state, work);
    state.counters["substeps_per_s"] = 1e9 * steps / time.wall;
    state.counters["frames_per_s"] = 1e9 * static_cast<double>(state.iterations()) / time.wall;
    for (int k = 0; k < weir::kStageCount; ++k) {
        state.counters[std::string("ns_") + weir::stage_name(static_cast<weir::Stage>(k))] =
            stage[k] / ticks * time.cpu / work;
    }
    port::set_threads(1);
}

/// Reads and writes once as many bytes as a world of so many particles has.
void stream(benchmark::State& state, const std::string& name, int particles) {
    std::vector<float>& bytes = kept<std::vector<float>>(name, [&] {
        return std::make_unique<std::vector<float>>(Dam(particles, false, false).bytes() / 4, 1.0F);
    });
    Time time;
    for ([[maybe_unused]] auto _ : state) {
        time.measure([&] {
            for (float& value : bytes) {
                value = value * 0.5F + 1.0F;
            }
            benchmark::ClobberMemory();
        });
    }
    time.report(state, static_cast<double>(state.iterations()) * particles);
}

/// The paper's method and Weir on the standard scene of the paper's tables.
void paper_step(benchmark::State& state, const std::string& name, int particles, bool reference) {
    paper_bench::Runner& runner = kept<paper_bench::Runner>(name, [&] {
        const auto scene = paper_bench::setting_scene(paper_bench::Setting::standard, particles);
        auto made = reference ? paper_bench::make_reference(scene, true,
                                                            paper::Velocity::scattered_again)
                              : paper_bench::make_weir(scene, true);
        for (int k = 0; k < (reference ? 1 : kWarmUp); ++k) {
            made->step();
        }
        return made;
    });
    Time time;
    double work = 0.0;
    for ([[maybe_unused]] auto _ : state) {
        int steps = 0;
        time.measure([&] { steps = runner.step().steps; });
        work += static_cast<double>(steps) * runner.particles();
    }
    time.report(state, work);
}

template <class Run>
void add(const std::string& name, int particles, const Run& run) {
    const int iterations = particles >= 500000 ? 2 : (particles >= 50000 ? 6 : 400000 / particles);
    benchmark::RegisterBenchmark(name.c_str(), run)->Iterations(iterations)
        ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
    for (const int particles : {1000, 10000, 75000, 100000, 1000000}) {
        const std::string count = std::to_string(particles);
        for (const bool solids : {false, true}) {
            for (const int threads : {1, 2}) {
                const std::string name = std::string(solids ? "solids/" : "dam/") + count + "/" +
                                         std::to_string(threads);
                add(name, particles, [=](benchmark::State& state) {
                    whole_step(state, name, particles, threads, solids);
                });
            }
        }
        const std::string name = "stream/" + count + "/1";
        add(name, particles, [=](benchmark::State& state) { stream(state, name, particles); });
    }
    for (const bool reference : {true, false}) {
        const std::string name = reference ? "paper/100000/1" : "weir/100000/1";
        add(name, 100000, [=](benchmark::State& state) {
            paper_step(state, name, 100000, reference);
        });
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
