#include "trap.hpp"

namespace port {
namespace {

/// The exceptions of the architecture (Xtensa ISA reference manual, table of EXCCAUSE).
constexpr Cause kCauses[] = {{0, "IllegalInstruction", kUndefined},
                             {2, "InstructionFetchError", kForbiddenCall},
                             {3, "LoadStoreError", kForbidden},
                             {9, "LoadStoreAlignment", kUnaligned},
                             {14, "InstrPIFAddrError", kForbiddenCall},
                             {15, "LoadStorePIFAddrError", kForbidden},
                             {20, "InstFetchProhibited", kForbiddenCall},
                             {28, "LoadProhibited", kForbidden},
                             {29, "StoreProhibited", kForbidden}};

}  // namespace
}  // namespace port

/// What port_trap found: main()'s stack pointer, and where the last call was to return to.
extern "C" [[gnu::used, noreturn]] void port_report_fault(std::uint32_t stack_pointer,
                                                          std::uint32_t return_address) {
  port::Trap trap;
  asm volatile("rsr.exccause %0" : "=r"(trap.number));
  asm volatile("rsr.epc1 %0" : "=r"(trap.pc));
  asm volatile("rsr.excvaddr %0" : "=r"(trap.address));
  port::report(port::kCauses, trap, stack_pointer, return_address);
}
