// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ResampledInput.h"

#include "ImageGeometry.h"

#include "itkImage.h"
#include "itkImageToImageFilter.h"

#include <type_traits>

namespace medialvoxel
{
namespace
{

/** \class ResampleFilter
 * \brief An image at equal spacing, any region of which is made from the voxels of the file that have a share in it. */
template <typename TImage>
class ResampleFilter : public itk::ImageToImageFilter<TImage, itk::Image<double, TImage::ImageDimension>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ResampleFilter);

  using Self = ResampleFilter;
  using OutputImageType = itk::Image<double, TImage::ImageDimension>;
  using Superclass = itk::ImageToImageFilter<TImage, OutputImageType>;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(ResampleFilter);
#else
  itkTypeMacro(ResampleFilter, ImageToImageFilter);
#endif

  void
  SetResampling(const VolumeGeometry & geometry, std::shared_ptr<const Resampling> resampling)
  {
    m_Geometry = geometry;
    m_Resampling = std::move(resampling);
    this->Modified();
  }

protected:
  ResampleFilter() { this->DynamicMultiThreadingOn(); }
  ~ResampleFilter() override = default;

  void
  GenerateOutputInformation() override
  {
    SetImageGeometry(m_Geometry, *this->GetOutput());
  }

  void
  GenerateInputRequestedRegion() override
  {
    const auto                  requested = this->GetOutput()->GetRequestedRegion();
    typename TImage::RegionType region;
    for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
    {
      // Rows are whole, so that each has a first voxel.
      const std::uint64_t size = axis == 0 ? m_Geometry.size[0] : requested.GetSize(axis);
      const auto          first = axis == 0 ? 0 : static_cast<std::uint64_t>(requested.GetIndex(axis));
      const auto          stored = m_Resampling->GetStored(axis, first, first + size - 1);
      region.SetIndex(axis, static_cast<itk::IndexValueType>(stored[0]));
      region.SetSize(axis, stored[1] - stored[0] + 1);
    }
    const_cast<TImage *>(this->GetInput())->SetRequestedRegion(region);
  }

  /** Regions of images in memory and of their files may differ. */
  void
  VerifyInputInformation() ITKv5_CONST override
  {}

  void
  DynamicThreadedGenerateData(const typename OutputImageType::RegionType & region) override
  {
    const TImage &    input = *this->GetInput();
    OutputImageType & output = *this->GetOutput();
    const auto        rowOf = [&](std::uint64_t y, std::uint64_t z) {
      const auto index = MakeIndex<TImage>(0, y, z);
      return input.GetBufferPointer() + input.ComputeOffset(index);
    };
    const auto          begin = static_cast<std::uint64_t>(region.GetIndex(0));
    const std::uint64_t end = begin + region.GetSize(0);
    const std::uint64_t slices = TImage::ImageDimension == 3 ? region.GetSize(TImage::ImageDimension - 1) : 1;
    const std::uint64_t firstSlice = TImage::ImageDimension == 3 ? region.GetIndex(TImage::ImageDimension - 1) : 0;
    for (std::uint64_t z = firstSlice; z < firstSlice + slices; ++z)
    {
      const auto firstRow = static_cast<std::uint64_t>(region.GetIndex(1));
      for (std::uint64_t y = firstRow; y < firstRow + region.GetSize(1); ++y)
      {
        const auto index = MakeIndex<OutputImageType>(begin, y, z);
        m_Resampling->MakeRow(rowOf, y, z, begin, end, output.GetBufferPointer() + output.ComputeOffset(index));
      }
    }
  }

private:
  template <typename TAnyImage>
  static typename TAnyImage::IndexType
  MakeIndex(std::uint64_t x, std::uint64_t y, std::uint64_t z)
  {
    const std::uint64_t           values[] = { x, y, z };
    typename TAnyImage::IndexType index;
    for (unsigned int axis = 0; axis < TAnyImage::ImageDimension; ++axis)
    {
      index[axis] = static_cast<itk::IndexValueType>(values[axis]);
    }
    return index;
  }

  VolumeGeometry                    m_Geometry;
  std::shared_ptr<const Resampling> m_Resampling;
};

template <typename TImage>
class ResampledInput : public ImageInput<itk::Image<double, TImage::ImageDimension>>
{
public:
  ResampledInput(std::unique_ptr<InputVolume> stored, const VolumeHeader & header, Interpolation interpolation)
    : m_Stored(std::move(stored))
  {
    m_Filter->SetInput(static_cast<ImageInput<TImage> &>(*m_Stored).GetImage());
    m_Filter->SetResampling(header.geometry, std::make_shared<const Resampling>(header, interpolation));
    this->MeasureSeconds(*m_Stored->GetReader());
  }

  itk::Image<double, TImage::ImageDimension> *
  GetImage() override
  {
    return m_Filter->GetOutput();
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Stored->GetNumberOfBytesRead();
  }

  itk::ProcessObject *
  GetReader() override
  {
    return m_Stored->GetReader();
  }

private:
  std::unique_ptr<InputVolume>             m_Stored;
  typename ResampleFilter<TImage>::Pointer m_Filter = ResampleFilter<TImage>::New();
};

} // namespace

std::unique_ptr<InputVolume>
OpenResampledInput(const VolumeHeader & header, Interpolation interpolation)
{
  return DispatchPixelType(header.stored->pixelType, [&](auto zero) {
    const auto open = [&](auto dimension) -> std::unique_ptr<InputVolume> {
      using ImageType = itk::Image<decltype(zero), decltype(dimension)::value>;
      return std::make_unique<ResampledInput<ImageType>>(
        OpenStreamedInput<decltype(zero)>(*header.stored), header, interpolation);
    };
    return header.geometry.GetDimension() == 2 ? open(std::integral_constant<unsigned int, 2>{})
                                               : open(std::integral_constant<unsigned int, 3>{});
  });
}

} // end namespace medialvoxel
