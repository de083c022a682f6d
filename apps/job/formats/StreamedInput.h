// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelStreamedInput_h
#define medialvoxelStreamedInput_h

#include "InputVolume.h"
#include "ObjectValues.h"
#include "ReaderPool.h"

namespace medialvoxel
{

/** Between labels there are no values: not without a threshold, and not with one value for both. A label has no
 * thresholds. */
Interpolation
GetInterpolation(const JobOptions & options);

/** \class StreamedInput
 * \brief Reads the boxes that it is asked for, each thread with a reader of its own. */
class StreamedInput : public InputVolume
{
public:
  /** \param bytesToKeep as of MakeValueReader() */
  StreamedInput(const VolumeHeader & header, const JobOptions & options, std::uint64_t bytesToKeep);

  /** Resampling has threads of its own. */
  itk::MedialVoxelSourceThreads
  GetSourceThreads() const override;

  std::int64_t
  GetRowsReadTogether() const override
  {
    return m_Readers.GetRowsReadTogether();
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Readers.GetNumberOfBytesRead();
  }

  void
  Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets) override;

protected:
  const VolumeHeader &
  GetHeader() const
  {
    return m_Header;
  }

  const JobOptions &
  GetOptions() const
  {
    return m_Options;
  }

  ReaderPool &
  GetReaders()
  {
    return m_Readers;
  }

  /** Packs values, which begin at the part, to what is wanted of it. */
  template <typename TValue>
  void
  Pack(const ValueView & view, const itk::MedialVoxelBox & part, const VoxelTargets & targets) const;

private:
  VolumeHeader m_Header;
  JobOptions   m_Options;
  ReaderPool   m_Readers;
};

template <typename TValue>
void
StreamedInput::Pack(const ValueView & view, const itk::MedialVoxelBox & part, const VoxelTargets & targets) const
{
  const auto * const values = static_cast<const TValue *>(view.values);
  const auto         pack = [&](const auto & predicate, itk::MedialVoxelBits * bits) {
    // Bits that stay clear need no look at each voxel.
    if (bits != nullptr && !(view.areEqual && !predicate(*values)))
    {
      itk::MedialVoxelPackBox(values, view.strides, part, predicate, *bits);
    }
  };
  pack(MakeObjectPredicate<TValue>(m_Options), targets.object);
  pack([](TValue value) { return value != value; }, targets.notANumber);
  if (targets.gray != nullptr)
  {
    itk::MedialVoxelCopyBox(values, view.strides, part, *targets.gray);
  }
}

} // end namespace medialvoxel

#endif
