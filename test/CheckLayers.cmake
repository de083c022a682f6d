# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Checks the direction of dependency between folders: cmake -D SOURCE=<project folder> -P CheckLayers.cmake
# A file includes only files of its own folder and of folders that stand before it in these tables.

# Folders of src. No file in them includes a header of ITK, but for those named below.
set(library Foundation IO Object Distance Geodesic Walls Cells Engine Surface Isosurface Remeshing)

# What users of the module include: filters stand above all folders, and both filters and image IO use ITK.
set(filters "^(itkMedialVoxelImageFilter|itkMedialVoxelMemoryError|itkMedialSurface(Mesh|Progress)|itkVectorDistanceMap|itkLocalThickness)[A-Za-z]*$")
set(image_io "^itkStreaming[A-Za-z]*$")

# A header in include/ belongs to the folder of its .cxx. These have none, or another folder than their .cxx.
set(folder_of_itkMedialVoxelObjectPredicate Object)
set(folder_of_itkMedialVoxelObjectUnion Object)
set(folder_of_itkMedialVoxelRows Foundation)
set(folder_of_itkMedialVoxelRandomSample Walls)
set(folder_of_itkMedialVoxelScan Foundation)
set(folder_of_itkMedialVoxelSiteKey Distance)
set(folder_of_itkMedialVoxelSmoothing Object)
set(folder_of_itkMedialVoxelSquaredLengths Distance)
set(folder_of_itkMedialVoxelText Foundation)

# Folders of apps. The two programs at the end know nothing of each other.
set(program
    job/base
    job/model
    job/dicom
    job/files
    job/formats
    job/meshes
    job/options
    job/records
    job/reports
    job/run
    job/clusters
    commandline
    medialvoxel
    MedialVoxelExtraction)

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
    if(other STREQUAL "")
      if(header MATCHES "^(itk|vnl|vcl)" AND NOT header MATCHES "Export\\.h$" AND uses_no_itk)
        list(APPEND violations "${folder}/${name}: ${header} is not a header of these folders")
      endif()
    elseif(other_rank GREATER rank OR (other MATCHES "^M|^m" AND NOT other STREQUAL folder))
      list(APPEND violations "${folder}/${name}: ${header} is of ${other}, which stands above")
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
  if(unit MATCHES "${filters}|${image_io}")
    set(uses_no_itk OFF)
  endif()
  check_includes("${file}" ${folder_of_${unit}} "${library};Filters")
endforeach()

# The program is free to use ITK and the library.
set(uses_no_itk OFF)
set(program_files "")
foreach(folder IN LISTS program)
  file(GLOB files "${SOURCE}/apps/${folder}/*.h" "${SOURCE}/apps/${folder}/*.hxx" "${SOURCE}/apps/${folder}/*.cxx"
       "${SOURCE}/apps/${folder}/*.cxx.in")
  list(APPEND program_files ${files})
  foreach(file IN LISTS files)
    get_unit(unit "${file}")
    if(folder_of_${unit} AND NOT folder_of_${unit} STREQUAL folder AND NOT unit STREQUAL main)
      list(APPEND violations "${folder}/${unit}: ${folder_of_${unit}} has a unit of this name as well")
    endif()
    set(folder_of_${unit} ${folder})
  endforeach()
endforeach()
file(GLOB_RECURSE all_files "${SOURCE}/apps/job/*.h" "${SOURCE}/apps/job/*.hxx" "${SOURCE}/apps/job/*.cxx")
list(REMOVE_ITEM all_files ${program_files} "")
foreach(file IN LISTS all_files)
  list(APPEND violations "${file} is in no folder of the table")
endforeach()
foreach(file IN LISTS program_files)
  string(REGEX REPLACE "^.*/apps/(.*)/[^/]*$" "\\1" folder "${file}")
  check_includes("${file}" ${folder} "${library};Filters;${program}")
endforeach()

if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "Dependencies that point the wrong way:\n  ${text}")
endif()
