// A trap of a processor that tells its cause by a number becomes a line on the console and exit
// code 4: its name, where, and the address it was about.
#pragma once

#include <cstddef>

#include "port/port.hpp"
#include "port/print.hpp"
#include "symbols.hpp"

namespace port {

struct Cause {
  std::uint32_t number;
  const char* name;
  const char* words;  ///< the likeliest cause
};
constexpr const char* kForbidden = "access to a forbidden address";
constexpr const char* kForbiddenCall = "call to a forbidden address";
constexpr const char* kUnaligned = "unaligned access";
constexpr const char* kUndefined = "undefined instruction";

/// What the processor's registers hold when a trap is taken.
struct Trap {
  std::uint32_t number = 0;
  std::uint32_t pc = 0;
  std::uint32_t address = 0;
};

/// Any fault with the stack pointer below the stack is an overflow. Inlined, as the handlers' stack
/// has no room for one more frame.
template <std::size_t Count>
[[noreturn, gnu::always_inline]] inline void report(const Cause (&causes)[Count], const Trap& trap,
                                                    std::uint32_t stack_pointer,
                                                    std::uint32_t return_address) {
  const char* name = "unexpected interrupt";
  const char* words = "processor fault";
  for (const Cause& cause : causes) {
    if (cause.number == trap.number) name = cause.name, words = cause.words;
  }
  if (words == kForbiddenCall && trap.pc == 0) words = "call to a null function pointer";
  if (stack_pointer < value_of(port_stack_bottom)) words = "stack overflow";
  print("FAULT ", words, ": ", name, " pc=", hex(trap.pc), " ra=", hex(return_address));
  print(" address=", hex(trap.address), " sp=", hex(stack_pointer), "\n");
  port::exit(4);
}

}  // namespace port
