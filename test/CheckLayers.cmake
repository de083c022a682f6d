# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Checks the direction of dependency between folders: cmake -D SOURCE=<project folder> -P CheckLayers.cmake
# A file includes only files of its own folder and of folders that stand before it in these tables.
cmake_minimum_required(VERSION 3.22.1...3.29.0)

# Folders of src. No file in them includes a header of ITK, but for those named below.
set(library Foundation IO Object Distance Topology Geodesic Walls Cells Engine Run Surface)

# What users of the module include: filters stand above all folders, and both filters and image IO use ITK.
set(filters "^(itkMedialVoxel(Objects)?ImageFilter|itkMedialVoxel(Object|Sheet)Properties|itkMedialVoxelMemoryError|itkMedialSurface(Mesh|Progress)|itkVectorDistanceMap|itkLocalThickness)[A-Za-z]*$")
set(image_io "^itkStreaming[A-Za-z]*$")

# A header in include/ belongs to the folder of its .cxx. These have none, or another folder than their .cxx.
set(folder_of_itkMedialVoxelBettiNumbers Topology)
set(folder_of_itkMedialVoxelRows Foundation)
set(folder_of_itkMedialVoxelScan Foundation)
set(folder_of_itkMedialVoxelSmoothingLevel Foundation)
set(folder_of_itkMedialVoxelSquaredLengths Distance)
set(folder_of_itkMedialVoxelValues Foundation)

# Folders beside the module; those of shell know nothing of ITK.
set(program
    shell/Isosurface
    shell/Remeshing
    shell/Structure
    apps/job/system
    apps/job/base
    apps/job/model
    apps/job/dicom
    apps/job/files
    apps/job/formats/volume
    apps/job/formats/plain
    apps/job/formats/text
    apps/job/formats/zarr
    apps/job/formats/slices
    apps/job/formats/catalog
    apps/job/formats/input
    apps/job/meshes
    apps/job/options
    apps/job/records
    apps/job/reports
    apps/job/products
    apps/job/run
    apps/job/clusters
    apps/commandline
    apps/medialvoxel
    apps/MedialVoxelExtraction)

# Of these, what no other folder includes: programs, and formats that the build may leave out.
set(closed apps/medialvoxel apps/MedialVoxelExtraction apps/job/formats/text apps/job/formats/zarr apps/job/formats/slices)

# The one folder that calls the system, with a room for each kind. What others include in <> is of the C++ library, or of these
# libraries.
set(system_folder apps/job/system)
set(other_libraries "^(CLI/|nlohmann/|itksys/|gdcm|blosc\\.h$|zstd\\.h$|tiffio\\.h$|png\\.h$|jpeglib\\.h$)")

set(violations "")

# get_unit(<variable> <file>): its name without the end that the files of a unit differ in
function(get_unit variable file)
  get_filename_component(name "${file}" NAME)
  string(REGEX REPLACE "(Private)?\\.(h|hxx|cxx|cxx\\.in)$" "" name "${name}")
  set(${variable} "${name}" PARENT_SCOPE)
endfunction()

# check_includes(<file> <folder> <folders>): of what stands in folder_of_<unit>
function(check_includes file folder folders)
  get_unit(unit "${file}")
  list(FIND folders "${folder}" rank)
  file(STRINGS "${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[\"<]")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^[^\"<]*[\"<]([^\">]*).*" "\\1" header "${line}")
    get_unit(included "${header}")
    set(other "${folder_of_${included}}")
    list(FIND folders "${other}" other_rank)
    get_filename_component(name "${file}" NAME)
    if(line MATCHES "<" AND calls_no_system AND header MATCHES "[./]|^csignal$" AND NOT header MATCHES "${other_libraries}")
      list(APPEND violations "${folder}/${name}: <${header}> is of the system, which ${system_folder} calls")
    elseif(other STREQUAL "")
      if(header MATCHES "^(itk|vnl|vcl)" AND NOT header MATCHES "Export\\.h$" AND uses_no_itk)
        list(APPEND violations "${folder}/${name}: ${header} is not a header of these folders")
      endif()
    elseif(other_rank GREATER rank OR (other IN_LIST closed AND NOT other STREQUAL folder))
      list(APPEND violations "${folder}/${name}: ${header} is of ${other}, which stands above or is closed")
    endif()
  endforeach()
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

