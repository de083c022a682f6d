# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# The installed package: find_package(MedialVoxel) and the target MedialVoxel::MedialVoxel.

set(_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/MedialVoxel")
set(_headers_dir "${CMAKE_INSTALL_INCLUDEDIR}/MedialVoxel")

target_include_directories(MedialVoxel PUBLIC "$<INSTALL_INTERFACE:${_headers_dir}>")
install(
  TARGETS MedialVoxel
  EXPORT MedialVoxelTargets
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT Runtime
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT Runtime NAMELINK_COMPONENT Development
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT Development)
install(
  DIRECTORY "${PROJECT_SOURCE_DIR}/include/" "${PROJECT_BINARY_DIR}/include/"
  DESTINATION ${_headers_dir}
  COMPONENT Development
  FILES_MATCHING
  PATTERN "*.h"
  PATTERN "*.hxx")

# MedialVoxel::Internals, for the programs, which may be built on an installed package.
get_target_property(_folders MedialVoxelInternals MedialVoxel_FOLDERS)
foreach(_folder IN LISTS _folders)
  target_include_directories(MedialVoxelInternals INTERFACE "$<INSTALL_INTERFACE:${_headers_dir}/Internals/${_folder}>")
endforeach()
install(TARGETS MedialVoxelInternals EXPORT MedialVoxelTargets)
install(
  DIRECTORY "${PROJECT_SOURCE_DIR}/src/"
  DESTINATION ${_headers_dir}/Internals
  COMPONENT Development
  FILES_MATCHING
  PATTERN "*.h")
install(
  EXPORT MedialVoxelTargets
  NAMESPACE MedialVoxel::
  DESTINATION ${_package_dir}
  COMPONENT Development)

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/MedialVoxelConfig.cmake.in" "${PROJECT_BINARY_DIR}/MedialVoxelConfig.cmake"
  INSTALL_DESTINATION ${_package_dir})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/MedialVoxelConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(
  FILES "${PROJECT_BINARY_DIR}/MedialVoxelConfig.cmake" "${PROJECT_BINARY_DIR}/MedialVoxelConfigVersion.cmake"
  DESTINATION ${_package_dir}
  COMPONENT Development)
install(
  FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/NOTICE"
  DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT Runtime)
