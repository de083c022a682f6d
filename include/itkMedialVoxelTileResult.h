// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTileResult_h
#define itkMedialVoxelTileResult_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelFeatures.h"
#include "itkMedialVoxelRows.h"
#include "itkMedialVoxelSquaredLengths.h"

#include "MedialVoxelExport.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

struct MedialVoxelCellRow;
struct MedialVoxelWall;

/** \class MedialVoxelDisplacementWriter
 * \brief Turns displacements in voxels into vectors of VDimension components.
 *
 * A vector is the matrix times the displacement. The matrix is direction times spacing for physical units, as in a
 * displacement field, and the unit matrix for voxels. A voxel without a site gets NaN in every component.
 * \ingroup MedialVoxel
 */
template <unsigned int VDimension, typename TValue>
class MedialVoxelDisplacementWriter
{
public:
  using MatrixType = std::array<std::array<double, VDimension>, VDimension>; ///< rows

  explicit MedialVoxelDisplacementWriter(const MatrixType & matrix)
    : m_Matrix(matrix)
  {}

  /** Write the vectors of \a box, one after the other in each row, which begins at \a first. \a strides count vectors.
   */
  void
  Write(const MedialVoxelFeatures & features,
        const MedialVoxelBox &      box,
        TValue * const              first,
        const MedialVoxelStrides &  strides) const
  {
    MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
      const std::size_t from = features.OffsetOf(row.lower[0], row.lower[1], row.lower[2]);
      TValue *          vector = first + offset * VDimension;
      for (std::int64_t i = 0; i < row.Extent(0); ++i, vector += VDimension)
      {
        this->WriteVector(features, from + static_cast<std::size_t>(i), vector);
      }
    });
  }

private:
  void
  WriteVector(const MedialVoxelFeatures & features, const std::size_t offset, TValue * const vector) const
  {
    if (!features.HasSite(offset))
    {
      std::fill_n(vector, VDimension, std::numeric_limits<TValue>::quiet_NaN());
      return;
    }
    const double displacement[3] = { static_cast<double>(features.dx[offset]),
                                     static_cast<double>(features.dy[offset]),
                                     static_cast<double>(features.dz[offset]) };
    for (unsigned int row = 0; row < VDimension; ++row)
    {
      double sum = 0.0;
      for (unsigned int column = 0; column < VDimension; ++column)
      {
        sum += m_Matrix[row][column] * displacement[column];
      }
      vector[row] = static_cast<TValue>(sum);
    }
  }

  MatrixType m_Matrix;
};

/** \struct MedialVoxelDistanceScale
 * \brief Scale of written distances to the nearest boundary voxels; see VectorDistanceMapImageFilter.
 * \ingroup MedialVoxel
 */
struct MedialVoxelDistanceScale
{
  MedialVoxelGrid::SpacingType spacing;
  bool                         squared{ false };
  bool                         insideIsPositive{ false };
};

/** \struct MedialVoxelTopologyCell
 * \brief A cell and the voxel with its index in 16 bits, for the stage that completes the topology.
 * \ingroup MedialVoxel
 */
struct MedialVoxelTopologyCell
{
  std::uint8_t  label;
  bool          isObject; ///< the voxel
  std::uint16_t level;    ///< see MedialVoxelCellLevels

  static constexpr unsigned int  LabelBits = 2;
  static constexpr std::uint16_t OfObject = 1u << LabelBits;

  std::uint16_t
  Pack() const
  {
    return static_cast<std::uint16_t>(label | (isObject ? unsigned{ OfObject } : 0u) | level << (LabelBits + 1));
  }

  static MedialVoxelTopologyCell
  Unpack(const std::uint16_t cell)
  {
    return { static_cast<std::uint8_t>(cell & ((1u << LabelBits) - 1)),
             (cell & OfObject) != 0,
             static_cast<std::uint16_t>(cell >> (LabelBits + 1)) };
  }
};

