# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# The library of the package without ITK and without the program: a compiler and the headers of JSON are enough.
include(GenerateExportHeader)

set(_root "${CMAKE_CURRENT_SOURCE_DIR}/..")
file(STRINGS "${_root}/CMakeLists.txt" _version REGEX "^ *VERSION [0-9.]+$")
string(REGEX REPLACE "[^0-9.]" "" MedialVoxel_VERSION "${_version}")

set(CMAKE_CXX_VISIBILITY_PRESET hidden)
include("${_root}/src/CompileOptions.cmake")

# JSON for Modern C++, of the system or of the package nlohmann_json, which pip installs for the build.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import nlohmann_json; print(nlohmann_json.__path__[0])" OUTPUT_VARIABLE _json
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
find_path(MedialVoxel_JSON_INCLUDE_DIR nlohmann/json.hpp HINTS "${_json}/include" REQUIRED)

# Folders that know nothing of ITK, and of others the files that the library calls.
set(_folders)
foreach(_folder IN ITEMS src shell apps/job)
  file(GLOB _found LIST_DIRECTORIES ON "${_root}/${_folder}/*")
  list(APPEND _folders ${_found})
endforeach()
list(FILTER _folders EXCLUDE REGEX "\\.[a-z]+$|/(test|dicom|clusters|products|records|run|formats|reports)$")
if(WIN32)
  list(APPEND _folders "${_root}/apps/job/system/windows")
else()
  list(APPEND _folders "${_root}/apps/job/system/posix")
endif()
set(_sources)
foreach(_folder IN LISTS _folders)
  file(GLOB _found CONFIGURE_DEPENDS "${_folder}/*.cxx")
  list(APPEND _sources ${_found})
endforeach()
list(FILTER _sources EXCLUDE REGEX "/(itkStreaming[A-Za-z]*|Program|Checksum|ItkVersion)\\.cxx$")
list(APPEND _sources native/WithoutFiles.cxx "${_root}/apps/job/formats/input/ValueStatistics.cxx")
foreach(_name IN ITEMS EscapeHtml FillIn LengthHistogram MeshJson WallJson *Warnings)
  file(GLOB _found CONFIGURE_DEPENDS "${_root}/apps/job/reports/${_name}.cxx")
  list(APPEND _sources ${_found})
endforeach()

add_library(MedialVoxelCore STATIC ${_sources})
generate_export_header(MedialVoxelCore BASE_NAME MedialVoxel EXPORT_FILE_NAME "${CMAKE_CURRENT_BINARY_DIR}/include/MedialVoxelExport.h"
                       EXPORT_MACRO_NAME MedialVoxel_EXPORT)
target_compile_definitions(MedialVoxelCore PUBLIC MEDIALVOXEL_STATIC_DEFINE MEDIALVOXEL_VERSION="${MedialVoxel_VERSION}")
target_include_directories(MedialVoxelCore PUBLIC "${CMAKE_CURRENT_BINARY_DIR}/include" "${_root}/include" ${_folders}
                                                  "${_root}/apps/job/formats/input" "${_root}/apps/job/formats/volume" "${_root}/apps/job/reports")
target_include_directories(MedialVoxelCore SYSTEM PUBLIC "${MedialVoxel_JSON_INCLUDE_DIR}")
find_package(Threads REQUIRED)
target_link_libraries(MedialVoxelCore PUBLIC Threads::Threads)
medialvoxel_compile_options(MedialVoxelCore)
