// A processor fault becomes a line on the console and exit code 4: its name, where, and the fault
// registers.
#include "port/port.hpp"
#include "port/print.hpp"
#include "symbols.hpp"

namespace port {
namespace {

/// Configurable Fault Status Register and its bits (ARMv7-M B3.2.15), and the address registers.
[[maybe_unused]] constexpr std::uintptr_t kFaultStatus = 0xE000ED28;
[[maybe_unused]] constexpr std::uintptr_t kMemManageAddress = 0xE000ED34;
[[maybe_unused]] constexpr std::uintptr_t kBusFaultAddress = 0xE000ED38;
constexpr std::uint32_t kInstructionAccess = 1u << 0;
constexpr std::uint32_t kDataAccess = 1u << 1;
constexpr std::uint32_t kMemManageStacking = 1u << 4;
[[maybe_unused]] constexpr std::uint32_t kMemManageAddressValid = 1u << 7;
constexpr std::uint32_t kBusFaultStacking = 1u << 12;
constexpr std::uint32_t kBusFaultAddressValid = 1u << 15;
constexpr std::uint32_t kUndefinedInstruction = 1u << 16;
constexpr std::uint32_t kInvalidState = 1u << 17;
constexpr std::uint32_t kStackLimit = 1u << 20;
constexpr std::uint32_t kUnaligned = 1u << 24;
constexpr std::uint32_t kStacking = kMemManageStacking | kBusFaultStacking | kStackLimit;

const char* exception_name(std::uint32_t number) {
  static constexpr const char* kNames[] = {"thread",    "reset",    "NMI",        "HardFault",
                                           "MemManage", "BusFault", "UsageFault", "SecureFault"};
  return number < sizeof kNames / sizeof kNames[0] ? kNames[number] : "unexpected interrupt";
}

/// The likeliest cause in words. Any fault with the stack pointer outside the stack is an overflow,
/// whatever the processor calls it.
const char* cause(std::uint32_t status, std::uint32_t stack_pointer) {
  const bool below_stack = stack_pointer < value_of(port_stack_bottom);
  if (below_stack || (status & kStacking) != 0) return "stack overflow";
  if ((status & kInstructionAccess) != 0) return "call to a forbidden address";
  if ((status & kInvalidState) != 0) return "call to a null or damaged function pointer";
  if ((status & kUndefinedInstruction) != 0) return "undefined instruction";
  if ((status & kUnaligned) != 0) return "unaligned access";
  if ((status & (kDataAccess | kBusFaultAddressValid)) != 0) return "access to a forbidden address";
  return "processor fault";
}

}  // namespace
}  // namespace port

/// `frame`: r0-r3, r12, lr, pc, xpsr as the processor saved them on the stack it used, or tried to.
extern "C" [[gnu::used, noreturn]] void port_report_fault(const std::uint32_t* frame) {
  using namespace port;
  std::uint32_t exception = 0;
  asm volatile("mrs %0, ipsr" : "=r"(exception));
  const std::uint32_t stack_pointer = value_of(frame);
#if __ARM_ARCH >= 7
  const std::uint32_t status = word_at(kFaultStatus);
#else
  const std::uint32_t status = 0;  // ARMv6-M has one fault and keeps no record of its cause
#endif
  print("FAULT ", cause(status, stack_pointer), ": ", exception_name(exception));
  // The frame is unreadable if saving it was what failed.
  const bool saved = (status & kStacking) == 0 && stack_pointer >= value_of(port_stack_bottom);
  if (saved) print(" pc=", hex(frame[6]), " lr=", hex(frame[5]));
#if __ARM_ARCH >= 7
  print(" cfsr=", hex(status));
  const std::uint32_t address = word_at((status & kBusFaultAddressValid) != 0 ? kBusFaultAddress
                                                                             : kMemManageAddress);
  if ((status & (kBusFaultAddressValid | kMemManageAddressValid)) != 0) {
    print(" address=", hex(address));
  }
#endif
  print(" sp=", hex(stack_pointer), "\n");
  port::exit(4);
}

/// EXC_RETURN (in lr) bit 2 tells which stack the frame is on. In instructions of ARMv6-M.
extern "C" [[gnu::naked, gnu::used]] void port_fault() {
  asm volatile(
      "movs r0, #4 \n"
      "mov r1, lr \n"
      "tst r0, r1 \n"
      "beq 1f \n"
      "mrs r0, psp \n"
      "b 2f \n"
      "1: mrs r0, msp \n"
      "2: ldr r1, =port_report_fault \n"
      "bx r1 \n"
      ".pool \n");
}
