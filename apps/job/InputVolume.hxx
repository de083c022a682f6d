// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelInputVolume_hxx
#define medialvoxelInputVolume_hxx

#include "InflateReader.h"
#include "InputVolume.h"

#include "itkByteSwapper.h"
#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkStreamingRawImageIO.h"

#include <chrono>
#include <type_traits>

namespace medialvoxel
{

/** \class StreamedInput
 * \brief Reads the parts of an uncompressed volume that its pipeline asks for. */
template <typename TImage>
class StreamedInput : public ImageInput<TImage>
{
public:
  explicit StreamedInput(const VolumeHeader & header)
  {
    using Clock = std::chrono::steady_clock;
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
    m_ImageIO->SetByteOrder(header.bigEndian ? itk::IOByteOrderEnum::BigEndian : itk::IOByteOrderEnum::LittleEndian);
    m_Reader->SetImageIO(m_ImageIO);
    m_Reader->SetFileName(header.dataFile.string());
    m_Reader->AddObserver(itk::StartEvent(), [this](const itk::EventObject &) { m_Start = Clock::now(); });
    m_Reader->AddObserver(itk::EndEvent(), [this](const itk::EventObject &) {
      this->m_ReadSeconds += std::chrono::duration<double>(Clock::now() - m_Start).count();
    });
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
  itk::StreamingRawImageIO::Pointer              m_ImageIO = itk::StreamingRawImageIO::New();
  typename itk::ImageFileReader<TImage>::Pointer m_Reader = itk::ImageFileReader<TImage>::New();
  std::chrono::steady_clock::time_point          m_Start;
};

/** \class UnpackedInput
 * \brief Holds a whole volume that was packed in its file. */
template <typename TImage>
class UnpackedInput : public ImageInput<TImage>
{
public:
  explicit UnpackedInput(const VolumeHeader & header)
  {
    const auto start = std::chrono::steady_clock::now();
    this->Allocate(header.geometry);
    InflateReader reader(header.dataFile, header.dataOffset);
    reader.Skip(header.skipAfterInflation);
    reader.Read(m_Image->GetBufferPointer(), header.GetVoxelBytes());
    reader.CheckEnd();
    this->SwapToMachineOrder(header.bigEndian);
    m_BytesRead = reader.GetNumberOfBytesRead();
    this->m_ReadSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  TImage *
  GetImage() override
  {
    return m_Image;
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_BytesRead;
  }

  itk::ProcessObject *
  GetReader() override
  {
    return nullptr;
  }

private:
  void
  Allocate(const VolumeGeometry & geometry)
  {
    typename TImage::SizeType      size;
    typename TImage::SpacingType   spacing;
    typename TImage::PointType     origin;
    typename TImage::DirectionType direction;
    for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
    {
      size[axis] = geometry.size[axis];
      spacing[axis] = geometry.spacing[axis];
      origin[axis] = geometry.origin[axis];
      for (unsigned int row = 0; row < TImage::ImageDimension; ++row)
      {
        direction[row][axis] = geometry.direction[axis][row];
      }
    }
    m_Image->SetRegions(size);
    m_Image->SetSpacing(spacing);
    m_Image->SetOrigin(origin);
    m_Image->SetDirection(direction);
    m_Image->Allocate();
  }

  void
  SwapToMachineOrder(bool fileIsBigEndian)
  {
    using SwapperType = itk::ByteSwapper<typename TImage::PixelType>;
    auto * const pixels = m_Image->GetBufferPointer();
    const auto   count = m_Image->GetBufferedRegion().GetNumberOfPixels();
    if (fileIsBigEndian)
    {
      SwapperType::SwapRangeFromSystemToBigEndian(pixels, count);
    }
    else
    {
      SwapperType::SwapRangeFromSystemToLittleEndian(pixels, count);
    }
  }

  typename TImage::Pointer m_Image = TImage::New();
  std::uint64_t            m_BytesRead{ 0 };
};

template <typename TPixel>
std::unique_ptr<InputVolume>
OpenInput(const VolumeHeader & header)
{
  const auto open = [&header](auto dimension) -> std::unique_ptr<InputVolume> {
    using ImageType = itk::Image<TPixel, decltype(dimension)::value>;
    if (header.CanStream())
    {
      return std::make_unique<StreamedInput<ImageType>>(header);
    }
    return std::make_unique<UnpackedInput<ImageType>>(header);
  };
  return header.geometry.GetDimension() == 2 ? open(std::integral_constant<unsigned int, 2>{})
                                             : open(std::integral_constant<unsigned int, 3>{});
}

} // end namespace medialvoxel

#endif
