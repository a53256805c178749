// The library's two pressures in its four formats as schemes.
#pragma once

#include "scheme.hpp"

namespace accuracy {

enum class Format { in_float, in_double, fixed, small_fixed };

std::unique_ptr<Scheme> make_weir(bool projection, Format format);

}  // namespace accuracy
