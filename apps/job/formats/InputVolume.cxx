// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

#include "HeaderParsing.h"
#include "Text.h"
#include "ZarrImageIO.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class CheckedRawImageIO
 * \brief Tells voxels that a file lost after its header was read, corrupt input, from other failures of reading. */
class CheckedRawImageIO : public itk::StreamingRawImageIO
{
public:
  using Self = CheckedRawImageIO;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

  void
  SetNeededFileSizes(const std::map<std::filesystem::path, std::uint64_t> & sizes)
  {
    m_NeededFileSizes = sizes;
  }

  void
  ReadImageInformation() override
  {
    this->Check([this] { StreamingRawImageIO::ReadImageInformation(); });
  }

  void
  Read(void * buffer) override
  {
    this->Check([this, buffer] { StreamingRawImageIO::Read(buffer); });
  }

private:
  template <typename TFunction>
  void
  Check(TFunction && read) const
  try
  {
    read();
  }
  catch (const itk::ExceptionObject & error)
  {
    if (this->IsCut())
    {
      Fail(ExitStatus::CorruptInput, RemoveOrigin(error.GetDescription()));
    }
    throw;
  }

  bool
  IsCut() const
  {
    return std::any_of(m_NeededFileSizes.begin(), m_NeededFileSizes.end(), [](const auto & needed) {
      std::error_code unknown;
      const auto      size = std::filesystem::file_size(needed.first, unknown);
      return !unknown && size < needed.second;
    });
  }

  std::map<std::filesystem::path, std::uint64_t> m_NeededFileSizes;
};

} // namespace

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
  itk::StreamingRawImageIO::Pointer imageIO;
  if (header.format == ZarrFormat)
  {
    imageIO = MakeZarrImageIO(header);
  }
  else
  {
    const auto checked = CheckedRawImageIO::New();
    checked->SetNeededFileSizes(GetNeededFileSizes(header));
    imageIO = checked;
  }
  const unsigned int dimension = header.geometry.GetDimension();
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
