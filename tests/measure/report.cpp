#include "report.hpp"

#include <filesystem>
#include <stdexcept>

namespace measure {

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

void Report::heading(const std::string& text) const {
    std::printf("\n%s\n", text.c_str());
    std::fflush(stdout);
}

void Report::figure(const std::string& name, double value, const char* unit) {
    std::printf("  %-62s %12.5g %s\n", (prefix_ + name).c_str(), value, unit);
    std::fflush(stdout);
    row(name, value, unit);
}

void Report::row(const std::string& name, const char* value) {
    std::fprintf(csv_, "%s,%s,1,,\n", (prefix_ + name).c_str(), value);
    std::fflush(csv_);
}

void Report::row(const std::string& name, double value, const char* unit) {
    std::fprintf(csv_, "%s,%.7g,%s,,\n", (prefix_ + name).c_str(), value, unit);
    std::fflush(csv_);
}

bool Report::row(const std::string& name, double value, const char* unit, const char* sign,
                 double limit, bool ok) {
    std::fprintf(csv_, "%s,%.7g,%s,%s%.7g,%s\n", (prefix_ + name).c_str(), value, unit, sign,
                 limit, ok ? "yes" : "short");
    std::fflush(csv_);
    if (ok) {
        ++met_;
    } else {
        char text[200];
        std::snprintf(text, sizeof text, "%-70s %12.6g  %s %g", (prefix_ + name).c_str(), value, sign,
                      limit);
        short_.emplace_back(text);
    }
    return ok;
}

void Report::line(const std::string& name, double value, const char* unit, const char* sign,
                  double limit, bool ok) {
    row(name, value, unit, sign, limit, ok);
    std::printf("  %-62s %12.5g %-10s %s %-9.5g %s\n", (prefix_ + name).c_str(), value, unit,
                sign, limit, ok ? "yes" : "SHORT");
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

void Report::skipped(const std::string& name, const std::string& why) {
    std::printf("  %-62s skipped: %s\n", (prefix_ + name).c_str(), why.c_str());
    std::fflush(stdout);
    row(name, "skipped");
    ++skipped_;
}

void Report::summary() const {
    std::printf("\n%d targets met, %zu short", met_, short_.size());
    if (skipped_ > 0) {
        std::printf(", %d skipped", skipped_);
    }
    std::printf("\n");
    for (const std::string& text : short_) {
        std::printf("  short: %s\n", text.c_str());
    }
}

}  // namespace measure
