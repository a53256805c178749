// The table for people and the CSV for programs: name,value,unit,target,ok.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "tank.hpp"

namespace stability {

/// What a run under watch has to hold. Everything else (finite, inside, none lost, reports that
/// agree with themselves, no reset) always has to.
struct Bounds {
    double energy = 1.0 + 1.0e-4;  ///< most energy, of what was put in; 0: not checked
    double depth = 0.15;           ///< deepest particle in a solid, cells; 0: not checked
    bool resets = false;           ///< whether particles may be put to rest
};

/// The explicit pressure stores work in sound and returns it a little late, with interest: a dam
/// break gains 2 to 3 % for a moment. The projection stores nothing.
inline Bounds bounds_of(const Scheme& scheme) {
    Bounds bounds;
    bounds.energy = scheme.elastic() ? 1.05 : 1.0 + 1.0e-4;
    // The paper's contour has no way out of a solid: there particles stay inside.
    bounds.depth = scheme.contour == weir::Contour::interpolated ? 0.15 : 0.0;
    return bounds;
}

inline constexpr Bounds kNoEnergy{0.0, 0.15, false};
inline constexpr Bounds kOnlyKept{0.0, 0.0, false};

class Report {
public:
    explicit Report(const std::string& path);
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;
    ~Report();

    void heading(const char* text) const;
    /// A figure without a target.
    void figure(const std::string& name, double value, const char* unit);
    void at_most(const std::string& name, double value, const char* unit, double limit);
    void at_least(const std::string& name, double value, const char* unit, double limit);
    void equals(const std::string& name, double value, const char* unit, double expected);
    /// A statement that holds or does not.
    void holds(const std::string& name, bool ok) { equals(name, ok ? 1.0 : 0.0, "1", 1.0); }
    /// One line of the table, six rows of the CSV: a run's tally against its bounds.
    void run(const std::string& name, const Tally& tally, const Bounds& bounds);
    /// A row for what the library does not offer.
    void not_offered(const std::string& name);

    /// Folder of the CSV and its name without ending: what pictures' names start with.
    const std::string& stem() const { return stem_; }
    bool is_broken() const { return !short_.empty(); }
    void summary() const;

private:
    bool row(const std::string& name, double value, const char* unit, const char* sign,
             double limit, bool ok);
    void line(const std::string& name, double value, const char* unit, const char* sign,
              double limit, bool ok);

    std::FILE* csv_ = nullptr;
    std::string stem_;
    int met_ = 0;
    std::vector<std::string> short_;
};

}  // namespace stability
