# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# What the project around the programs says otherwise.
get_property(_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT _multi_config AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()
find_package(MedialVoxel REQUIRED)
if(NOT TARGET MedialVoxel::Internals)
  message(STATUS "This MedialVoxel has no target MedialVoxel::Internals: its headers have to be all beside its filters")
endif()

include("${CMAKE_CURRENT_LIST_DIR}/../src/InstallPaths.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/../src/CompileOptions.cmake")
