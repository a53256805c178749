set(board_processor cortex-m4)
set(board_timer cmsdk_dual)
