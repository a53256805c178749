// Checks against programmer errors. Both lead to the port's fault hook.
#pragma once

#include "weir/fault.hpp"

/// O(1), always on: cheaper than one wrong write in the field.
#define WEIR_ASSERT(condition)                           \
    (static_cast<bool>(condition) ? static_cast<void>(0) \
                                  : weir_fault(#condition, __FILE__, __LINE__))
