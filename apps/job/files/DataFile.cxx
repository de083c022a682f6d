// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "DataFile.h"

#include "Text.h"

#include "itkMedialVoxelHeaderText.h"

#include <regex>

namespace medialvoxel
{

std::filesystem::path
MakeDataName(const std::filesystem::path & headerName, unsigned int number)
{
  std::filesystem::path name = headerName;
  name.replace_extension();
  if (number > 0)
  {
    name += "-" + std::to_string(number);
  }
  name += ".raw";
  return name;
}

bool
IsDataName(const std::filesystem::path & dataName, const std::filesystem::path & headerName)
{
  const std::string stem = headerName.stem().string();
  const std::string name = dataName.filename().string();
  if (dataName.parent_path() != headerName.parent_path() || name.compare(0, stem.size(), stem) != 0)
  {
    return false;
  }
  return std::regex_match(name.substr(stem.size()), std::regex("(-[0-9]+)?\\.raw"));
}

std::filesystem::path
FindDataFile(const std::filesystem::path & headerName)
{
  return FindDataFile(headerName, headerName);
}

std::filesystem::path
FindDataFile(const std::filesystem::path & headerName, const std::filesystem::path & nameForNow)
{
  const std::string extension = ToLower(headerName.extension().string());
  std::error_code   error;
  if ((extension != ".mhd" && extension != ".nhdr") || !std::filesystem::is_regular_file(nameForNow, error))
  {
    return {};
  }
  constexpr unsigned int maximumLines = 10000;
  constexpr size_t       maximumBytesPerLine = 1 << 16;
  const char             separator = extension == ".mhd" ? '=' : ':';
  try
  {
    itk::MedialVoxelText::HeaderLines lines(nameForNow, maximumBytesPerLine);
    std::string                       line;
    while (lines.GetLineNumber() < maximumLines && lines.Next(line))
    {
      const size_t      position = line.find(separator);
      const std::string name = ToLower(Trim(line.substr(0, position)));
      if (position != std::string::npos && (name == "elementdatafile" || name == "data file" || name == "datafile"))
      {
        return headerName.parent_path() / Trim(line.substr(position + 1));
      }
    }
  }
  catch (const itk::MedialVoxelText::HeaderError &)
  {
    // Not a header: nothing of it is to be removed.
  }
  return {};
}

} // end namespace medialvoxel
