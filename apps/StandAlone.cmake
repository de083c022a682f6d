# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# What the project around the programs says otherwise.
include(GNUInstallDirs)

get_property(_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT _multi_config AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()
find_package(MedialVoxel REQUIRED)
if(NOT TARGET MedialVoxel::Internals)
  message(STATUS "This MedialVoxel has no target MedialVoxel::Internals: its headers have to be all beside its filters")
endif()

# Programs find the library beside themselves after an install to any prefix.
if(APPLE)
  set(_origin "@loader_path")
else()
  set(_origin "$ORIGIN")
endif()
file(RELATIVE_PATH _bin_to_lib "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH "${_origin}/${_bin_to_lib}" "${_origin}")

include("${CMAKE_CURRENT_LIST_DIR}/../src/CompileOptions.cmake")
