// A trap becomes a line on the console and exit code 4: its name, where, and the address it was
// about.
#include "port/port.hpp"
#include "port/print.hpp"
#include "symbols.hpp"

namespace port {
namespace {

/// The exceptions of the privileged architecture (table of mcause), by their numbers.
constexpr const char* kNames[] = {
    "InstructionMisaligned", "InstructionAccess", "IllegalInstruction", "Breakpoint",
    "LoadMisaligned",        "LoadAccess",        "StoreMisaligned",    "StoreAccess"};
constexpr std::uint32_t kKinds = sizeof kNames / sizeof kNames[0];

/// The likeliest cause in words. Any fault with the stack pointer below the stack is an overflow.
const char* cause(std::uint32_t exception, std::uint32_t stack_pointer, std::uint32_t pc) {
  if (stack_pointer < value_of(port_stack_bottom)) return "stack overflow";
  switch (exception) {
    case 0: return "call to a damaged function pointer";
    case 1: return pc == 0 ? "call to a null function pointer" : "call to a forbidden address";
    case 2: return "undefined instruction";
    case 4:
    case 6: return "unaligned access";
    case 5:
    case 7: return "access to a forbidden address";
    default: return "processor fault";
  }
}

}  // namespace
}  // namespace port

/// What port_trap found: main()'s stack pointer, and where the last call was to return to.
extern "C" [[gnu::used, noreturn]] void port_report_fault(std::uint32_t stack_pointer,
                                                          std::uint32_t return_address) {
  using namespace port;
  std::uint32_t exception = 0, pc = 0, address = 0;
  asm volatile("csrr %0, mcause" : "=r"(exception));
  asm volatile("csrr %0, mepc" : "=r"(pc));
  asm volatile("csrr %0, mtval" : "=r"(address));
  print("FAULT ", cause(exception, stack_pointer, pc), ": ",
        exception < kKinds ? kNames[exception] : "unexpected interrupt", " pc=", hex(pc),
        " ra=", hex(return_address));
  print(" address=", hex(address), " sp=", hex(stack_pointer), "\n");
  port::exit(4);
}
