#include "measure.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace paper_bench {
namespace {

constexpr double kWarmUp_s = 0.25;         // simulated: the dam is on its way
constexpr double kBatch_s = 1.0 / 120.0;   // simulated, of one round
constexpr int kRounds = 9;

// Not every method's step fits the span: an overshoot is taken from the next one.
struct Clocked {
    Runner* runner;
    double simulated_s = 0.0;
};

struct Batch {
    int steps = 0;
    double simulated_s = 0.0;
    double wall_s = 0.0;
};

Batch run_until(Clocked& clocked, double time_s) {
    Batch batch;
    const auto start = std::chrono::steady_clock::now();
    do {
        const Progress progress = clocked.runner->step();
        batch.steps += progress.steps;
        batch.simulated_s += progress.simulated_s;
        if (progress.simulated_s <= 0.0) {
            break;  // a world that refuses to step must not hang the bench
        }
    } while (clocked.simulated_s + batch.simulated_s < time_s);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    batch.wall_s = wall.count();
    clocked.simulated_s += batch.simulated_s;
    return batch;
}

std::string format(const char* pattern, double value) {
    char text[64];
    std::snprintf(text, sizeof text, pattern, value);
    return text;
}

bool write_file(const std::string& path, const std::string& text) {
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (file == nullptr) {
        std::fprintf(stderr, "cannot write %s\n", path.c_str());
        return false;
    }
    const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    return std::fclose(file) == 0 && written;
}

}  // namespace

std::vector<Timing> measure(const std::vector<Runner*>& runners) {
    std::vector<Clocked> clocked;
    for (Runner* runner : runners) {
        clocked.push_back({runner});
        run_until(clocked.back(), kWarmUp_s);
    }
    std::vector<Timing> timings(runners.size());
    for (int round = 1; round <= kRounds; ++round) {
        for (std::size_t k = 0; k < runners.size(); ++k) {
            const Batch batch = run_until(clocked[k], kWarmUp_s + round * kBatch_s);
            const int steps = std::max(batch.steps, 1);
            const double simulated_s = std::max(batch.simulated_s, 1e-9);
            timings[k].ms_per_step.push_back(1e3 * batch.wall_s / steps);
            timings[k].s_per_simulated_s.push_back(batch.wall_s / simulated_s);
            timings[k].steps_per_simulated_s += steps / simulated_s / kRounds;
        }
    }
    for (std::size_t k = 0; k < runners.size(); ++k) {
        timings[k].particles = runners[k]->particles();
        timings[k].astray = runners[k]->astray();
    }
    return timings;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < a.size(); ++k) {
        ratios.push_back(a[k] / b[k]);
    }
    return median(ratios);
}

void Report::title(const std::string& text) {
    std::printf("\n%s\n%-18s %9s  %-24s %8s %8s %8s %9s %10s\n", text.c_str(), "scene", "particles",
                "method", "ms/step", "ns/part.", "FPS", "steps/sim", "wall/sim s");
}

void Report::line(const std::string& key, const std::string& scene, const std::string& method,
                  const Timing& timing) {
    const double ms = median(timing.ms_per_step);
    const double ns = 1e6 * ms / std::max(timing.particles, 1);
    const double wall = median(timing.s_per_simulated_s);
    std::printf("%-18s %9d  %-24s %8.3f %8.1f %8.1f %9.0f %10.3f\n", scene.c_str(),
                timing.particles, method.c_str(), ms, ns, 1e3 / ms, timing.steps_per_simulated_s,
                wall);
    std::fflush(stdout);
    row(key + ".ms_per_step", ms, "ms");
    row(key + ".ns_per_particle_step", ns, "ns");
    row(key + ".fps", 1e3 / ms, "1/s");
    row(key + ".wall_per_simulated_s", wall, "s/s");
    row(key + ".particles_astray", timing.astray, "1", "==0");
}

void Report::row(const std::string& name, double value, const std::string& unit,
                 const std::string& target) {
    std::string ok;
    if (target.size() > 2) {
        const double limit = std::atof(target.c_str() + 2);
        const char kind = target[0];
        const bool met = kind == '<' ? value <= limit : kind == '>' ? value >= limit
                                                                    : value == limit;
        ok = met ? "yes" : "short";
    }
    rows_ += name + "," + format("%.6g", value) + "," + unit + "," + target + "," + ok + "\n";
}

void Report::bar(const std::string& label, double reference_ns, double weir_ns) {
    bars_ += "\"" + label + "\" " + format("%.3f", reference_ns) + format(" %.3f\n", weir_ns);
}

bool Report::write() const {
    return write_file(csv_path_, "name,value,unit,target,ok\n" + rows_) && write_plot();
}

bool Report::write_plot() const {
    const std::string stem = csv_path_.substr(0, csv_path_.rfind('.'));
    const std::string script =
        "set terminal pngcairo size 1100,560\n"
        "set output '" + stem + ".png'\n"
        "set title 'One step: the paper''s method and Weir on the same scenes, one core'\n"
        "set ylabel 'ns per particle and step'\n"
        "set style data histogram\nset style histogram cluster gap 1\n"
        "set style fill solid 0.8 border -1\nset xtics rotate by -35\nset rmargin 10\n"
        "set yrange [0:*]\n"
        "set grid ytics\nset key top left\n"
        "$bars << EOD\n" + bars_ + "EOD\n"
        "plot $bars using 2:xtic(1) title 'reference', '' using 3 title 'weir'\n";
    if (!write_file(stem + ".gnuplot", script)) {
        return false;
    }
    const std::string command = "gnuplot '" + stem + ".gnuplot'";
    if (std::system(command.c_str()) != 0) {
        std::fprintf(stderr, "no plot: gnuplot is missing or failed\n");
    }
    return true;
}

}  // namespace paper_bench