/** \class MedialVoxelTileResult
 * \brief The results of a tile, valid while the tile is being taken. Results that were not requested are null.
 *
 * The tile is written to buffers with \a strides, in which it begins at \a first. Every voxel of the tile is written.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelTileResult
{
public:
  MedialVoxelBox box;

  /** No cell has an object corner: all labels, vectors and thicknesses are zero, and nothing else is set. */
  bool isEmpty{ false };

  /** Labels of the cells, x fastest. */
  const std::uint8_t * labels{ nullptr };

  /** Levels of the cells, x fastest; see MedialVoxelCellLevels. */
  const std::vector<std::uint16_t> * levels{ nullptr };

  /** Displacements to the nearest boundary voxels, in a box that holds the tile. */
  const MedialVoxelFeatures * displacements{ nullptr };

  /** Lengths of the displacements, instead of them. */
  const MedialVoxelSquaredLengths * squaredLengths{ nullptr };

  /** Object bits in a box that holds the tile. */
  const MedialVoxelBits * object{ nullptr };

  /** Local thickness of the voxels, x fastest; 0 in background. */
  const std::vector<float> * localThickness{ nullptr };

  /** Geodesic distance of the pair of each cell, x fastest; 0 where it is trivial. */
  const std::vector<float> * importance{ nullptr };

  /** The thresholds that it is compared with, 0 where it is 0. */
  const std::vector<float> * importanceThresholds{ nullptr };

  /** The cells whose walls were measured, and the walls. */
  const std::vector<MedialVoxelCellRow> * rows{ nullptr };
  const std::vector<MedialVoxelWall> *    walls{ nullptr };

  template <typename TLabel>
  void
  WriteLabels(TLabel * const first, const MedialVoxelStrides & strides) const
  {
    const std::uint8_t * source = labels;
    MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
      TLabel * const target = first + offset;
      if (isEmpty)
      {
        std::fill_n(target, row.Extent(0), TLabel{});
        return;
      }
      std::transform(
        source, source + row.Extent(0), target, [](const std::uint8_t label) { return static_cast<TLabel>(label); });
      source += row.Extent(0);
    });
  }

  /** \a strides count vectors of VDimension values. */
  template <unsigned int VDimension, typename TValue>
  void
  WriteVectors(const MedialVoxelDisplacementWriter<VDimension, TValue> & writer,
               TValue * const                                            first,
               const MedialVoxelStrides &                                strides) const
  {
    if (!isEmpty)
    {
      writer.Write(*displacements, box, first, strides);
      return;
    }
    MedialVoxelForEachRow(box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
      std::fill_n(first + offset * VDimension, row.Extent(0) * VDimension, TValue{});
    });
  }

  /** The thickness of the measured walls, negative where sides are unpaired; 0 in other cells. */
  void
  WriteThickness(float * first, const MedialVoxelStrides & strides) const;

  /** The uncertainty of the thickness of the measured walls, NaN where it is not known; 0 in other cells. */
  void
  WriteUncertainty(float * first, const MedialVoxelStrides & strides) const;

  /** 0 in background, NaN at object voxels that no wall covers. */
  void
  WriteLocalThickness(float * first, const MedialVoxelStrides & strides) const;

  /** 0 at trivial cells and where no corner is object. */
  void
  WriteImportance(float * first, const MedialVoxelStrides & strides) const;

  /** 0 where the importance is 0. */
  void
  WriteImportanceThreshold(float * first, const MedialVoxelStrides & strides) const;

  /** What MedialVoxelSameTopology needs to know of each cell and the voxel with its index: see MedialVoxelTopologyCell.
   */
  void
  WriteTopologyCells(std::uint16_t * first, const MedialVoxelStrides & strides) const;

  /** Signed distances to the nearest boundary voxels, NaN without one. A tile of distances is never empty. */
  void
  WriteDistances(const MedialVoxelDistanceScale & scale, float * first, const MedialVoxelStrides & strides) const;

private:
  void
  WriteLengths(const MedialVoxelDistanceScale & scale, float * first, const MedialVoxelStrides & strides) const;

  void
  WriteValues(const std::vector<float> * values, float * first, const MedialVoxelStrides & strides) const;

  template <typename TGetValue>
  void
  WriteWalls(const TGetValue & getValue, float * first, const MedialVoxelStrides & strides) const;
};

} // end namespace itk

#endif
