// The one symbol that the library wants from outside.
#pragma once

extern "C" {
/// Called when the library finds that it was used against its contract or is broken itself.
/// Supplied by the port: say what happened, then stop. Never returns.
[[noreturn]] void weir_fault(const char* expression, const char* file, int line);
}
