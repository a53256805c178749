// Memory protection. ARMv7-M (B3.5): regions are powers of two, a later region wins over an earlier
// one. ARMv8-M (D1.2): regions are [base, limit] in steps of 32 bytes and may not overlap.
#include "fence.hpp"

#include "symbols.hpp"

namespace port {

#if __ARM_ARCH >= 7
namespace {

constexpr std::uintptr_t kControl = 0xE000ED94;
constexpr std::uintptr_t kNumber = 0xE000ED98;
constexpr std::uintptr_t kBase = 0xE000ED9C;
constexpr std::uintptr_t kAttribute = 0xE000EDA0;  // v7: attributes and size; v8: limit
constexpr std::uint32_t kEnable = 1u;
constexpr std::uint32_t kDeviceStart = 0x40000000u;
constexpr std::uint32_t kDeviceLength = 0x20000000u;

enum class Access { kCode, kData, kDevice, kNone };

#if defined(__ARM_ARCH_8M_MAIN__)

constexpr std::uintptr_t kMemoryAttributes =
    0xE000EDC0;  // MAIR0: what the regions' index points at

void set_region(std::uint32_t number, std::uint32_t start, std::uint32_t length, Access access) {
  constexpr std::uint32_t kNeverExecute = 1u, kReadWrite = 0u << 1, kReadOnly = 2u << 1;
  const std::uint32_t rights = access == Access::kCode ? kReadOnly : kReadWrite | kNeverExecute;
  const std::uint32_t attribute_index = access == Access::kDevice ? 1u : 0u;
  word_at(kNumber) = number;
  word_at(kBase) = start | rights;
  word_at(kAttribute) = ((start + length - 1u) & ~31u) | attribute_index << 1 | kEnable;
}

void set_regions() {
  word_at(kMemoryAttributes) = 0x0444u;  // 0: normal, not cached; 1: device
  set_region(0, value_of(port_code_start), value_of(port_code_length), Access::kCode);
  set_region(1, value_of(port_ram_start), value_of(port_ram_length), Access::kData);
  set_region(2, kDeviceStart, kDeviceLength, Access::kDevice);
}

#else

std::uint32_t rights_of(Access access) {
  constexpr std::uint32_t kNeverExecute = 1u << 28, kReadOnly = 6u << 24, kReadWrite = 3u << 24;
  constexpr std::uint32_t kNormal = 1u << 19, kDevice = 1u << 18 | 1u << 16;
  switch (access) {
    case Access::kCode: return kReadOnly | kNormal;
    case Access::kData: return kReadWrite | kNormal | kNeverExecute;
    case Access::kDevice: return kReadWrite | kDevice | kNeverExecute;
    case Access::kNone: break;
  }
  return kNeverExecute;
}

/// `length` is a power of two >= 32 and divides `start`.
void set_region(std::uint32_t number, std::uint32_t start, std::uint32_t length, Access access) {
  const auto log2_length = static_cast<std::uint32_t>(31 - __builtin_clz(length));
  word_at(kNumber) = number;
  word_at(kBase) = start;
  word_at(kAttribute) = rights_of(access) | (log2_length - 1u) << 1 | kEnable;
}

void set_regions() {
  set_region(0, value_of(port_code_start), value_of(port_code_length), Access::kCode);
  set_region(1, value_of(port_ram_start), value_of(port_ram_length), Access::kData);
  set_region(2, kDeviceStart, kDeviceLength, Access::kDevice);
  // The vector table lies at 0 on some boards; the processor still fetches vectors, a program may
  // not.
  set_region(3, 0, 64, Access::kNone);
}

#endif
}  // namespace

void raise_fence() {
  set_regions();
  word_at(kControl) = kEnable;  // and not PRIVDEFENA: what no region allows is refused
  asm volatile("dsb \n isb" ::: "memory");
}

#else

void raise_fence() {}

#endif

}  // namespace port