# Where each unit of the library is: the folder of its file in src, unless a row says otherwise.
set(library_files "")
foreach(folder IN LISTS library)
  file(GLOB files "${SOURCE}/src/${folder}/*.h" "${SOURCE}/src/${folder}/*.hxx" "${SOURCE}/src/${folder}/*.cxx")
  list(APPEND library_files ${files})
  foreach(file IN LISTS files)
    get_unit(unit "${file}")
    if(NOT folder_of_${unit})
      set(folder_of_${unit} ${folder})
    endif()
  endforeach()
endforeach()
file(GLOB_RECURSE all_files "${SOURCE}/src/*.h" "${SOURCE}/src/*.hxx" "${SOURCE}/src/*.cxx")
list(REMOVE_ITEM all_files ${library_files} "")
foreach(file IN LISTS all_files)
  list(APPEND violations "${file} is in no folder of the table")
endforeach()
file(GLOB headers "${SOURCE}/include/*.h" "${SOURCE}/include/*.hxx")
list(APPEND library_files ${headers})
if(NOT library_files)
  message(FATAL_ERROR "No source of MedialVoxel in '${SOURCE}'")
endif()

foreach(file IN LISTS library_files)
  get_unit(unit "${file}")
  if(unit MATCHES "${filters}")
    set(folder_of_${unit} Filters)
  elseif(NOT folder_of_${unit})
    list(APPEND violations "${unit}: belongs to no folder, as it has no .cxx; the table needs a row for it")
    set(folder_of_${unit} Foundation)
  endif()
endforeach()
foreach(file IN LISTS library_files)
  get_unit(unit "${file}")
  set(uses_no_itk ON)
  set(calls_no_system OFF)
  if(unit MATCHES "${filters}|${image_io}")
    set(uses_no_itk OFF)
  endif()
  check_includes("${file}" ${folder_of_${unit}} "${library};Filters")
endforeach()

set(program_files "")
foreach(folder IN LISTS program)
  file(GLOB files "${SOURCE}/${folder}/*.h" "${SOURCE}/${folder}/*.hxx" "${SOURCE}/${folder}/*.cxx" "${SOURCE}/${folder}/*.cxx.in")
  if(folder STREQUAL system_folder)
    file(GLOB files "${SOURCE}/${folder}/*.h" "${SOURCE}/${folder}/*.cxx" "${SOURCE}/${folder}/*/*.h" "${SOURCE}/${folder}/*/*.cxx")
  endif()
  list(APPEND program_files ${files})
  foreach(file IN LISTS files)
    get_unit(unit "${file}")
    if(folder_of_${unit} AND NOT folder_of_${unit} STREQUAL folder AND NOT unit STREQUAL main)
      list(APPEND violations "${folder}/${unit}: ${folder_of_${unit}} has a unit of this name as well")
    endif()
    set(folder_of_${unit} ${folder})
  endforeach()
endforeach()
file(GLOB_RECURSE all_files "${SOURCE}/apps/job/*.h" "${SOURCE}/apps/job/*.hxx" "${SOURCE}/apps/job/*.cxx" "${SOURCE}/shell/*.h"
     "${SOURCE}/shell/*.cxx")
list(FILTER all_files EXCLUDE REGEX "/shell/test/")
list(REMOVE_ITEM all_files ${program_files} "")
foreach(file IN LISTS all_files)
  list(APPEND violations "${file} is in no folder of the table")
endforeach()
foreach(file IN LISTS program_files)
  string(REGEX REPLACE "^.*/((apps|shell)/.*)/[^/]*$" "\\1" folder "${file}")
  string(REGEX REPLACE "^(${system_folder})/.*" "\\1" folder "${folder}")
  set(uses_no_itk OFF)
  if(folder MATCHES "^shell/")
    set(uses_no_itk ON)
  endif()
  set(calls_no_system ON)
  if(folder STREQUAL system_folder)
    set(calls_no_system OFF)
  endif()
  check_includes("${file}" ${folder} "${library};Filters;${program}")
endforeach()

if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "Dependencies that point the wrong way:\n  ${text}")
endif()
