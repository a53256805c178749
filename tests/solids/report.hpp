// The table for people and the CSV for programs: name,value,unit,target,ok.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace solids {

class Report {
public:
    /// Throws if the file cannot be written.
    explicit Report(const std::string& path);
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;
    ~Report();

    void heading(const std::string& text) const;
    /// A figure without a target.
    void figure(const std::string& name, double value, const char* unit);
    /// Figures with a target; a NaN is short of any.
    void at_most(const std::string& name, double value, const char* unit, double limit);
    void at_least(const std::string& name, double value, const char* unit, double limit);
    void equals(const std::string& name, double value, const char* unit, double expected);
    /// A statement that holds or does not.
    void holds(const std::string& name, bool ok) { equals(name, ok ? 1.0 : 0.0, "1", 1.0); }

    bool is_short() const { return !short_.empty(); }
    void summary() const;

private:
    void line(const std::string& name, double value, const char* unit, const char* sign,
              double limit, bool ok);

    std::FILE* csv_ = nullptr;
    int met_ = 0;
    std::vector<std::string> short_;
};

}  // namespace solids
