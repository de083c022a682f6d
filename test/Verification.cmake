# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Checks outside GoogleTest: pinned labels of three fixtures, and distances against scipy.
# Included by test/CMakeLists.txt after ITK was found; reads MedialVoxel_TEST_DATA.

add_executable(MedialVoxelTestDump MedialVoxelTestDump.cxx)
medialvoxel_compile_options(MedialVoxelTestDump)
if(TARGET GTest::gtest)
  set(_gtest GTest::gtest)
elseif(TARGET GTest::GTest)
  set(_gtest GTest::GTest)
endif()
target_link_libraries(MedialVoxelTestDump PRIVATE MedialVoxelInternals ${ITK_LIBRARIES} ${_gtest})

# Inside ITK the target of all that belongs to a module names the test driver, not this program.
if(TARGET MedialVoxelGTestDriver)
  add_dependencies(MedialVoxelGTestDriver MedialVoxelTestDump)
endif()

add_test(
  NAME MedialVoxelFixtures
  COMMAND
    "${CMAKE_COMMAND}" -D "DUMP=$<TARGET_FILE:MedialVoxelTestDump>" -D "EMULATOR=${CMAKE_CROSSCOMPILING_EMULATOR}" -D
    "PINS=${CMAKE_CURRENT_SOURCE_DIR}/Fixtures.sha256" -D "FOLDER=${CMAKE_CURRENT_BINARY_DIR}/fixtures" -P
    "${CMAKE_CURRENT_SOURCE_DIR}/CheckFixtures.cmake")

# The system's interpreter first: it is the one that distribution packages of scipy serve.
find_program(MedialVoxel_PYTHON python3 HINTS /usr/bin DOC "Python that runs the comparison with scipy")
if(MedialVoxel_PYTHON)
  add_test(NAME MedialVoxelScipy
           COMMAND "${MedialVoxel_PYTHON}" "${CMAKE_CURRENT_SOURCE_DIR}/python/compare_scipy.py" --dump
                   "$<TARGET_FILE:MedialVoxelTestDump>" --data "${MedialVoxel_TEST_DATA}")
  set_tests_properties(MedialVoxelScipy PROPERTIES SKIP_RETURN_CODE 77 LABELS "MedialVoxel;identity")
endif()
set_tests_properties(MedialVoxelFixtures PROPERTIES LABELS "MedialVoxel;identity")
