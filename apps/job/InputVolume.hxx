// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelInputVolume_hxx
#define medialvoxelInputVolume_hxx

#include "InputVolume.h"

#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkStreamingRawImageIO.h"

#include <algorithm>
#include <type_traits>

namespace medialvoxel
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
      Fail(ExitStatus::CorruptInput, error.GetDescription());
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

/** \class StreamedInput
 * \brief Reads the parts of an uncompressed volume that its pipeline asks for. */
template <typename TImage>
class StreamedInput : public ImageInput<TImage>
{
public:
  explicit StreamedInput(const VolumeHeader & header)
  {
    const unsigned int dimension = header.geometry.GetDimension();
    m_ImageIO->SetNumberOfDimensions(dimension);
    for (unsigned int axis = 0; axis < dimension; ++axis)
    {
      m_ImageIO->SetDimensions(axis, header.geometry.size[axis]);
      m_ImageIO->SetSpacing(axis, header.geometry.spacing[axis]);
      m_ImageIO->SetOrigin(axis, header.geometry.origin[axis]);
      m_ImageIO->SetDirection(axis, header.geometry.direction[axis]);
    }
    m_ImageIO->SetComponentType(itk::ImageIOBase::MapPixelType<typename TImage::PixelType>::CType);
    m_ImageIO->SetHeaderSize(static_cast<itk::ImageIOBase::SizeType>(header.dataOffset));
    m_ImageIO->SetRefuseTrailingBytes(false);
    m_ImageIO->SetSegments(header.segments);
    m_ImageIO->SetNeededFileSizes(GetNeededFileSizes(header));
    m_ImageIO->SetByteOrder(header.bigEndian ? itk::IOByteOrderEnum::BigEndian : itk::IOByteOrderEnum::LittleEndian);
    m_Reader->SetImageIO(m_ImageIO);
    m_Reader->SetFileName(header.dataFile.string());
    this->MeasureSeconds(*m_Reader);
  }

  TImage *
  GetImage() override
  {
    return m_Reader->GetOutput();
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_ImageIO->GetNumberOfBytesRead();
  }

  itk::ProcessObject *
  GetReader() override
  {
    return m_Reader;
  }

private:
  CheckedRawImageIO::Pointer                     m_ImageIO = CheckedRawImageIO::New();
  typename itk::ImageFileReader<TImage>::Pointer m_Reader = itk::ImageFileReader<TImage>::New();
};

template <typename TPixel>
std::unique_ptr<InputVolume>
OpenStreamedInput(const VolumeHeader & header)
{
  const auto open = [&header](auto dimension) -> std::unique_ptr<InputVolume> {
    using ImageType = itk::Image<TPixel, decltype(dimension)::value>;
    return std::make_unique<StreamedInput<ImageType>>(header);
  };
  return header.geometry.GetDimension() == 2 ? open(std::integral_constant<unsigned int, 2>{})
                                             : open(std::integral_constant<unsigned int, 3>{});
}

} // end namespace medialvoxel

#endif
