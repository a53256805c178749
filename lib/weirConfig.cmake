# What find_package(weir) reads.
include(CMakeFindDependencyMacro)
if(NOT CMAKE_SYSTEM_NAME STREQUAL "Generic")
  find_dependency(Threads)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/weirTargets.cmake)
