// Allocates for real: the pointer escapes through a volatile, so the compiler may not leave it out.
// This must NOT link as firmware; that it does not is the proof that images that do link never
// allocate.
#include "port/port.hpp"

int* volatile g_escaped;

int main() {
  port::init();
  g_escaped = new int[port::stack_bytes() + 1];
  return 0;
}
