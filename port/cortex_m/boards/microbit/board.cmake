set(board_processor cortex-m0)
set(board_sources timers/nrf51.cpp)
set(board_ram_end 20004000)
