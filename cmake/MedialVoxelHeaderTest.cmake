# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Each header must compile alone, and twice: one translation unit per header, as part of the build.

file(GLOB _headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/*.h"
     "${PROJECT_SOURCE_DIR}/src/*/*.h")
set(_units "")
foreach(_header IN LISTS _headers)
  get_filename_component(_stem "${_header}" NAME_WE)
  set(_unit "${PROJECT_BINARY_DIR}/header-test/${_stem}.cxx")
  file(CONFIGURE OUTPUT "${_unit}" CONTENT "#include \"${_stem}.h\"\n#include \"${_stem}.h\"\n")
  list(APPEND _units "${_unit}")
endforeach()
if(_units)
  add_library(MedialVoxelHeaderTest OBJECT ${_units})
  target_link_libraries(MedialVoxelHeaderTest PRIVATE MedialVoxel::Internals)
  medialvoxel_compile_options(MedialVoxelHeaderTest)
endif()
