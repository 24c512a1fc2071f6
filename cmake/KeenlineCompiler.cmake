# One set of compiler rules for everything that is built here.
add_library(keenline_compiler INTERFACE)
target_compile_features(keenline_compiler INTERFACE cxx_std_20)
set(CMAKE_CXX_EXTENSIONS OFF)
target_compile_options(keenline_compiler INTERFACE
  # Same bits on every CPU and from every compiler: no fused multiply-add behind our back, no fast-math.
  -ffp-contract=off
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Woverloaded-virtual -Wdouble-promotion -Wimplicit-fallthrough
  # False alarms of GCC 12 inside std::string and fmt (GCC bugs 105651, 105329).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  $<$<BOOL:${KEENLINE_WARNINGS_AS_ERRORS}>:-Werror>
  $<$<BOOL:${KEENLINE_ASSERTIONS}>:-UNDEBUG>)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
