// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetSections.h"

#include "Errors.h"
#include "Text.h"

#include <cmath>
#include <limits>

namespace medialvoxel
{
SheetSections::SheetSections(MeshReader & reader, const SheetEdges & edges, const MeshWriteOptions & options)
  : m_Edges(edges)
  , m_AreObjects(options.thicknessPlace == ThicknessPlace::Nodes)
  , m_ClassWidth(options.thicknessClassWidth)
{
  if (!(m_ClassWidth > 0) || !std::isfinite(m_ClassWidth))
  {
    Fail(ExitStatus::Usage, "the width of thickness classes is ", FormatNumber(m_ClassWidth), ", it must be > 0");
  }
  std::map<Key, ThicknessSums>           classes;
  std::map<Key, std::uint64_t>           elements;
  std::map<std::uint32_t, ThicknessSums> knownOfObject;
  ThicknessSums                          known;
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    const std::optional<double> thickness = GetFaceThickness(reader, m_Edges, face);
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
  m_Mean = known.number > 0 ? static_cast<float>(known.GetMean()) : 0.0F;
  for (const auto & [object, sums] : knownOfObject)
  {
    m_MeanOfObject[object] = static_cast<float>(sums.GetMean());
  }
  const ClassType unknown = this->GetClass(std::nullopt);
  for (const auto & [key, sums] : classes)
  {
    const bool isOfObject = m_AreObjects || key.thicknessClass == unknown;
    m_SectionOfKey[key] = m_Sections.size();
    m_Sections.push_back({ key.object,
                           isOfObject ? this->GetMeanThickness(key.object) : static_cast<float>(sums.GetMean()),
                           elements[key] });
  }
}

SheetSections::ClassType
SheetSections::GetClass(const std::optional<double> & thickness) const
{
  constexpr ClassType unknown = std::numeric_limits<ClassType>::max();
  constexpr double    last = 9e15;
  if (m_AreObjects)
  {
    return 0;
  }
  return thickness ? static_cast<ClassType>(std::min(last, std::round(*thickness / m_ClassWidth))) : unknown;
}

size_t
SheetSections::GetSection(MeshReader & reader, const MeshFace & face) const
{
  return m_SectionOfKey.at({ reader.GetObject(face), this->GetClass(GetFaceThickness(reader, m_Edges, face)) });
}

std::vector<std::uint64_t>
SheetSections::CountElements() const
{
  std::vector<std::uint64_t> sizes;
  for (const SheetSection & section : m_Sections)
  {
    sizes.push_back(section.numberOfElements);
  }
  return sizes;
}

std::vector<float>
SheetSections::GetCornerThicknesses(MeshReader & reader, const MeshFace & face, const MeshCorners & corners) const
{
  std::vector<float> thicknesses;
  for (const unsigned int corner : corners)
  {
    const std::optional<double> thickness = GetCornerThickness(reader, m_Edges, face, corner);
    thicknesses.push_back(thickness ? static_cast<float>(*thickness) : this->GetMeanThickness(reader.GetObject(face)));
  }
  return thicknesses;
}

void
CheckElementsFit(MeshFormat format, const MeshReader & reader, const SheetSections & sections)
{
  CheckMeshFits(
    format, reader.GetMesh().GetNumberOfVertices(), sections.GetNumberOfTriangles(), sections.GetNumberOfQuads());
}

} // end namespace medialvoxel
