# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# The header libraries of the programs, where the system has none, such as on the machines that build extensions of
# 3D Slicer: neither is a part of Slicer's build. Both are compiled in; nothing of them is installed.

find_package(CLI11 QUIET)
if(NOT CLI11_FOUND)
  include(FetchContent)
  # Version 2.4.2, by the name of its commit, so that nothing else can take its place.
  FetchContent_Declare(
    CLI11
    GIT_REPOSITORY https://github.com/CLIUtils/CLI11.git
    GIT_TAG 6c7b07a878ad834957b98d0f9ce1dbe0cb204fc9)
  set(CLI11_INSTALL OFF CACHE BOOL "Install CLI11" FORCE)
  set(CLI11_BUILD_TESTS OFF CACHE BOOL "Build the tests of CLI11" FORCE)
  FetchContent_MakeAvailable(CLI11)
endif()

find_package(nlohmann_json QUIET)
if(NOT nlohmann_json_FOUND)
  # Version 3.11.3 as two files: its repository is large.
  set(MedialVoxel_JSON_URL
      "https://raw.githubusercontent.com/nlohmann/json/9cca280a4d0ccf0c08f47a99aa71d1b0e52f8d03/single_include/nlohmann"
      CACHE STRING "Where the headers of nlohmann_json 3.11.3 are; may be file://")
  set(_json "${CMAKE_BINARY_DIR}/nlohmann_json")
  set(_json_hash_of_json 9bea4c8066ef4a1c206b2be5a36302f8926f7fdc6087af5d20b417d0cf103ea6)
  set(_json_hash_of_json_fwd 5cefbba751baf5243033fd894c70be9b37103d64b3d3a959e4173197d71137b9)
  foreach(_header IN ITEMS json json_fwd)
    file(
      DOWNLOAD "${MedialVoxel_JSON_URL}/${_header}.hpp" "${_json}/nlohmann/${_header}.hpp"
      EXPECTED_HASH SHA256=${_json_hash_of_${_header}}
      TLS_VERIFY ON)
  endforeach()
  add_library(nlohmann_json INTERFACE)
  add_library(nlohmann_json::nlohmann_json ALIAS nlohmann_json)
  target_include_directories(nlohmann_json SYSTEM INTERFACE "${_json}")
endif()
