#include "start.hpp"

#include "port/port.hpp"
#include "symbols.hpp"

int main();

extern "C" {

/// Runs on the handlers' stack, so it may paint the whole of main()'s.
[[gnu::used]] void port_prepare_memory() {
  for (std::uint32_t* word = port_stack_bottom; word != port_stack_top; ++word) {
    *word = port::kStackPaint;
  }
  const std::uint32_t* image = port_data_image;
  for (std::uint32_t* word = port_data_start; word != port_data_end; ++word) *word = *image++;
  for (std::uint32_t* word = port_bss_start; word != port_bss_end; ++word) *word = 0;
  port::prepare_processor();
}

[[gnu::used, noreturn]] void port_run() {
  for (auto constructor = port_init_array_start; constructor != port_init_array_end;
       ++constructor) {
    (*constructor)();
  }
  port::exit(main());
}

}  // extern "C"
