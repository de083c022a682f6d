// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelEnums_h
#define itkMedialVoxelEnums_h

#include "MedialVoxelExport.h"

#include <cstdint>
#include <ostream>
#include <string>

namespace itk
{

/** \class MedialVoxelEnums
 * \brief Enumerations of the MedialVoxel module.
 * \ingroup MedialVoxel
 */
class MedialVoxelEnums
{
public:
  /** \class PseudoGeodesicBound
   * \ingroup MedialVoxel
   * Bound that accepts a dual cell as medial before any geodesic search.
   *
   * FreeSpace: length of the shortest path between the two nearest boundary points in the complete voxel grid.
   * Every path on the boundary is a path of that grid, so the bound never changes the set of medial cells.
   * Paper: pseudo-geodesic distance of Michikawa and Suzuki, Sec. 3.3, Eq. 2, with the smaller of the two norms.
   * Off: no bound, every cell that is not trivial is searched. */
  enum class PseudoGeodesicBound : std::uint8_t
  {
    FreeSpace = 0,
    Paper = 1,
    Off = 2
  };

  /** \class Boundary
   * \ingroup MedialVoxel
   * Voxels that distances are measured to.
   *
   * Object: object voxels with a background voxel among their 3^D-1 neighbors (SignedMaurerDistanceMapImageFilter).
   * Background: background voxels with an object voxel among their 3^D-1 neighbors (used by the classification). */
  enum class Boundary : std::uint8_t
  {
    Object = 0,
    Background = 1
  };

  /** \class Region
   * \ingroup MedialVoxel
   * Voxels that get a distance: inside the object, outside it, or both. */
  enum class Region : std::uint8_t
  {
    Inside = 0,
    Outside = 1,
    Both = 2
  };

  /** \class ThicknessMode
   * \ingroup MedialVoxel
   * Where the threshold on the geodesic distance comes from.
   *
   * Fixed: one thickness for the whole image (Michikawa and Suzuki, Eq. 1).
   * Automatic: at each cell from the largest inscribed ball that covers it. */
  enum class ThicknessMode : std::uint8_t
  {
    Fixed = 0,
    Automatic = 1
  };

  /** \class Smoothing
   * \ingroup MedialVoxel
   * Whether noise of the object is smoothed away.
   *
   * Off: never.
   * On: always.
   * Automatic: where the object is rough, see MedialVoxelRoughness. */
  enum class Smoothing : std::uint8_t
  {
    Off = 0,
    On = 1,
    Automatic = 2
  };

  /** \class LocalThicknessMethod
   * \ingroup MedialVoxel
   * How the local thickness of a voxel is defined.
   *
   * Sphere: the diameter of the largest ball inside the object that covers it (Hildebrand and Ruegsegger, 1997).
   * Wall: the thickness of the wall whose ball is the largest that covers it. */
  enum class LocalThicknessMethod : std::uint8_t
  {
    Sphere = 0,
    Wall = 1
  };
};

using MedialVoxelPseudoGeodesicBound = MedialVoxelEnums::PseudoGeodesicBound;
using MedialVoxelBoundary = MedialVoxelEnums::Boundary;
using MedialVoxelRegion = MedialVoxelEnums::Region;
using MedialVoxelThicknessMode = MedialVoxelEnums::ThicknessMode;
using MedialVoxelSmoothing = MedialVoxelEnums::Smoothing;
using MedialVoxelLocalThicknessMethod = MedialVoxelEnums::LocalThicknessMethod;

/** Print the name of an enumerator. */
extern MedialVoxel_EXPORT std::ostream &
                          operator<<(std::ostream & out, MedialVoxelEnums::PseudoGeodesicBound value);
extern MedialVoxel_EXPORT std::ostream &
                          operator<<(std::ostream & out, MedialVoxelEnums::Boundary value);
extern MedialVoxel_EXPORT std::ostream &
                          operator<<(std::ostream & out, MedialVoxelEnums::Region value);
extern MedialVoxel_EXPORT std::ostream &
                          operator<<(std::ostream & out, MedialVoxelEnums::ThicknessMode value);
extern MedialVoxel_EXPORT std::ostream &
                          operator<<(std::ostream & out, MedialVoxelEnums::Smoothing value);
extern MedialVoxel_EXPORT std::ostream &
                          operator<<(std::ostream & out, MedialVoxelEnums::LocalThicknessMethod value);

/** Error text for a value that is no enumerator; empty otherwise. */
extern MedialVoxel_EXPORT std::string
                          MedialVoxelFindEnumProblem(MedialVoxelEnums::PseudoGeodesicBound value);
extern MedialVoxel_EXPORT std::string
                          MedialVoxelFindEnumProblem(MedialVoxelEnums::Boundary value);
extern MedialVoxel_EXPORT std::string
                          MedialVoxelFindEnumProblem(MedialVoxelEnums::Region value);
extern MedialVoxel_EXPORT std::string
                          MedialVoxelFindEnumProblem(MedialVoxelEnums::ThicknessMode value);
extern MedialVoxel_EXPORT std::string
                          MedialVoxelFindEnumProblem(MedialVoxelEnums::Smoothing value);
extern MedialVoxel_EXPORT std::string
                          MedialVoxelFindEnumProblem(MedialVoxelEnums::LocalThicknessMethod value);

} // end namespace itk

/** Throws when \a value of the filter property \a name is no enumerator: callers in other languages can give any
 * number. */
#define itkMedialVoxelCheckEnumMacro(name, value)                                             \
  if (const std::string problem = ::itk::MedialVoxelFindEnumProblem(value); !problem.empty()) \
  {                                                                                           \
    itkExceptionMacro(#name " is " << problem);                                               \
  }                                                                                           \
  ITK_MACROEND_NOOP_STATEMENT

/** As itkSetEnumMacro, for enumerators alone. */
#define itkMedialVoxelSetEnumMacro(name, type) \
  virtual void Set##name(const type value)     \
  {                                            \
    itkMedialVoxelCheckEnumMacro(name, value); \
    if (m_##name != value)                     \
    {                                          \
      m_##name = value;                        \
      this->Modified();                        \
    }                                          \
  }                                            \
  ITK_MACROEND_NOOP_STATEMENT

#endif
