// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestSupport_h
#define MedialVoxelTestSupport_h

// Between volumes of the oracles and ITK images; a source that records what is
// asked of it; real data.

#include "MedialVoxelTestClassification.h"
#include "MedialVoxelTestPhantoms.h"

#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkImageSource.h"
#include "itkMetaImageIO.h"
#include "itkNrrdImageIO.h"
#include "itksys/SystemTools.hxx"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace MedialVoxelTest
{
/** The largest region of a volume in D dimensions; the axes beyond D must have
 * length 1. */
template <unsigned int D>
itk::ImageRegion<D>
RegionOf(const Volume & volume, itk::IndexValueType start = 0)
{
  itk::ImageRegion<D> region;
  for (unsigned int axis = 0; axis < D; ++axis)
  {
    region.SetIndex(axis, start);
    region.SetSize(axis, volume.size[axis]);
  }
  return region;
}

/** An image of a volume: `object` and `background` as pixel values, every axis
 * starting at `start`. */
template <typename TImage>
typename TImage::Pointer
MakeImage(const Volume &             volume,
          itk::IndexValueType        start = 0,
          typename TImage::PixelType object = 1,
          typename TImage::PixelType background = 0)
{
  auto                         image = TImage::New();
  typename TImage::SpacingType spacing;
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    spacing[axis] = volume.spacing[axis];
  }
  image->SetRegions(RegionOf<TImage::ImageDimension>(volume, start));
  image->SetSpacing(spacing);
  image->Allocate();
  itk::ImageRegionIteratorWithIndex<TImage> it(image, image->GetLargestPossibleRegion());
  for (std::size_t i = 0; i < volume.object.size(); ++i, ++it)
  {
    it.Set(volume.object[i] ? object : background);
  }
  return image;
}

/** The pixels of the buffered region, x fastest. */
template <typename TImage>
std::vector<typename TImage::PixelType>
PixelsOf(const TImage * image)
{
  std::vector<typename TImage::PixelType>        pixels;
  itk::ImageRegionConstIteratorWithIndex<TImage> it(image, image->GetBufferedRegion());
  for (; !it.IsAtEnd(); ++it)
  {
    pixels.push_back(it.Get());
  }
  return pixels;
}

/** The object of an image by a threshold, as the oracles see it. */
template <typename TImage>
Volume
VolumeOf(const TImage * image, double lowerThreshold)
{
  const auto region = image->GetBufferedRegion();
  Volume     volume;
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    volume.size[axis] = static_cast<int>(region.GetSize(axis));
    volume.spacing[axis] = image->GetSpacing()[axis];
  }
  for (const auto & pixel : PixelsOf(image))
  {
    volume.object.push_back(pixel >= lowerThreshold ? 1 : 0);
  }
  return volume;
}

/** How many entries of two sequences of equal length differ, with the first one
 * named. */
template <typename TValue>
::testing::AssertionResult
AreEqual(const std::vector<TValue> & actual, const std::vector<TValue> & expected)
{
  if (actual.size() != expected.size())
  {
    return ::testing::AssertionFailure() << actual.size() << " values instead of " << expected.size();
  }
  std::size_t differences = 0;
  std::size_t first = 0;
  for (std::size_t i = actual.size(); i-- > 0;)
  {
    if (actual[i] != expected[i])
    {
      ++differences;
      first = i;
    }
  }
  return differences == 0
           ? ::testing::AssertionSuccess()
           : (::testing::AssertionFailure() << differences << " of " << actual.size() << " differ, first at " << first
                                            << ": " << ::testing::PrintToString(actual[first]) << " instead of "
                                            << ::testing::PrintToString(expected[first]));
}


template <typename TFilter>
Counts
CountsOf(const TFilter * filter)
{
  const auto found = filter->GetCounts();
  Counts     counts;
  counts.objectVoxels = found.objectVoxels;
  counts.boundaryVoxels = found.boundaryVoxels;
  counts.candidateCells = found.candidateCells;
  counts.trivialCells = found.trivialCells;
  counts.boundCells = found.boundCells;
  counts.geodesicMedialCells = found.geodesicMedialCells;
  counts.geodesicNonMedialCells = found.geodesicNonMedialCells;
  return counts;
}

inline bool
operator==(const Counts & a, const Counts & b)
{
  return a.objectVoxels == b.objectVoxels && a.boundaryVoxels == b.boundaryVoxels &&
         a.candidateCells == b.candidateCells && a.trivialCells == b.trivialCells && a.boundCells == b.boundCells &&
         a.geodesicMedialCells == b.geodesicMedialCells && a.geodesicNonMedialCells == b.geodesicNonMedialCells;
}

