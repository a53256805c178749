set(board_processor lx106)
set(board_ram_end 60400000)
set(board_port ../bare_metal/port.cpp semihosting.cpp)
