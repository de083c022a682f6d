// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LabelMap.h"

#include "Errors.h"
#include "Text.h"

#include <vector>

namespace medialvoxel
{

LabelMap::LabelMap(const VolumeHeader &   header,
                   const LabelSelection & selection,
                   std::uint64_t          maximumPoreSize,
                   std::uint64_t          bytesToKeep)
  : InputVolume(header, bytesToKeep)
  , m_Header(header)
{
  m_Input = std::make_unique<itk::MedialVoxelLabelInput>(m_Source,
                                                         header.geometry.GetVoxelBox(),
                                                         selection.all ? std::vector<std::int64_t>{} : selection.values,
                                                         maximumPoreSize);
}

void
LabelMap::Prepare(const ReadObserver & observer)
{
  try
  {
    InputVolume::Prepare(observer);
  }
  catch (const itk::MedialVoxelLabelError & error)
  {
    Fail(ExitStatus::CorruptInput, m_Header.fileName.string(), ": ", error.what());
  }
  const std::string resampled =
    m_Header.stored ? ", when it is resampled to " + FormatSize(m_Header.geometry.size) + " voxels" : "";
  if (const auto & missing = this->GetLabels().GetMissingLabels(); !missing.empty())
  {
    Fail(ExitStatus::Usage, m_Header.fileName.string(), ": no voxel has the label ", missing.front(), resampled);
  }
  if (this->GetObjects().GetTable().GetNumberOfObjects() == 0)
  {
    Fail(ExitStatus::Usage, m_Header.fileName.string(), ": all voxels are 0", resampled, "; there is no object");
  }
}

} // end namespace medialvoxel
