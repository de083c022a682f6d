# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Builds the module against an installed ITK, which lacks ITK's own module macros: small stand-ins for two of them
# let itk-module.cmake and src/CMakeLists.txt serve all ways to build.

include(GenerateExportHeader)
include(CMakePackageConfigHelpers)

if(PROJECT_IS_TOP_LEVEL)
  include(CTest)
endif()

get_property(_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(PROJECT_IS_TOP_LEVEL AND NOT _multi_config AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()
option(BUILD_SHARED_LIBS "Build MedialVoxel as a shared library" ON)

include("${CMAKE_CURRENT_LIST_DIR}/InstallPaths.cmake")

# Stand-in for ITK's macro: records what itk-module.cmake declares.
macro(itk_module name)
  set(itk-module ${name})
  cmake_parse_arguments(
    ITK_MODULE_${name} "EXCLUDE_FROM_DEFAULT;ENABLE_SHARED" "DESCRIPTION"
    "DEPENDS;PRIVATE_DEPENDS;COMPILE_DEPENDS;TEST_DEPENDS;FACTORY_NAMES" ${ARGN})
  set(ITK_MODULE_${name}-Test_DEPENDS ${name} ${ITK_MODULE_${name}_TEST_DEPENDS})
endmacro()

# Stand-in for ITK's macro: the library with ITK's names for file, export macro and export header.
macro(itk_module_add_library name)
  add_library(${name} ${ARGN})
  set_target_properties(
    ${name}
    PROPERTIES OUTPUT_NAME "itk${name}-${ITK_VERSION_MAJOR}.${ITK_VERSION_MINOR}"
               VERSION ${PROJECT_VERSION}
               SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(${name} PUBLIC cxx_std_17)
  target_include_directories(${name} SYSTEM PUBLIC "$<BUILD_INTERFACE:${MedialVoxelITK_INCLUDE_DIRS}>")
  target_link_libraries(${name} PUBLIC ${MedialVoxelITK_LIBRARIES})
  generate_export_header(
    ${name}
    EXPORT_FILE_NAME "${PROJECT_BINARY_DIR}/include/${name}Export.h"
    EXPORT_MACRO_NAME ${name}_EXPORT
    NO_EXPORT_MACRO_NAME ${name}_HIDDEN
    STATIC_DEFINE ${name}_STATIC)
  if(NOT BUILD_SHARED_LIBS)
    target_compile_definitions(${name} PUBLIC ${name}_STATIC)
  endif()
endmacro()

include("${PROJECT_SOURCE_DIR}/itk-module.cmake")
find_package(ITK 5.2 REQUIRED COMPONENTS ${ITK_MODULE_MedialVoxel_DEPENDS})
itk_module_config(MedialVoxelITK ${ITK_MODULE_MedialVoxel_DEPENDS})
add_subdirectory("${PROJECT_SOURCE_DIR}/src")

# Optional, as all folders beside the module
include("${PROJECT_SOURCE_DIR}/cmake/MedialVoxelInstall.cmake" OPTIONAL)
if(BUILD_TESTING AND PROJECT_IS_TOP_LEVEL)
  include("${PROJECT_SOURCE_DIR}/cmake/MedialVoxelHeaderTest.cmake" OPTIONAL)
  add_subdirectory("${PROJECT_SOURCE_DIR}/test")
endif()
