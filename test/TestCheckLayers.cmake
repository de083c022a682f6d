# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Plants wrong includes in a made-up tree and sees that CheckLayers.cmake tells of them, and of nothing else:
# cmake -D FOLDER=<folder to write in> -P TestCheckLayers.cmake

# make_tree(): one where all is right
function(make_tree)
  file(REMOVE_RECURSE "${FOLDER}")
  file(WRITE "${FOLDER}/src/Foundation/itkMedialVoxelGrid.cxx" "#include \"itkMedialVoxelGrid.h\"\n")
  file(WRITE "${FOLDER}/src/Cells/itkMedialVoxelPairs.cxx" "#include \"itkMedialVoxelPairs.h\"\n#include <vector>\n")
  file(WRITE "${FOLDER}/src/IO/itkStreamingRawImageIO.cxx" "#include \"itkImageIOBase.h\"\n")
  file(WRITE "${FOLDER}/src/Cells/itkMedialVoxelPairs.h" "#include \"itkMedialVoxelGrid.h\"\n")
  file(WRITE "${FOLDER}/include/itkMedialVoxelGrid.h" "#include \"MedialVoxelExport.h\"\n")
  file(WRITE "${FOLDER}/include/itkMedialVoxelImageFilter.h" "#include \"itkImage.h\"\n#include \"itkMedialVoxelPairs.h\"\n")
  file(WRITE "${FOLDER}/shell/Isosurface/itkMedialVoxelMargins.h" "#include \"itkMedialVoxelPairs.h\"\n")
  file(WRITE "${FOLDER}/apps/job/system/Signals.cxx" "#include <csignal>\n#include <sys/stat.h>\n")
  file(WRITE "${FOLDER}/apps/job/base/Text.h" "#include <string>\n#include <nlohmann/json.hpp>\n")
  file(WRITE "${FOLDER}/apps/job/formats/text/MrcHeader.h" "#include \"Text.h\"\n")
  file(WRITE "${FOLDER}/apps/job/formats/text/MrcHeader.cxx" "#include \"MrcHeader.h\"\n")
  file(WRITE "${FOLDER}/apps/job/run/Plan.cxx" "#include \"Text.h\"\n#include \"itkMedialVoxelImageFilter.h\"\n")
  file(WRITE "${FOLDER}/apps/job/run/Plan.h" "")
  file(WRITE "${FOLDER}/apps/medialvoxel/CommandLine.h" "#include \"Plan.h\"\n")
endfunction()

# expect(<what the check says> <file that is added> <its text>): nothing, for a tree that is right
function(expect message file text)
  make_tree()
  if(file)
    file(WRITE "${FOLDER}/${file}" "${text}\n")
  endif()
  execute_process(COMMAND "${CMAKE_COMMAND}" -D "SOURCE=${FOLDER}" -P "${CMAKE_CURRENT_LIST_DIR}/CheckLayers.cmake"
                  RESULT_VARIABLE status ERROR_VARIABLE said)
  if(message STREQUAL "" AND NOT status EQUAL 0)
    message(FATAL_ERROR "A tree that is right was refused:\n${said}")
  endif()
  string(FIND "${said}" "${message}" position)
  if(NOT message STREQUAL "" AND (status EQUAL 0 OR position EQUAL -1))
    message(FATAL_ERROR "With '${text}' in ${file}, '${message}' was to be said, and this was:\n${said}")
  endif()
endfunction()

expect("" "" "")
expect("Object/itkMedialVoxelGray.cxx: itkMedialVoxelPairs.h is of Cells" src/Object/itkMedialVoxelGray.cxx
       "#include \"itkMedialVoxelPairs.h\"")
expect("Foundation/itkMedialVoxelGrid.h: itkMedialVoxelPairs.h is of Cells" include/itkMedialVoxelGrid.h
       "  #  include <itkMedialVoxelPairs.h>")
expect("Cells/itkMedialVoxelPairs.h: itkImage.h is not" src/Cells/itkMedialVoxelPairs.h "#include \"itkImage.h\"")
expect("Cells/itkMedialVoxelPairs.h: itkMedialVoxelImageFilter.h is of Filters" src/Cells/itkMedialVoxelPairs.h
       "#include \"itkMedialVoxelImageFilter.h\"")
expect("itkMedialVoxelLonely: belongs to no folder" include/itkMedialVoxelLonely.h "")
expect("itkMedialVoxelStray.cxx is in no folder" src/itkMedialVoxelStray.cxx "")
expect("apps/job/base/Text.h: Plan.h is of apps/job/run" apps/job/base/Text.h "#include \"Plan.h\"")
expect("apps/job/run/Plan.h: CommandLine.h is of apps/medialvoxel" apps/job/run/Plan.h "#include \"CommandLine.h\"")
expect("apps/MedialVoxelExtraction/main.cxx: CommandLine.h is of apps/medialvoxel" apps/MedialVoxelExtraction/main.cxx
       "#include \"CommandLine.h\"")
foreach(file IN ITEMS formats/zarr/ZarrHeader.cxx formats/catalog/VolumeFormats.cxx run/Plan.h)
  expect("apps/job/${file}: MrcHeader.h is of apps/job/formats/text" apps/job/${file} "#include \"MrcHeader.h\"")
endforeach()
expect("apps/job/run/Plan: apps/job/reports has a unit of this name as well" apps/job/reports/Plan.h "")
expect("New.cxx is in no folder" apps/job/new/New.cxx "")
expect("Cells/itkMedialVoxelPairs.h: itkMedialVoxelMargins.h is not" src/Cells/itkMedialVoxelPairs.h
       "#include \"itkMedialVoxelMargins.h\"")
expect("shell/Isosurface/itkMedialVoxelMargins.h: itkImage.h is not" shell/Isosurface/itkMedialVoxelMargins.h
       "#include \"itkImage.h\"")
foreach(header IN ITEMS unistd.h sys/stat.h fcntl.h windows.h csignal)
  expect("apps/job/base/Text.h: <${header}> is of the system" apps/job/base/Text.h "#include <${header}>")
  expect("apps/medialvoxel/main.cxx: <${header}> is of the system" apps/medialvoxel/main.cxx "#  include <${header}>")
endforeach()
