# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Writes files of the page into a source file: cmake -D OUTPUT=<file> -D "NAMES=a;b" -D "FILES=/x/a;/x/b" -P Embed.cmake
# Each is a row of PageFiles, in pieces, since compilers limit the length of a string.
set(piece_length 16000)
set(delimiter "MedialVoxel")

set(rows "")
foreach(name file IN ZIP_LISTS NAMES FILES)
  file(READ "${file}" text)
  string(FIND "${text}" ")${delimiter}\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${file} has the end of a string in it")
  endif()
  string(LENGTH "${text}" length)
  string(APPEND rows "  { \"${name}\",\n    {")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} ${piece_length} piece)
    string(APPEND rows " R\"${delimiter}(${piece})${delimiter}\",\n")
    math(EXPR at "${at} + ${piece_length}")
  endwhile()
  string(APPEND rows "    } },\n")
endforeach()
file(WRITE "${OUTPUT}"
     "// Written by the build from the files that it names.\n#include \"PageFiles.h\"\n\nnamespace medialvoxel\n{\n\n"
     "const std::vector<PageFile> PageFiles{\n${rows}};\n\n} // end namespace medialvoxel\n")
