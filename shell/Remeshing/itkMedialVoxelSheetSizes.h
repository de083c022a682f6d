// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetSizes_h
#define itkMedialVoxelSheetSizes_h

#include "itkMedialVoxelElementSize.h"
#include "itkMedialVoxelSheetLines.h"

namespace itk
{

/** \class MedialVoxelSheetSizes
 * \brief The sizes that elements are to have at the points of a sheet; they fall by half of a length along it at most.
 * \ingroup MedialVoxel
 */
class MedialVoxelSheetSizes
{
public:
  using Index = MedialVoxelSheet::Index;

  /** The least size, and at least a share of the thickness where it is to be so. \a sheet stays as long as this. */
  MedialVoxelSheetSizes(const MedialVoxelSheet &       sheet,
                        const MedialVoxelSheetLines &  lines,
                        const MedialVoxelElementSize & size);

  /** At least a share of the thickness at some more points, as where the sheet bends. */
  void
  Raise(const std::vector<Index> & points);

  float
  Get(Index point) const
  {
    return m_Sizes[point];
  }

private:
  void
  Spread();

  const MedialVoxelSheet * m_Sheet;
  std::vector<float>       m_Sizes;
  float                    m_ShareOfThickness;
};

} // end namespace itk

#endif
