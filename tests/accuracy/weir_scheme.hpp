// The library's two pressures as schemes.
#pragma once

#include "scheme.hpp"

namespace accuracy {

std::unique_ptr<Scheme> make_weir(bool projection, bool in_double);

}  // namespace accuracy
