# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Each header must compile alone, and twice: one translation unit per header, as part of the build.

# medialvoxel_add_header_test(<target> <library of the headers> <header>...)
function(medialvoxel_add_header_test target library)
  set(units "")
  foreach(header IN LISTS ARGN)
    get_filename_component(stem "${header}" NAME_WE)
    set(unit "${PROJECT_BINARY_DIR}/header-test/${stem}.cxx")
    file(CONFIGURE OUTPUT "${unit}" CONTENT "#include \"${stem}.h\"\n#include \"${stem}.h\"\n")
    list(APPEND units "${unit}")
  endforeach()
  add_library(${target} OBJECT ${units})
  target_link_libraries(${target} PRIVATE ${library})
  medialvoxel_compile_options(${target})
endfunction()

file(GLOB _headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/*.h" "${PROJECT_SOURCE_DIR}/src/*/*.h")
medialvoxel_add_header_test(MedialVoxelHeaderTest MedialVoxel::Internals ${_headers})
