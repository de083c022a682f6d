// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectMap_h
#define itkMedialVoxelObjectMap_h

#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelLabelSurvey.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelObjectMap
 * \brief An image of many objects, processed in passes.
 *
 * Objects of a pass are so far apart that none changes the result of another.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelObjectMap
{
public:
  virtual ~MedialVoxelObjectMap();

  /** Read the objects of a box, x fastest. */
  virtual void
  ReadObjects(const MedialVoxelBox & box, MedialVoxelObjectNumber * objects) = 0;

  const MedialVoxelLabelTable &
  GetTable() const
  {
    return m_Table;
  }

  /** Voxels of each object, by its number. */
  const std::vector<std::uint64_t> &
  GetObjectVoxels() const
  {
    return m_ObjectVoxels;
  }

  /** 1 without any object. */
  unsigned int
  GetNumberOfPasses() const
  {
    return m_NumberOfPasses;
  }

  /** Pass of an object, from 0 on. */
  unsigned int
  GetPass(const MedialVoxelObjectNumber object) const
  {
    return m_Passes[object];
  }

  /** Show the objects of a pass from now on. */
  void
  ShowPass(unsigned int pass);

  unsigned int
  GetShownPass() const
  {
    return m_ShownPass;
  }

  /** Whether an object is in the current pass; background never is. */
  bool
  IsShown(const MedialVoxelObjectNumber object) const
  {
    return m_IsShown[object] != 0;
  }

protected:
  /** Know the objects that a survey found. */
  void
  Learn(const MedialVoxelLabelSurvey::Result & found);

private:
  MedialVoxelLabelTable                m_Table;
  std::vector<MedialVoxelObjectNumber> m_Passes;  ///< by object
  std::vector<std::uint8_t>            m_IsShown; ///< the same, which each voxel asks for
  std::vector<std::uint64_t>           m_ObjectVoxels;
  unsigned int                         m_NumberOfPasses{ 0 };
  unsigned int                         m_ShownPass{ 0 };
};

} // end namespace itk

#endif
