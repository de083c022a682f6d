// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelArrayVolume_h
#define medialvoxelArrayVolume_h

#include "ArrayRun.h"
#include "InputVolume.h"
#include "ValueReader.h"

namespace medialvoxel
{

/** \class ArrayVolume
 * \brief An array as the volumes that the program opens. */
class ArrayVolume : public InputVolume
{
public:
  /** \param call       stays as long as this
   * \param isSmoothed the object */
  ArrayVolume(const ArrayCall & call, const JobOptions & options, bool isSmoothed);

  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override;

  std::uint64_t
  GetNumberOfBytesRead() const override;

  void
  Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets) override;

private:
  template <typename TValue>
  ValueView
  GetView(const itk::MedialVoxelBox & box) const;

  template <typename TValue>
  void
  FillSmoothed(const itk::MedialVoxelBox & box, itk::MedialVoxelBits & object) const;

  const ArrayCall & m_Call;
  JobOptions        m_Options;
  bool              m_IsSmoothed;
};

} // end namespace medialvoxel

#endif
