// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGrayNormals_h
#define itkMedialVoxelGrayNormals_h

#include "itkMedialVoxelGray.h"
#include "itkMedialVoxelVector3.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace itk
{

/** \class MedialVoxelGrayNormals
 * \brief Directions in which the gray values of an image change most. Lengths are in voxels.
 *
 * Places near each other share the gradients around them: gradients are computed once for a block of voxels, and kept
 * until another block needs the memory. They depend on the image alone, so the order of requests does not change
 * normals. Each thread has normals of its own. Beyond a face of the image the outermost voxels are continued.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGrayNormals
{
public:
  /** Voxels around a place whose values the normal depends on. */
  static constexpr std::int64_t Reach = 7;

  /** Bytes that the gradients take, at most. */
  static std::uint64_t
  GetBytes();

  /** The largest absolute value that is a number, or 1: a material where none is known. */
  static double
  FindLargestValue(const MedialVoxelGray & gray);

  /** \param background, material  values; they set the scale of the gradients */
  MedialVoxelGrayNormals(const MedialVoxelGrid & grid, double background, double material);

  /** The first eigenvector of the structure tensor, in a Gaussian window of 1.5 voxels, of values that are smoothed by
   * (1 2 1) / 4.
   *
   * \param gray    values of one image, always of the same; all around \a place
   * \param normal  of length 1
   * \return false where the values do not change, or are not finite */
  bool
  Find(const MedialVoxelGray & gray, const MedialVoxelVector3 & place, MedialVoxelVector3 & normal);

private:
  static constexpr std::int64_t Extent = 8; // of a block
  static constexpr std::int64_t Margin = 3; // of the values that a gradient depends on

  /** A component of the gradients of a block, x fastest. */
  using Component = std::array<float, static_cast<std::size_t>(Extent * Extent * Extent)>;

  struct Block
  {
    MedialVoxelBox           known; // the voxels whose gradients are right
    std::array<Component, 3> gradient;
  };

  struct Window;

  /** Of the voxels of a window along each axis. */
  using Weights = std::array<std::array<float, 9>, 3>;

  /** The window around a place; sets its weights. */
  MedialVoxelBox
  MoveWindow(const MedialVoxelVector3 & place);

  /** xx, xy, xz, yy, yz, zz of a tensor. */
  using Components = std::array<double, 6>;

  Components
  GetTensor(const MedialVoxelGray & gray, const Window & window);

  /** The block with an index, in blocks, that knows the gradients of a box as far as that is in the block. */
  const Block &
  GetBlock(const MedialVoxelGray & gray, const MedialVoxelIndex & index, const MedialVoxelBox & box);

  void
  Compute(const MedialVoxelGray & gray, const MedialVoxelIndex & origin, Block & block) const;

  MedialVoxelGrid                     m_Grid;
  double                              m_Background;
  double                              m_Scale;  // to the contrast 1
  std::vector<std::unique_ptr<Block>> m_Blocks; // those that were needed

  Weights               m_Weights{};
  std::array<double, 3> m_FirstDistances{ { 1.0, 1.0, 1.0 } }; // that no window has
};

} // end namespace itk

#endif
