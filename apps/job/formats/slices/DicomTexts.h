// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelDicomTexts_h
#define medialvoxelDicomTexts_h

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// How DICOM writes numbers, for the program and its module.

namespace medialvoxel
{

/** Numbers of a text, which backslashes separate; nothing where one is none. */
inline std::vector<double>
ParseDicomNumbers(const std::string & text)
{
  std::vector<double> numbers;
  std::size_t         begin = 0;
  do
  {
    const std::size_t  end = std::min(text.find('\\', begin), text.size());
    std::istringstream part(text.substr(begin, end - begin));
    part.imbue(std::locale::classic());
    double number = 0.0;
    if (!(part >> number) || !(part >> std::ws).eof() || !std::isfinite(number))
    {
      return {};
    }
    numbers.push_back(number);
    begin = end + 1;
  } while (begin <= text.size());
  return numbers;
}

/** Half of the last digit behind the point, the least of all numbers of a text; 0 where none has a point. */
inline double
GetDicomRounding(const std::string & text)
{
  std::size_t most = 0;
  for (std::size_t point = text.find('.'); point != std::string::npos; point = text.find('.', point + 1))
  {
    most = std::max(most, std::min(text.find_first_not_of("0123456789", point + 1), text.size()) - point - 1);
  }
  return most == 0 || text.find_first_of("eE") != std::string::npos ? 0.0 : 0.5 * std::pow(10.0, -double(most));
}

/** Distances of rows and of columns; nothing for an empty text. \throw std::runtime_error for anything else */
inline std::vector<double>
ParseDicomSpacing(const std::string & text)
{
  const std::vector<double> numbers = ParseDicomNumbers(text);
  if (!text.empty() && (numbers.size() != 2 || !(numbers[0] > 0.0) || !(numbers[1] > 0.0)))
  {
    throw std::runtime_error("its PixelSpacing is '" + text +
                             "'; it must be two numbers greater than 0, as in 0.5\\0.5");
  }
  return numbers;
}

/** Scans of one series differ in the number of the acquisition, or in the place in time. */
inline std::string
JoinDicomAcquisition(const std::string & number, const std::string & time)
{
  return time.empty() ? number : number + " at time " + time;
}

} // end namespace medialvoxel

#endif
