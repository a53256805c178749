// Physical memory protection: the first entry that an address lies in decides. Locked entries bind
// machine mode too, in which everything here runs.
#include "fence.hpp"

#include "symbols.hpp"

namespace port {
namespace {

// An entry's byte of configuration; its address register counts words.
constexpr std::uint32_t kRead = 1u << 0, kWrite = 1u << 1, kRun = 1u << 2, kLocked = 1u << 7;
constexpr std::uint32_t kUpTo = 1u << 3;        ///< from the address of the entry before
constexpr std::uint32_t kPowerOfTwo = 3u << 3;  ///< as long as the ones at the address's end say
constexpr std::uint32_t kEverywhere = 0xFFFFFFFFu;

}  // namespace

void raise_fence() {
  const std::uint32_t code = value_of(port_code_start), ram = value_of(port_ram_start);
  const std::uint32_t devices = value_of(port_devices_start);
  asm volatile("csrw pmpaddr0, %0" ::"r"(code >> 2));
  asm volatile("csrw pmpaddr1, %0" ::"r"((code + value_of(port_code_length)) >> 2));
  asm volatile("csrw pmpaddr2, %0" ::"r"(ram >> 2));
  asm volatile("csrw pmpaddr3, %0" ::"r"((ram + value_of(port_ram_length)) >> 2));
  asm volatile("csrw pmpaddr4, %0" ::"r"(devices >> 2));
  asm volatile("csrw pmpaddr5, %0" ::"r"((devices + value_of(port_devices_length)) >> 2));
  asm volatile("csrw pmpaddr6, %0" ::"r"(kEverywhere));
  constexpr std::uint32_t kCode = kLocked | kUpTo | kRead | kRun;
  constexpr std::uint32_t kData = kLocked | kUpTo | kRead | kWrite;
  constexpr std::uint32_t kNothing = kLocked | kPowerOfTwo;
  // What is allowed first: from the second line on nothing else is.
  asm volatile("csrw pmpcfg0, %0" ::"r"(kData << 24 | kCode << 8) : "memory");
  asm volatile("csrw pmpcfg1, %0" ::"r"(kNothing << 16 | kData << 8) : "memory");
}

}  // namespace port
