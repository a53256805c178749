// An exception becomes a line on the console and exit code 4: its name, where, and the address it
// was about.
#include "port/port.hpp"
#include "port/print.hpp"
#include "symbols.hpp"

namespace port {
namespace {

/// The exceptions of the architecture (Xtensa ISA reference manual, table of EXCCAUSE).
struct Cause {
  std::uint32_t number;
  const char* name;
  const char* words;  ///< the likeliest cause
};
constexpr const char* kForbidden = "access to a forbidden address";
constexpr const char* kForbiddenCall = "call to a forbidden address";
constexpr Cause kCauses[] = {{0, "IllegalInstruction", "undefined instruction"},
                             {2, "InstructionFetchError", kForbiddenCall},
                             {3, "LoadStoreError", kForbidden},
                             {9, "LoadStoreAlignment", "unaligned access"},
                             {14, "InstrPIFAddrError", kForbiddenCall},
                             {15, "LoadStorePIFAddrError", kForbidden},
                             {20, "InstFetchProhibited", kForbiddenCall},
                             {28, "LoadProhibited", kForbidden},
                             {29, "StoreProhibited", kForbidden}};

Cause cause_of(std::uint32_t exception) {
  for (const Cause& cause : kCauses) {
    if (cause.number == exception) return cause;
  }
  return {exception, "unexpected interrupt", "processor fault"};
}

/// Any fault with the stack pointer below the stack is an overflow.
const char* words(const Cause& cause, std::uint32_t stack_pointer, std::uint32_t pc) {
  if (stack_pointer < value_of(port_stack_bottom)) return "stack overflow";
  return cause.words == kForbiddenCall && pc == 0 ? "call to a null function pointer" : cause.words;
}

}  // namespace
}  // namespace port

/// What port_trap found: main()'s stack pointer, and where the last call was to return to.
extern "C" [[gnu::used, noreturn]] void port_report_fault(std::uint32_t stack_pointer,
                                                          std::uint32_t return_address) {
  using namespace port;
  std::uint32_t exception = 0, pc = 0, address = 0;
  asm volatile("rsr.exccause %0" : "=r"(exception));
  asm volatile("rsr.epc1 %0" : "=r"(pc));
  asm volatile("rsr.excvaddr %0" : "=r"(address));
  const Cause cause = cause_of(exception);
  print("FAULT ", words(cause, stack_pointer, pc), ": ", cause.name, " pc=", hex(pc), " ra=",
        hex(return_address));
  print(" address=", hex(address), " sp=", hex(stack_pointer), "\n");
  port::exit(4);
}
