# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Compiles and links everything that follows with MedialVoxel_SANITIZERS; the first finding ends a program.
if(MedialVoxel_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "MedialVoxel_BUILD_FUZZERS is ON, but ${CMAKE_CXX_COMPILER} is not Clang; libFuzzer comes with it")
  endif()
  # Coverage of all code, but no main function.
  add_compile_options(-fsanitize=fuzzer-no-link)
  # Debian's ITK 5.2 has words of C++11 only for the compiler that built it, GCC, and refuses Clang; it needs this one.
  add_compile_definitions(ITK_COMPILER_DETECTION_H ITK_NOEXCEPT=noexcept)
endif()
if(MedialVoxel_SANITIZERS)
  # The checks of libstdc++ see indices out of range that stay inside an allocation.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  add_compile_options("-fsanitize=${MedialVoxel_SANITIZERS}" -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options("-fsanitize=${MedialVoxel_SANITIZERS}")
endif()
