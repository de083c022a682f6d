// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelInputVolume_hxx
#define medialvoxelInputVolume_hxx

#include "InputVolume.h"

#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkStreamingRawImageIO.h"

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
    : m_ImageIO(MakeVoxelReader(header))
  {
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
  itk::StreamingRawImageIO::Pointer              m_ImageIO;
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
