# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# The installed package as a consumer meets it: install to a new prefix, then configure, build and run the examples.

set(_prefix "${PROJECT_BINARY_DIR}/package-test/prefix")
set(_consumer "${PROJECT_BINARY_DIR}/package-test/build")

add_test(NAME MedialVoxelPackageClean COMMAND "${CMAKE_COMMAND}" -E rm -rf "${PROJECT_BINARY_DIR}/package-test")
add_test(NAME MedialVoxelPackageInstall COMMAND "${CMAKE_COMMAND}" --install "${PROJECT_BINARY_DIR}" --prefix
                                                "${_prefix}" --config $<CONFIG>)
add_test(
  NAME MedialVoxelPackageConsumer
  COMMAND
    "${CMAKE_CTEST_COMMAND}" --build-and-test "${PROJECT_SOURCE_DIR}/examples" "${_consumer}" --build-generator
    "${CMAKE_GENERATOR}" --build-noclean --build-options "-DCMAKE_PREFIX_PATH=${_prefix}" "-DITK_DIR=${ITK_DIR}"
    "-DCMAKE_BUILD_TYPE=$<CONFIG>" "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" --test-command
    "${CMAKE_CTEST_COMMAND}" --output-on-failure --no-tests=error)

set_tests_properties(MedialVoxelPackageClean MedialVoxelPackageInstall MedialVoxelPackageConsumer
                     PROPERTIES LABELS "MedialVoxel;program")
set_tests_properties(MedialVoxelPackageClean PROPERTIES FIXTURES_SETUP MedialVoxelPackageFolder)
set_tests_properties(MedialVoxelPackageInstall PROPERTIES FIXTURES_REQUIRED MedialVoxelPackageFolder FIXTURES_SETUP
                                                                                                     MedialVoxelPackage)
set_tests_properties(MedialVoxelPackageConsumer PROPERTIES FIXTURES_REQUIRED MedialVoxelPackage)

# The module alone: without the folders beside it, against an installed ITK.
set(_alone "${PROJECT_BINARY_DIR}/alone")
file(MAKE_DIRECTORY "${_alone}")
foreach(_item IN ITEMS CMakeLists.txt itk-module.cmake include src test wrapping)
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${_item}" "${_alone}/${_item}" RESULT _linked SYMBOLIC)
endforeach()
add_test(NAME MedialVoxelAlone COMMAND "${CMAKE_COMMAND}" -G "${CMAKE_GENERATOR}" -S "${_alone}" -B "${_alone}/build"
                                       "-DITK_DIR=${ITK_DIR}" "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" -DBUILD_TESTING=ON)
set_tests_properties(MedialVoxelAlone PROPERTIES LABELS "MedialVoxel;program")
