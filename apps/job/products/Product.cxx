// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Product.h"

#include "PackedNumbers.h"

#include <string_view>

namespace medialvoxel
{
namespace
{

/** Digits of the length of what a product saved, which stand before it. */
constexpr std::size_t LengthDigits = 8;

std::string
PackPart(const std::string & part)
{
  std::string packed(LengthDigits, '\0');
  for (std::size_t i = 0; i < LengthDigits; ++i)
  {
    packed[i] = static_cast<char>(std::uint64_t{ part.size() } >> (8 * i));
  }
  return packed + part;
}

/** Takes the first part away from \a bytes. */
std::string
TakePart(std::string_view & bytes)
{
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < LengthDigits && i < bytes.size(); ++i)
  {
    length |= std::uint64_t{ static_cast<std::uint8_t>(bytes[i]) } << (8 * i);
  }
  if (bytes.size() < LengthDigits || length > bytes.size() - LengthDigits)
  {
    RefusePart();
  }
  const std::string part(bytes.substr(LengthDigits, length));
  bytes.remove_prefix(LengthDigits + length);
  return part;
}

} // namespace

std::string
SaveFindings(const ProductList & products)
{
  std::string bytes;
  for (const auto & product : products)
  {
    bytes += product->GetLinks().survey ? PackPart(product->GetLinks().survey->Save()) : "";
  }
  return bytes;
}

void
MergeFindings(const ProductList & products, const std::string & bytes)
{
  std::string_view rest = bytes;
  for (const auto & product : products)
  {
    if (TileSurvey * const survey = product->GetLinks().survey)
    {
      survey->Merge(TakePart(rest));
    }
  }
  if (!rest.empty())
  {
    RefusePart();
  }
}

} // end namespace medialvoxel
