// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceSections.h"

#include "Errors.h"
#include "SurfaceParts.h"
#include "Text.h"

#include <cmath>
#include <limits>

namespace medialvoxel
{
namespace
{

/** Sums over faces or corners, in the order of the file, so that they have the same bits in every run. */
struct Sums
{
  std::uint64_t number{ 0 };
  double        area{ 0 };
  double        areaTimesThickness{ 0 };
  double        thickness{ 0 };

  void
  Add(double addedArea, double addedThickness)
  {
    ++number;
    area += addedArea;
    areaTimesThickness += addedArea * addedThickness;
    thickness += addedThickness;
  }

  /** Weighted by area, or, where there is none, the plain mean. */
  double
  GetMean() const
  {
    return area > 0 ? areaTimesThickness / area : thickness / static_cast<double>(number);
  }
};

/** Whether one of the two edges of the corner is a rim. */
bool
IsAtRim(const SurfaceFace & face, unsigned int corner)
{
  const unsigned int before = (corner + face.numberOfVertices - 1U) % face.numberOfVertices;
  return ((face.rimEdges >> corner | face.rimEdges >> before) & 1) != 0;
}

} // namespace

std::optional<double>
GetFaceThickness(SurfaceReader & reader, const SurfaceFace & face)
{
  Sums inside;
  Sums atRim;
  for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
  {
    const double thickness = static_cast<double>(reader.GetVertex(face.vertices[corner]).thickness);
    if (std::isfinite(thickness) && thickness > 0)
    {
      (IsAtRim(face, corner) ? atRim : inside).Add(0, thickness);
    }
  }
  const Sums & sums = inside.number > 0 ? inside : atRim;
  return sums.number > 0 ? std::optional<double>(sums.GetMean()) : std::nullopt;
}

SurfaceSections::SurfaceSections(SurfaceReader & reader, double classWidth)
  : m_ClassWidth(classWidth)
{
  if (!(classWidth > 0) || !std::isfinite(classWidth))
  {
    Fail(ExitStatus::Usage, "the width of thickness classes is ", FormatNumber(classWidth), ", it must be > 0");
  }
  std::map<Key, Sums>           classes;
  std::map<Key, std::uint64_t>  elements;
  std::map<std::uint32_t, Sums> knownOfObject;
  Sums                          known;
  reader.ForEachFace([&](std::uint64_t, const SurfaceFace & face) {
    const std::optional<double> thickness = GetFaceThickness(reader, face);
    const Key                   key{ reader.GetObject(face), this->GetClass(thickness) };
    classes[key].Add(face.area, thickness.value_or(0));
    for (const auto & corners : GetElements(reader, face))
    {
      ++elements[key];
      ++(corners.size() == 3 ? m_NumberOfTriangles : m_NumberOfQuads);
    }
    if (thickness)
    {
      known.Add(face.area, *thickness);
      knownOfObject[key.object].Add(face.area, *thickness);
    }
    if (classes.size() > MaximumNumberOfSections)
    {
      Fail(ExitStatus::Refused,
           "thickness classes of width ",
           FormatNumber(m_ClassWidth),
           " give more than ",
           MaximumNumberOfSections,
           " sections; take wider ones, or fewer labels of a label map");
    }
  });
  if (!classes.empty() && known.number == 0)
  {
    Fail(ExitStatus::Failure, "no vertex of the mesh has a thickness, which the sections of elements need");
  }
  const ClassType unknown = this->GetClass(std::nullopt);
  for (const auto & [key, sums] : classes)
  {
    m_SectionOfKey[key] = m_Sections.size();
    const auto   ofObject = knownOfObject.find(key.object);
    const Sums & others = ofObject == knownOfObject.end() ? known : ofObject->second;
    const double mean = key.thicknessClass == unknown ? others.GetMean() : sums.GetMean();
    m_Sections.push_back({ key.object, static_cast<float>(mean), elements[key] });
  }
}

SurfaceSections::ClassType
SurfaceSections::GetClass(const std::optional<double> & thickness) const
{
  constexpr ClassType unknown = std::numeric_limits<ClassType>::max();
  constexpr double    last = 9e15;
  return thickness ? static_cast<ClassType>(std::min(last, std::round(*thickness / m_ClassWidth))) : unknown;
}

size_t
SurfaceSections::GetSection(SurfaceReader & reader, const SurfaceFace & face) const
{
  return m_SectionOfKey.at({ reader.GetObject(face), this->GetClass(GetFaceThickness(reader, face)) });
}

void
CheckElementsFit(SurfaceFormat format, const SurfaceReader & reader, const SurfaceSections & sections)
{
  CheckSurfaceFits(
    format, reader.GetSurface().GetNumberOfVertices(), sections.GetNumberOfTriangles(), sections.GetNumberOfQuads());
}

} // end namespace medialvoxel
