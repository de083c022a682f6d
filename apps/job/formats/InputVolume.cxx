// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

#include "VolumeFormats.h"

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

itk::StreamingRawImageIO::Pointer
MakeVoxelReader(const VolumeHeader & header)
{
  const itk::StreamingRawImageIO::Pointer imageIO = header.format->input.makeReader(header);
  const unsigned int                      dimension = header.geometry.GetDimension();
  imageIO->SetNumberOfDimensions(dimension);
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    imageIO->SetDimensions(axis, header.geometry.size[axis]);
    imageIO->SetSpacing(axis, header.geometry.spacing[axis]);
    imageIO->SetOrigin(axis, header.geometry.origin[axis]);
    imageIO->SetDirection(axis, header.geometry.direction[axis]);
  }
  imageIO->SetComponentType(DispatchPixelType(
    header.pixelType, [](auto zero) { return itk::ImageIOBase::MapPixelType<decltype(zero)>::CType; }));
  imageIO->SetHeaderSize(static_cast<itk::ImageIOBase::SizeType>(header.dataOffset));
  imageIO->SetRefuseTrailingBytes(false);
  imageIO->SetSegments(header.segments);
  imageIO->SetByteOrder(header.bigEndian ? itk::IOByteOrderEnum::BigEndian : itk::IOByteOrderEnum::LittleEndian);
  return imageIO;
}

} // end namespace medialvoxel
