// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Product.h"

#include "PackedNumbers.h"

#include <sstream>

namespace medialvoxel
{

std::string
SaveSurveys(const ProductList & products)
{
  std::string bytes;
  for (const auto & product : products)
  {
    if (const TileSurvey * const survey = product->GetLinks().survey)
    {
      const std::string part = survey->Save();
      bytes += std::to_string(part.size()) + " " + part;
    }
  }
  return bytes;
}

void
MergeSurveys(const ProductList & products, const std::string & bytes)
{
  std::istringstream stream(bytes);
  for (const auto & product : products)
  {
    if (TileSurvey * const survey = product->GetLinks().survey)
    {
      std::size_t length = 0;
      stream >> length;
      stream.get();
      std::string part(stream && length < bytes.size() ? length : 0, '\0');
      if (part.empty() || !stream.read(part.data(), static_cast<std::streamsize>(length)))
      {
        RefuseSaved();
      }
      survey->Merge(part);
    }
  }
  if (stream.peek() != std::istringstream::traits_type::eof())
  {
    RefuseSaved();
  }
}

} // end namespace medialvoxel
