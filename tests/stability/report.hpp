// A report that also judges what a run under watch came to.
#pragma once

#include <string>

#include "measure/report.hpp"
#include "tank.hpp"

namespace stability {

/// What a run under watch has to hold. Everything else (finite, inside, none lost, reports that
/// agree with themselves, no reset) always has to.
struct Bounds {
    double energy = 1.0 + 1.0e-4;  ///< most energy, of what was put in; 0: not checked
    double depth = 0.15;           ///< deepest particle in a solid, cells; 0: not checked
    bool resets = false;           ///< whether particles may be put to rest
};

/// What liquid stores as pressure it has given: neither pressure returns more.
inline Bounds bounds_of(const Scheme& scheme) {
    Bounds bounds;
    // The paper's contour has no way out of a solid: there particles stay inside.
    bounds.depth = scheme.contour == weir::Contour::interpolated ? 0.15 : 0.0;
    return bounds;
}

inline constexpr Bounds kNoEnergy{0.0, 0.15, false};
inline constexpr Bounds kOnlyKept{0.0, 0.0, false};

/// Whether a world answers so what its arithmetic does not bear.
bool beyond_arithmetic(weir::Status status);

class Report : public measure::Report {
public:
    using measure::Report::Report;

    /// One line of the table, six rows of the CSV: a run's tally against its bounds.
    void run(const std::string& name, const Tally& tally, const Bounds& bounds);
    /// A row for what the library does not offer.
    void not_offered(const std::string& name);
    /// A row for what the arithmetic does not bear: the world's answer.
    void skipped(const std::string& name, const std::string& answer);
    void summary() const;

private:
    int skipped_ = 0;
};

/// Runs a case. What fixed point refuses is skipped with the world's answer; nothing else is.
template <class Real, class Case>
void attempt(Report& report, const std::string& name, const Case& run) {
    try {
        run();
    } catch (const Refused& refusal) {
        if (!kIsFixed<Real> || !beyond_arithmetic(refusal.status())) {
            throw;
        }
        report.skipped(name, refusal.what());
    }
}

}  // namespace stability
