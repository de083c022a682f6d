// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurfaceSections_h
#define medialvoxelSurfaceSections_h

#include "SurfaceFormat.h"
#include "SurfaceReader.h"

#include <map>
#include <optional>
#include <tuple>

namespace medialvoxel
{

/** Mean over the corners whose thickness is known, nothing when none is. Corners at a rim, whose nearest boundary
 * points are on the end of the wall, count only when there are no others. */
std::optional<double>
GetFaceThickness(SurfaceReader & reader, const SurfaceFace & face);

/** Elements that share a thickness. */
struct SurfaceSection
{
  std::uint32_t object;           ///< of all elements, as in SurfaceVertex
  float         thickness;        ///< mean of the elements, weighted by area
  std::uint64_t numberOfElements; ///< at least 1
};

/** \class SurfaceSections
 * \brief Puts the faces of a surface into sections by thickness.
 *
 * Faces of an object whose thickness has the same nearest multiple of the class width share a section. Those without a
 * known thickness have a section of their own with the mean of all others of the object, or of all objects where it has
 * none. */
class SurfaceSections
{
public:
  static constexpr size_t MaximumNumberOfSections = 10000;

  /** Walks over all faces once. Elements are those of GetElements(). \param classWidth as in SurfaceWriteOptions
   * \throw JobError Usage when the width is not > 0 and finite
   * \throw JobError Refused when it gives too many sections
   * \throw JobError Failure when there are faces, but no thickness is known */
  SurfaceSections(SurfaceReader & reader, double classWidth);

  /** By objects, in them by rising thickness, faces without a known one last. */
  const std::vector<SurfaceSection> &
  GetSections() const
  {
    return m_Sections;
  }

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
  GetSection(SurfaceReader & reader, const SurfaceFace & face) const;

private:
  using ClassType = std::int64_t;

  /** The multiple of the class width that is nearest to the face's thickness. */
  ClassType
  GetClass(const std::optional<double> & thickness) const;

  /** What the faces of a section share. */
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

  double                      m_ClassWidth;
  std::map<Key, size_t>       m_SectionOfKey;
  std::vector<SurfaceSection> m_Sections;
  std::uint64_t               m_NumberOfTriangles{ 0 };
  std::uint64_t               m_NumberOfQuads{ 0 };
};

/** As CheckSurfaceFits(), of the elements that the sections hold. */
void
CheckElementsFit(SurfaceFormat format, const SurfaceReader & reader, const SurfaceSections & sections);

} // end namespace medialvoxel

#endif
