set(board_processor riscv32)
set(board_ram_end 80004000)
set(board_small yes)