inline std::ostream &
operator<<(std::ostream & os, const Counts & c)
{
  return os << "object " << c.objectVoxels << ", boundary " << c.boundaryVoxels << ", candidates " << c.candidateCells
            << ", trivial " << c.trivialCells << ", bound " << c.boundCells << ", geodesic medial "
            << c.geodesicMedialCells << ", geodesic non-medial " << c.geodesicNonMedialCells;
}

/** Hands out exactly the requested region of an image and remembers every
 * request and the thread that made it. */
template <typename TImage>
class RecordingSource : public itk::ImageSource<TImage>
{
public:
  using Self = RecordingSource;
  using Superclass = itk::ImageSource<TImage>;
  using Pointer = itk::SmartPointer<Self>;
  using ConstPointer = itk::SmartPointer<const Self>;
  using RegionType = typename TImage::RegionType;

  itkNewMacro(Self);
#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(RecordingSource);
#else
  itkTypeMacro(RecordingSource, ImageSource);
#endif

  void
  SetImage(const TImage * image)
  {
    m_Image = image;
    this->Modified();
  }
  const std::vector<RegionType> &
  GetRequests() const
  {
    return m_Requests;
  }
  void
  ClearRequests()
  {
    m_Requests.clear();
  }
  /** Whether all requests came from the thread that created this source. */
  bool
  WasAskedByOneThread() const
  {
    return m_AskedByOneThread;
  }
  /** The largest number of pixels of one request. */
  std::size_t
  GetLargestRequest() const
  {
    std::size_t largest = 0;
    for (const auto & region : m_Requests)
    {
      largest = std::max<std::size_t>(largest, region.GetNumberOfPixels());
    }
    return largest;
  }

protected:
  RecordingSource() = default;
  ~RecordingSource() override = default;

  void
  GenerateOutputInformation() override
  {
    this->GetOutput()->CopyInformation(m_Image);
  }

  void
  GenerateData() override
  {
    auto *           output = this->GetOutput();
    const RegionType request = output->GetRequestedRegion();
    m_Requests.push_back(request);
    m_AskedByOneThread = m_AskedByOneThread && std::this_thread::get_id() == m_Thread;
    this->AllocateOutputs();
    itk::ImageRegionConstIteratorWithIndex<TImage> from(m_Image, request);
    itk::ImageRegionIteratorWithIndex<TImage>      to(output, request);
    for (; !from.IsAtEnd(); ++from, ++to)
    {
      to.Set(from.Get());
    }
  }

private:
  typename TImage::ConstPointer m_Image;
  std::vector<RegionType>       m_Requests;
  std::thread::id               m_Thread{ std::this_thread::get_id() };
  bool                          m_AskedByOneThread{ true };
};

/** Where a real volume lies, or an empty string; MEDIALVOXEL_TEST_DATA in the
 * environment comes first. */
inline std::string
RealDataPath(const std::string & fileName)
{
  std::string folder;
  if (!itksys::SystemTools::GetEnv("MEDIALVOXEL_TEST_DATA", folder))
  {
#ifdef MEDIALVOXEL_TEST_DATA_DIR
    folder = MEDIALVOXEL_TEST_DATA_DIR;
#endif
  }
  const std::string path = folder + "/" + fileName;
  return itksys::SystemTools::FileExists(path, true) ? path : std::string();
}

/** Reads a .mha or .nrrd without help of registered factories. */
template <typename TImage>
typename TImage::Pointer
ReadImage(const std::string & path)
{
  auto reader = itk::ImageFileReader<TImage>::New();
  if (itksys::SystemTools::GetFilenameLastExtension(path) == ".nrrd")
  {
    reader->SetImageIO(itk::NrrdImageIO::New());
  }
  else
  {
    reader->SetImageIO(itk::MetaImageIO::New());
  }
  reader->SetFileName(path);
  reader->Update();
  return reader->GetOutput();
}

/** The part of a volume from `low`, of this size. */
inline Volume
Cropped(const Volume & volume, const Index3 & low, const Index3 & size)
{
  return MakeVolume(size, volume.spacing, [&](const Index3 & v) {
    return volume.IsObject({ { low[0] + v[0], low[1] + v[1], low[2] + v[2] } });
  });
}
} // namespace MedialVoxelTest

/** Ends a test with one clear line where a real volume is not at hand. */
#define MEDIALVOXEL_SKIP_WITHOUT(path, fileName)                           \
  if ((path).empty())                                                      \
  {                                                                        \
    GTEST_SKIP() << fileName                                               \
                 << " not found; set MEDIALVOXEL_TEST_DATA to the folder " \
                    "that holds it";                                       \
  }                                                                        \
  static_assert(true, "")

#endif // MedialVoxelTestSupport_h
