// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSmoothedInput_h
#define medialvoxelSmoothedInput_h

#include "StreamedInput.h"

namespace medialvoxel
{

/** \class SmoothedInput
 * \brief A volume whose object is smoothed, always or when it is rough. Values stay as they are. */
class SmoothedInput : public StreamedInput
{
public:
  /** \param smoothing on or automatic */
  SmoothedInput(const VolumeHeader & header,
                const JobOptions &   options,
                std::uint64_t        bytesToKeep,
                Smoothing            smoothing);

  /** Measures the roughness when that decides. */
  void
  Prepare(const ReadObserver & observer) override;

  std::optional<itk::MedialVoxelRoughness>
  GetRoughness() const override
  {
    return m_Roughness;
  }

  std::int64_t
  GetRowsReadTogether() const override;

  void
  Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets) override;

  /** Bytes that a thread takes beside those of a StreamedInput. */
  static std::uint64_t
  GetBytesPerThread(const VolumeHeader & header);

private:
  template <typename TValue, typename TRule>
  void
  FillSmoothed(ValueReader & reader, const TRule & rule, const itk::MedialVoxelBox & box, const VoxelTargets & targets);

  Smoothing                                m_Smoothing;
  std::optional<itk::MedialVoxelRoughness> m_Roughness;
};

} // end namespace medialvoxel

#endif
