#include "report.hpp"

#include <cstdio>

namespace stability {

bool beyond_arithmetic(weir::Status status) {
    using weir::Status;
    for (const Status one : {Status::cells_out_of_range, Status::top_speed_out_of_range,
                             Status::gravity_out_of_range, Status::velocity_out_of_range,
                             Status::motion_out_of_range}) {
        if (status == one) {
            return true;
        }
    }
    return false;
}

void Report::run(const std::string& name, const Tally& t, const Bounds& bounds) {
    bool ok = true;
    const auto none = [&](const char* what, std::int64_t count) {
        const auto value = static_cast<double>(count);
        ok = row(name + "." + what, value, "1", "==", 0.0, count == 0) && ok;
    };
    none("not_finite", t.not_finite);
    none("outside", t.outside);
    none("lost", t.lost);
    none("inconsistent_reports", t.inconsistent);
    if (!bounds.resets) {
        none("reset", t.reset);
    }
    if (bounds.energy > 0.0) {
        ok = row(name + ".energy", t.energy_ratio, "of put in", "<=", bounds.energy,
                 t.energy_ratio <= bounds.energy) &&
             ok;
    }
    if (bounds.depth > 0.0 && t.solids) {
        ok = row(name + ".depth_in_solids", t.deepest, "cells", "<=", bounds.depth,
                 t.deepest <= bounds.depth) &&
             ok;
    }
    std::printf("  %-50s %6lld steps %5.1f sub  NaN %lld out %lld lost %lld incons %lld",
                name.c_str(), static_cast<long long>(t.steps),
                static_cast<double>(t.substeps) / static_cast<double>(t.steps > 0 ? t.steps : 1),
                static_cast<long long>(t.not_finite), static_cast<long long>(t.outside),
                static_cast<long long>(t.lost), static_cast<long long>(t.inconsistent));
    std::printf("  energy %.6f%s", t.energy_ratio, bounds.energy > 0.0 ? "" : "*");
    if (t.solids) {
        std::printf("  depth %.4f%s (thin %.4f)", t.deepest, bounds.depth > 0.0 ? "" : "*",
                    t.deepest_thin);
    }
    std::printf("  %s\n", ok ? "yes" : "SHORT");
    std::fflush(stdout);
}

void Report::not_offered(const std::string& name) {
    std::printf("  %-62s not offered\n", name.c_str());
    row(name, "not offered");
}

void Report::skipped(const std::string& name, const std::string& answer) {
    std::printf("  %-50s skipped, %s\n", name.c_str(), answer.c_str());
    row(name, "skipped");
    ++skipped_;
}

void Report::summary() const {
    measure::Report::summary();
    if (skipped_ > 0) {
        std::printf("%d skipped: beyond the arithmetic\n", skipped_);
    }
}

}  // namespace stability
