// The table for people and the CSV for programs: name,value,unit,target,ok.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace measure {

class Report {
public:
    /// Throws if the file cannot be written.
    explicit Report(const std::string& path);
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;
    ~Report();

    /// Before the names of all rows from here on.
    void name_rows(const std::string& prefix) { prefix_ = prefix; }
    void heading(const std::string& text) const;
    /// A figure without a target.
    void figure(const std::string& name, double value, const char* unit);
    /// Figures with a target; a NaN is short of any.
    void at_most(const std::string& name, double value, const char* unit, double limit);
    void at_least(const std::string& name, double value, const char* unit, double limit);
    void equals(const std::string& name, double value, const char* unit, double expected);
    /// A statement that holds or does not.
    void holds(const std::string& name, bool ok) { equals(name, ok ? 1.0 : 0.0, "1", 1.0); }

    /// Figures that cannot be had, and why.
    void skipped(const std::string& name, const std::string& why);

    /// Folder of the CSV and its name without ending: what pictures' names start with.
    const std::string& stem() const { return stem_; }
    bool is_short() const { return !short_.empty(); }
    void summary() const;

protected:
    /// Of the CSV alone: any text, a figure, a figure with a target. @return `ok`.
    void row(const std::string& name, const char* value);
    void row(const std::string& name, double value, const char* unit);
    bool row(const std::string& name, double value, const char* unit, const char* sign,
             double limit, bool ok);

private:
    void line(const std::string& name, double value, const char* unit, const char* sign,
              double limit, bool ok);

    std::FILE* csv_ = nullptr;
    std::string stem_;
    std::string prefix_;
    int met_ = 0;
    int skipped_ = 0;
    std::vector<std::string> short_;
};

}  // namespace measure
