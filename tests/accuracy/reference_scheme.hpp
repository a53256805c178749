// The paper's own liquid step as a scheme.
#pragma once

#include "scheme.hpp"

namespace accuracy {

std::unique_ptr<Scheme> make_reference();

}  // namespace accuracy
