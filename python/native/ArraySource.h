// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelArraySource_h
#define medialvoxelArraySource_h

#include "ArrayRun.h"

#include "itkMedialVoxelValueSource.h"

namespace medialvoxel
{

/** \class ArraySource
 * \brief The values of an array, where they lie. */
class ArraySource : public itk::MedialVoxelValueSource
{
public:
  /** \param call stays as long as this */
  explicit ArraySource(const ArrayCall & call)
    : m_Call(call)
  {}

  itk::MedialVoxelValueType
  GetValueType() const override;

  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override;

  void
  WithBox(const itk::MedialVoxelBox & box, const ViewFunction & function) override;

private:
  const ArrayCall & m_Call;
};

} // end namespace medialvoxel

#endif
