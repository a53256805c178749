// The addresses and sizes that sections.ld decides. Only their addresses mean anything: see
// value_of().
#pragma once

#include <cstdint>

extern "C" {
extern std::uint32_t port_code_start[];
extern std::uint32_t port_code_length[];
extern std::uint32_t port_code_bytes[];
extern std::uint32_t port_devices_start[];
extern std::uint32_t port_devices_length[];
extern std::uint32_t port_ram_start[];
extern std::uint32_t port_ram_length[];
extern std::uint32_t port_ram_bytes[];
extern std::uint32_t port_stack_bottom[];
extern std::uint32_t port_stack_top[];
extern std::uint32_t port_handler_stack_bottom[];
extern std::uint32_t port_handler_stack_top[];
extern std::uint32_t port_data_start[];
extern std::uint32_t port_data_end[];
extern const std::uint32_t port_data_image[];
extern std::uint32_t port_bss_start[];
extern std::uint32_t port_bss_end[];
extern void (*const port_init_array_start[])();
extern void (*const port_init_array_end[])();
}

namespace port {

/// A symbol's address as a number.
inline std::uint32_t value_of(const std::uint32_t* symbol) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(symbol));
}

/// A device register, or any word at a fixed address.
inline volatile std::uint32_t& word_at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

/// What an unused stack word holds, written by the start-up code.
constexpr std::uint32_t kStackPaint = 0xC0DEFADEu;

}  // namespace port
