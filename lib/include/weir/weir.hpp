// Weir: real-time 2D liquid that meets solid bodies. This header is all that a program includes,
// but for weir/display.hpp, for those who draw with it.
#pragma once

#include "weir/config.hpp"
#include "weir/diagnostics.hpp"
#include "weir/fault.hpp"
#include "weir/geometry.hpp"
#include "weir/memory.hpp"
#include "weir/report.hpp"
#include "weir/snapshot.hpp"
#include "weir/status.hpp"
#include "weir/types.hpp"
#include "weir/world.hpp"
