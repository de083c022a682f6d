// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetSections_h
#define medialvoxelSheetSections_h

#include "MeshFormat.h"
#include "MeshElements.h"
#include "MeshReader.h"
#include "SheetThickness.h"

#include <map>
#include <optional>
#include <tuple>

namespace medialvoxel
{

/** Elements that share a thickness. */
struct SheetSection
{
  std::uint32_t object;           ///< of all elements, as in MeshVertex
  float         thickness;        ///< mean of the elements, weighted by area
  std::uint64_t numberOfElements; ///< at least 1
};

/** \class SheetSections
 * \brief Puts the faces of a sheet into sections by thickness.
 *
 * Faces of an object whose thickness has the same nearest multiple of the class width share a section. Faces without
 * a known thickness have a section of their own. Its thickness is the mean of the object, or of all objects where
 * the object has none. Where nodes have the thickness, each object is a section, with its mean. */
class SheetSections
{
public:
  static constexpr size_t MaximumNumberOfSections = 10000;

  /** Walks over all faces once. Elements come from GetElements(). \param edges are kept
   * \throw JobError Usage when the width of thickness classes is not > 0 and finite
   * \throw JobError Refused when it gives too many sections
   * \throw JobError Failure when there are faces, but no thickness is known */
  SheetSections(MeshReader & reader, const SheetEdges & edges, const MeshWriteOptions & options);

  /** By objects, in them by rising thickness, faces without a known one last. */
  const std::vector<SheetSection> &
  GetSections() const
  {
    return m_Sections;
  }

  /** Of all sections. */
  std::vector<std::uint64_t>
  CountElements() const;

  /** Triangles and quads of all sections. */
  std::uint64_t
  GetNumberOfTriangles() const
  {
    return m_NumberOfTriangles;
  }
  std::uint64_t
  GetNumberOfQuads() const
  {
    return m_NumberOfQuads;
  }

  /** Place of a face's section in the list. */
  size_t
  GetSection(MeshReader & reader, const MeshFace & face) const;

  /** The mean of the known ones of an object, or of all objects where it has none. */
  float
  GetMeanThickness(std::uint32_t object) const
  {
    const auto found = m_MeanOfObject.find(object);
    return found == m_MeanOfObject.end() ? m_Mean : found->second;
  }

  /** Thickness of the wall at corners of a face, that mean where it is unknown. */
  std::vector<float>
  GetCornerThicknesses(MeshReader & reader, const MeshFace & face, const MeshCorners & corners) const;

private:
  using ClassType = std::int64_t;

  /** The multiple of the class width that is nearest to the face's thickness. */
  ClassType
  GetClass(const std::optional<double> & thickness) const;

  /** The key that the faces of a section share. */
  struct Key
  {
    std::uint32_t object;
    ClassType     thicknessClass;

    bool
    operator<(const Key & other) const
    {
      return std::tie(object, thicknessClass) < std::tie(other.object, other.thicknessClass);
    }
  };

  const SheetEdges &             m_Edges;
  bool                           m_AreObjects;
  double                         m_ClassWidth;
  std::map<Key, size_t>          m_SectionOfKey;
  std::vector<SheetSection>      m_Sections;
  std::map<std::uint32_t, float> m_MeanOfObject;
  float                          m_Mean{ 0 };
  std::uint64_t                  m_NumberOfTriangles{ 0 };
  std::uint64_t                  m_NumberOfQuads{ 0 };
};

/** As CheckMeshFits(), of the elements that the sections hold. */
void
CheckElementsFit(MeshFormat format, const MeshReader & reader, const SheetSections & sections);

} // end namespace medialvoxel

#endif
