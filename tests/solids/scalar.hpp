// The arithmetic that problems run in, and what becomes of those that it cannot hold.
#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>

#include "measure/report.hpp"
#include "weir/weir.hpp"

namespace solids {

enum class Scalar { single_precision, double_precision, fixed, small_fixed };

struct NamedScalar {
    const char* name;
    Scalar scalar;
};
inline constexpr NamedScalar kScalars[] = {{"float", Scalar::single_precision},
                                           {"double", Scalar::double_precision},
                                           {"fixed", Scalar::fixed},
                                           {"small_fixed", Scalar::small_fixed}};

/// Whether there may be room for walls thinner than a cell: without it those are not tight, and no
/// line divides the tank.
template <class Real>
inline constexpr bool kThinWalls = !std::is_same<Real, weir::SmallFixed>::value;

/// run(zero) with a zero of that arithmetic. Rows begin with its name, unless it is the usual one.
template <class Run>
void in_scalar(measure::Report& report, Scalar scalar, Run run) {
    for (const NamedScalar& one : kScalars) {
        if (one.scalar == scalar && scalar != Scalar::single_precision) {
            report.name_rows(std::string(one.name) + ".");
        }
    }
    switch (scalar) {
        case Scalar::single_precision: return run(0.0F);
        case Scalar::double_precision: return run(0.0);
        case Scalar::fixed: return run(weir::Fixed());
        case Scalar::small_fixed: return run(weir::SmallFixed());
    }
}

/// What is said of a world that an arithmetic has no room for.
struct NoRoom : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Is that a limit of fixed point, or a mistake of the problem's?
inline bool limit_of_format(weir::Status status) {
    return status == weir::Status::cells_out_of_range ||
           status == weir::Status::small_fixed_has_no_thin_walls ||
           status == weir::Status::free_body_in_small_world;
}

inline void require(weir::Status status) {
    if (limit_of_format(status)) {
        throw NoRoom(weir::status_text(status));
    }
    if (status != weir::Status::ok) {
        throw std::runtime_error(std::string("refused: ") + weir::status_text(status));
    }
}

/// The rows of `name`, or that the arithmetic has no room for them.
template <class Work>
void rows(measure::Report& report, const std::string& name, Work work) {
    try {
        work();
    } catch (const NoRoom& refused) {
        report.skipped(name, refused.what());
    }
}

/// A target for what is known as well as numbers are. Packed ones know a place to 1/256 of a cell,
/// so a wall to a quarter of a degree: a figure of those.
template <class Real>
void accurate(measure::Report& report, const std::string& name, double value, const char* unit,
              double limit) {
    if (std::is_same<Real, weir::SmallFixed>::value) {
        report.figure(name, value, unit);
    } else {
        report.at_most(name, value, unit, limit);
    }
}

}  // namespace solids
