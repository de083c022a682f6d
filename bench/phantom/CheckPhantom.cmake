# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

cmake_minimum_required(VERSION 3.22.1...3.29.0)

# Checks the phantom generator: cmake -D PROGRAM=<medialvoxel-phantom> -D FOLDER=<scratch folder> -P CheckPhantom.cmake

# generate(<output> <options>...): runs the program and sets SUMMARY and DIGEST.
function(generate output)
  execute_process(COMMAND "${PROGRAM}" ${ARGN} OUTPUT_VARIABLE summary RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "Exit status ${status}: ${ARGN}")
  endif()
  file(SHA256 "${output}" digest)
  set(SUMMARY "${summary}" PARENT_SCOPE)
  set(DIGEST "${digest}" PARENT_SCOPE)
endfunction()

function(expect actual expected what)
  if(NOT "${actual}" STREQUAL "${expected}")
    message(FATAL_ERROR "${what}: got ${actual}, expected ${expected}")
  endif()
endfunction()

file(MAKE_DIRECTORY "${FOLDER}")
set(file "${FOLDER}/phantom.raw")

foreach(kind IN ITEMS side-frame cover solids gyroid plate plates shell shells t-junction)
  set(options ${kind} "${file}" --size 75,64,83 --noise 1 --seed 7)
  generate("${file}" ${options} --slab 1 --threads 1)
  set(first "${DIGEST}")
  generate("${file}" ${options} --slab 29 --threads 3)
  expect("${DIGEST}" "${first}" "${kind}: bytes of other slabs and threads")
endforeach()

# Plates of 1 to 8 voxels across 64 x 64.
generate("${file}" plates "${file}" --size 64,64,64)
string(JSON voxels GET "${SUMMARY}" object_voxels)
expect("${voxels}" 147456 "object voxels of plates")

generate("${FOLDER}/phantom.mha" plate "${FOLDER}/phantom.mha" --size 9,5,7 --type uint16)
file(SIZE "${FOLDER}/phantom.mha" size)
file(READ "${FOLDER}/phantom.mha" header LIMIT 210)
string(FIND "${header}" "LOCAL\n" end)
math(EXPR expected "${end} + 6 + 2 * 9 * 5 * 7")
expect("${size}" "${expected}" "size of a MetaImage file")

execute_process(COMMAND "${PROGRAM}" plate "${FOLDER}/phantom.tif" RESULT_VARIABLE status ERROR_QUIET)
expect("${status}" 2 "exit status with an unknown extension")
