#include "report.hpp"

#include <filesystem>
#include <stdexcept>

namespace stability {

Report::Report(const std::string& path) : csv_(std::fopen(path.c_str(), "w")) {
    if (csv_ == nullptr) {
        throw std::runtime_error("cannot write " + path);
    }
    const std::filesystem::path p(path);
    stem_ = (p.parent_path() / p.stem()).string();
    std::fprintf(csv_, "name,value,unit,target,ok\n");
}

Report::~Report() {
    std::fclose(csv_);
}

void Report::heading(const char* text) const {
    std::printf("\n%s\n", text);
    std::fflush(stdout);
}

void Report::figure(const std::string& name, double value, const char* unit) {
    std::printf("  %-62s %12.5g %s\n", name.c_str(), value, unit);
    std::fprintf(csv_, "%s,%.7g,%s,,\n", name.c_str(), value, unit);
    std::fflush(csv_);
}

bool Report::row(const std::string& name, double value, const char* unit, const char* sign,
                 double limit, bool ok) {
    std::fprintf(csv_, "%s,%.7g,%s,%s%.7g,%s\n", name.c_str(), value, unit, sign, limit,
                 ok ? "yes" : "short");
    std::fflush(csv_);
    if (ok) {
        ++met_;
    } else {
        char text[200];
        std::snprintf(text, sizeof text, "%-70s %12.6g  %s %g", name.c_str(), value, sign, limit);
        short_.emplace_back(text);
    }
    return ok;
}

void Report::line(const std::string& name, double value, const char* unit, const char* sign,
                  double limit, bool ok) {
    row(name, value, unit, sign, limit, ok);
    std::printf("  %-62s %12.5g %-10s %s %-9.5g %s\n", name.c_str(), value, unit, sign, limit,
                ok ? "yes" : "SHORT");
    std::fflush(stdout);
}

// Each comparison is false for a NaN.
void Report::at_most(const std::string& name, double value, const char* unit, double limit) {
    line(name, value, unit, "<=", limit, value <= limit);
}

void Report::at_least(const std::string& name, double value, const char* unit, double limit) {
    line(name, value, unit, ">=", limit, value >= limit);
}

void Report::equals(const std::string& name, double value, const char* unit, double expected) {
    line(name, value, unit, "==", expected, value == expected);
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
    std::fprintf(csv_, "%s,not offered,1,,\n", name.c_str());
}

void Report::summary() const {
    std::printf("\n%d targets met, %zu short\n", met_, short_.size());
    for (const std::string& text : short_) {
        std::printf("  short: %s\n", text.c_str());
    }
}

}  // namespace stability
