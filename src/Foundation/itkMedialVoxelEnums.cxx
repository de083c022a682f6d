// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelEnums.h"

#include <cstddef>
#include <initializer_list>

namespace itk
{
namespace
{

/** An enumeration and its enumerators, from the value 0 on. */
struct Enumeration
{
  const char *                        name;
  std::initializer_list<const char *> enumerators;
};

constexpr Enumeration PseudoGeodesicBounds{ "PseudoGeodesicBound", { "FreeSpace", "Paper", "Off" } };
constexpr Enumeration Boundaries{ "Boundary", { "Object", "Background" } };
constexpr Enumeration Regions{ "Region", { "Inside", "Outside", "Both" } };
constexpr Enumeration ThicknessModes{ "ThicknessMode", { "Fixed", "Automatic" } };
constexpr Enumeration Smoothings{ "Smoothing", { "Off", "On", "Automatic" } };
constexpr Enumeration LocalThicknessMethods{ "LocalThicknessMethod", { "Sphere", "Wall" } };

template <typename TEnum>
std::ostream &
Print(std::ostream & out, const Enumeration & enumeration, const TEnum value)
{
  const auto        number = static_cast<std::size_t>(value);
  const std::string type = std::string("itk::MedialVoxelEnums::") + enumeration.name;
  return number < enumeration.enumerators.size() ? out << type << "::" << enumeration.enumerators.begin()[number]
                                                 : out << "INVALID VALUE FOR " << type;
}

/** For example "99; it must be 0 (Fixed) or 1 (Automatic)." */
template <typename TEnum>
std::string
FindProblem(const Enumeration & enumeration, const TEnum value)
{
  const std::size_t number = enumeration.enumerators.size();
  if (static_cast<std::size_t>(value) < number)
  {
    return {};
  }
  std::string text = std::to_string(static_cast<unsigned int>(value)) + "; it must be ";
  for (std::size_t i = 0; i < number; ++i)
  {
    text += i == 0 ? "" : (i + 1 < number ? ", " : " or ");
    text += std::to_string(i) + " (" + enumeration.enumerators.begin()[i] + ')';
  }
  return text + '.';
}

} // namespace

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::PseudoGeodesicBound value)
{
  return Print(out, PseudoGeodesicBounds, value);
}

std::string
MedialVoxelFindEnumProblem(const MedialVoxelEnums::PseudoGeodesicBound value)
{
  return FindProblem(PseudoGeodesicBounds, value);
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::Boundary value)
{
  return Print(out, Boundaries, value);
}

std::string
MedialVoxelFindEnumProblem(const MedialVoxelEnums::Boundary value)
{
  return FindProblem(Boundaries, value);
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::Region value)
{
  return Print(out, Regions, value);
}

std::string
MedialVoxelFindEnumProblem(const MedialVoxelEnums::Region value)
{
  return FindProblem(Regions, value);
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::ThicknessMode value)
{
  return Print(out, ThicknessModes, value);
}

std::string
MedialVoxelFindEnumProblem(const MedialVoxelEnums::ThicknessMode value)
{
  return FindProblem(ThicknessModes, value);
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::Smoothing value)
{
  return Print(out, Smoothings, value);
}

std::string
MedialVoxelFindEnumProblem(const MedialVoxelEnums::Smoothing value)
{
  return FindProblem(Smoothings, value);
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::LocalThicknessMethod value)
{
  return Print(out, LocalThicknessMethods, value);
}

std::string
MedialVoxelFindEnumProblem(const MedialVoxelEnums::LocalThicknessMethod value)
{
  return FindProblem(LocalThicknessMethods, value);
}

} // end namespace itk
