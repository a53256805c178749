set(board_processor cortex-m0)
set(board_timer nrf51)
