#include "report.hpp"

#include <stdexcept>

namespace solids {

Report::Report(const std::string& path) : csv_(std::fopen(path.c_str(), "w")) {
    if (csv_ == nullptr) {
        throw std::runtime_error("cannot write " + path);
    }
    std::fprintf(csv_, "name,value,unit,target,ok\n");
}

Report::~Report() {
    std::fclose(csv_);
}

void Report::heading(const std::string& text) const {
    std::printf("\n%s\n", text.c_str());
    std::fflush(stdout);
}

void Report::figure(const std::string& name, double value, const char* unit) {
    std::printf("  %-56s %12.5g %s\n", name.c_str(), value, unit);
    std::fflush(stdout);
    std::fprintf(csv_, "%s,%.7g,%s,,\n", name.c_str(), value, unit);
    std::fflush(csv_);
}

void Report::line(const std::string& name, double value, const char* unit, const char* sign,
                  double limit, bool ok) {
    std::printf("  %-56s %12.5g %-8s %s %-9.5g %s\n", name.c_str(), value, unit, sign, limit,
                ok ? "yes" : "SHORT");
    std::fflush(stdout);
    std::fprintf(csv_, "%s,%.7g,%s,%s%.7g,%s\n", name.c_str(), value, unit, sign, limit,
                 ok ? "yes" : "short");
    std::fflush(csv_);
    if (ok) {
        ++met_;
        return;
    }
    char text[200];
    std::snprintf(text, sizeof text, "%-56s %12.6g  %s %g", name.c_str(), value, sign, limit);
    short_.emplace_back(text);
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

void Report::summary() const {
    std::printf("\n%d targets met, %zu short\n", met_, short_.size());
    for (const std::string& text : short_) {
        std::printf("  short: %s\n", text.c_str());
    }
}

}  // namespace solids
