// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

namespace medialvoxel
{

void
InputVolume::MeasureSeconds(itk::ProcessObject & source)
{
  using Clock = std::chrono::steady_clock;
  source.AddObserver(itk::StartEvent(), [this](const itk::EventObject &) { m_Start = Clock::now(); });
  source.AddObserver(itk::EndEvent(), [this](const itk::EventObject &) {
    m_ReadSeconds += std::chrono::duration<double>(Clock::now() - m_Start).count();
  });
}

} // end namespace medialvoxel
