// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SuggestName.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace medialvoxel
{
namespace
{

/** Characters to insert, remove or replace, upper and lower case being the same. */
std::size_t
GetDistance(const std::string & a, const std::string & b)
{
  const auto isSame = [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{ 0 });
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (isSame(a[i], b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({ replaced, row[j] + 1, row[j + 1] + 1 });
    }
  }
  return row.back();
}

} // namespace

std::string
SuggestName(const std::string & text, const std::vector<std::string> & names)
{
  // A third of the characters may differ; more would suggest names that have nothing to do with the text.
  std::size_t least = text.size() / 3 + 1;
  std::string best;
  for (const std::string & name : names)
  {
    const std::size_t distance = GetDistance(text, name);
    if (distance < least)
    {
      least = distance;
      best = name;
    }
  }
  return best.empty() ? "" : "; did you mean " + best + "?";
}

} // end namespace medialvoxel
