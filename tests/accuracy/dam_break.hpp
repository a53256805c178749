// The parts of R5A that other problems share.
#pragma once

#include <string>

#include "case.hpp"

namespace accuracy {

inline constexpr double kFrontTimes[5] = {0.5, 1.0, 1.5, 2.0, 2.2};
/// Within these times pressures are compared.
inline constexpr double kPressureFrom = 2.6;
inline constexpr double kPressureTo = 6.5;

Setup dam_break_setup(const Case& c);
Particles dam_break_column(const Case& c);

/// Where the tables lie; set once by the program.
std::string& reference_folder();
Signal front_reference(const std::string& data);
Signal pressure_reference(const std::string& data, const std::string& sensor_name);

}  // namespace accuracy
