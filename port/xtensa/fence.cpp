// Region protection: memory is eight regions of 512 MB, and each has one attribute. So the limit of
// the RAM is the linker's alone, but null pointers and data that are run are refused.
#include "fence.hpp"

#include "symbols.hpp"

namespace port {
namespace {

constexpr std::uint32_t kRegionBytes = 1u << 29;
// The memory attributes of the region protection option.
constexpr std::uint32_t kData = 0, kCode = 1, kNothing = 15;

/// For loads and stores, and for instructions.
void protect(std::uint32_t region, std::uint32_t attribute) {
  asm volatile("wdtlb %0, %1 \n dsync" ::"r"(attribute), "r"(region * kRegionBytes) : "memory");
  asm volatile("witlb %0, %1 \n isync" ::"r"(attribute), "r"(region * kRegionBytes) : "memory");
}

}  // namespace

void raise_fence() {
  const std::uint32_t code = value_of(port_code_start) / kRegionBytes;
  const std::uint32_t ram = value_of(port_ram_start) / kRegionBytes;
  for (std::uint32_t region = 0; region < 8; ++region) {
    protect(region, region == code ? kCode : region == ram ? kData : kNothing);
  }
}

}  // namespace port
