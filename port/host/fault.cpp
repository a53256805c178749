// In a file of its own: of a static library it is linked only where the program has none.
#include <cstdio>
#include <cstdlib>

#include "port/port.hpp"

// To stderr, where death tests look, and without running destructors: the program's state is not to
// be trusted.
extern "C" void weir_fault(const char* expression, const char* file, int line) {
  std::fflush(stdout);
  std::fprintf(stderr, "FAULT %s %s:%d\n", expression, file, line);
  std::fflush(stderr);
  std::_Exit(3);
}
