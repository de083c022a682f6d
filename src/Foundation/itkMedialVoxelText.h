// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelText_h
#define itkMedialVoxelText_h

#include "MedialVoxelExport.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace itk
{
namespace MedialVoxelText
{

/** The whole text as a number, whatever the locale; nothing when any part of it is something else. */
MedialVoxel_EXPORT std::optional<double>
                   ParseDouble(std::string_view text);
MedialVoxel_EXPORT std::optional<std::int64_t>
                   ParseInteger(std::string_view text);

/** ParseDouble for libraries of C++ that read real numbers from streams alone. Refuses numbers nearer to zero than
 * normal ones. */
MedialVoxel_EXPORT std::optional<double>
                   ParseStreamedDouble(std::string_view text);

/** Shortest text that reads back as the same number. */
MedialVoxel_EXPORT std::string
                   FormatNumber(double value);

/** Without blanks and carriage returns at both ends. */
MedialVoxel_EXPORT std::string
                   Trim(std::string_view text);

/** The parts between runs of blanks. */
MedialVoxel_EXPORT std::vector<std::string>
                   SplitAtBlanks(std::string_view text);

MedialVoxel_EXPORT std::string
                   ToLower(std::string_view text);

/** The values joined by a separator, for example "256 x 256 x 110". */
template <typename TRange, typename TFormat>
std::string
Join(const TRange & values, const std::string & separator, TFormat format)
{
  std::string text;
  for (const auto & value : values)
  {
    text += (text.empty() ? "" : separator) + format(value);
  }
  return text;
}

/** The shortest texts of several numbers, put together with a separator. */
MedialVoxel_EXPORT std::string
                   FormatNumbers(const std::vector<double> & values, const std::string & separator);

} // end namespace MedialVoxelText
} // end namespace itk

#endif
