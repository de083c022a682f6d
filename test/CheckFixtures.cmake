# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Labels of the fixtures against their pinned SHA-256.
# Usage: cmake -D DUMP=<MedialVoxelTestDump> -D PINS=<Fixtures.sha256> -D FOLDER=<scratch> [-D EMULATOR=<what runs it>]
#          -P CheckFixtures.cmake

file(MAKE_DIRECTORY "${FOLDER}")
file(STRINGS "${PINS}" lines)
list(LENGTH lines count)
if(NOT count EQUAL 3)
  message(FATAL_ERROR "${PINS} lists ${count} fixtures instead of 3")
endif()
foreach(line IN LISTS lines)
  string(REGEX MATCH "^([0-9a-f]+)  ([a-z]+)[.]labels$" matched "${line}")
  set(pinned "${CMAKE_MATCH_1}")
  set(fixture "${CMAKE_MATCH_2}")
  if(NOT matched)
    message(FATAL_ERROR "${PINS}: '${line}' is not '<sha256>  <fixture>.labels'")
  endif()
  execute_process(COMMAND ${EMULATOR} "${DUMP}" labels "${fixture}" "${FOLDER}/${fixture}.labels" RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${DUMP} labels ${fixture} failed: ${status}")
  endif()
  file(SHA256 "${FOLDER}/${fixture}.labels" actual)
  if(NOT actual STREQUAL pinned)
    message(SEND_ERROR "labels of fixture ${fixture} have SHA-256 ${actual}, pinned is ${pinned}")
  endif()
endforeach()
