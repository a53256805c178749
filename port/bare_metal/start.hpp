// From reset to main(): what is alike on all processors. A processor's own start.cpp has
// port_reset(), which sets up what compiled code needs, calls port_prepare_memory() on the
// handlers' stack and then port_run() on that of main().
#pragma once

extern "C" {

/// Paints the stack of main(), sets up data and zeroed data, and prepares the processor.
void port_prepare_memory();

/// Runs the constructors, main(), and exit().
[[noreturn]] void port_run();

}  // extern "C"

namespace port {

/// The processor's own part: faults by name, the fence, the counters. Runs with data set up.
void prepare_processor();

}  // namespace port
