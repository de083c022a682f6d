// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// From file to file with ITK's own witness of what a pipeline does on both sides of the filter (invariant I8).

#include "itkMedialVoxelFilterAccess.h"

#include "MedialVoxelTestRuns.h"

#include <gtest/gtest.h>

#if __has_include("itkPipelineMonitorImageFilter.h")

#  include "itkImageFileReader.h"
#  include "itkImageFileWriter.h"
#  include "itkPipelineMonitorImageFilter.h"
#  include "itkStreamingNrrdImageIO.h"

#  include <algorithm>
#  include <cstdio>

namespace
{
using namespace MedialVoxelTest;

using ImageType = MaskImage<3>;
using Monitor = itk::PipelineMonitorImageFilter<ImageType>;
using Regions = Monitor::RegionVectorType;

/** The name of a file of the test that runs, which is removed at the end. */
class TemporaryFile
{
public:
  explicit TemporaryFile(const std::string & name)
    : m_Name(::testing::TempDir() + "medialvoxel-" + ::testing::UnitTest::GetInstance()->current_test_info()->name() +
             "-" + name)
  {}

  ~TemporaryFile() { std::remove(m_Name.c_str()); }

  const std::string &
  GetName() const
  {
    return m_Name;
  }

private:
  std::string m_Name;
};

void
WriteWhole(ImageType * image, const std::string & fileName)
{
  auto writer = itk::ImageFileWriter<ImageType>::New();
  writer->SetImageIO(itk::StreamingNrrdImageIO::New());
  writer->SetFileName(fileName);
  writer->SetInput(image);
  writer->Update();
}

ImageType::Pointer
ReadWhole(const std::string & fileName)
{
  auto reader = itk::ImageFileReader<ImageType>::New();
  reader->SetImageIO(itk::StreamingNrrdImageIO::New());
  reader->SetFileName(fileName);
  reader->Update();
  return reader->GetOutput();
}

/** Slices that the regions have in all; they must be of whole slices. */
std::size_t
CountSlices(const Regions & regions, const Volume & volume)
{
  std::size_t slices = 0;
  for (const auto & region : regions)
  {
    EXPECT_EQ(region.GetSize(0), static_cast<itk::SizeValueType>(volume.size[0]));
    EXPECT_EQ(region.GetSize(1), static_cast<itk::SizeValueType>(volume.size[1]));
    slices += region.GetSize(2);
  }
  return slices;
}

/** reader -> monitor -> filter -> monitor -> writer, all of them streaming. */
struct Pipeline
{
  Pipeline(const std::string & source, const std::string & target, unsigned int divisions)
  {
    reader->SetImageIO(itk::StreamingNrrdImageIO::New());
    reader->SetFileName(source);
    before->SetInput(reader->GetOutput());
    filter->SetInput(before->GetOutput());
    filter->SetThickness(3.0);
    after->SetInput(filter->GetOutput());
    writer->SetImageIO(itk::StreamingNrrdImageIO::New());
    writer->SetFileName(target);
    writer->SetNumberOfStreamDivisions(divisions);
    writer->SetInput(after->GetOutput());
  }

  itk::ImageFileReader<ImageType>::Pointer reader = itk::ImageFileReader<ImageType>::New();
  Monitor::Pointer                         before = Monitor::New();
  MedialFilter<3>::Pointer                 filter = MedialFilter<3>::New();
  Monitor::Pointer                         after = Monitor::New();
  itk::ImageFileWriter<ImageType>::Pointer writer = itk::ImageFileWriter<ImageType>::New();
};

/** A plate of three voxels along z, 200 slices. */
Volume
ThinVolume()
{
  return AxisPlate({ { 66, 30, 200 } }, UnitSpacing, 1, 11, 3);
}
} // namespace

TEST(MedialVoxelPipeline, FromFileToFileInPieces)
{
  const Volume        volume = ThinVolume();
  const auto          expected = RunMedialFilter<3>(volume, 3.0);
  const TemporaryFile source("in.nrrd");
  WriteWhole(MakeImage<ImageType>(volume), source.GetName());
  for (const unsigned int divisions : { 1u, 4u, 9u, 200u })
  {
    SCOPED_TRACE(divisions);
    const TemporaryFile target("out" + std::to_string(divisions) + ".nrrd");
    Pipeline            pipeline(source.GetName(), target.GetName(), divisions);
    pipeline.writer->Update();

    EXPECT_TRUE(AreEqual(PixelsOf(ReadWhole(target.GetName()).GetPointer()), expected.labels));
    EXPECT_EQ(CountsOf(pipeline.filter.GetPointer()), expected.counts);

    // The writer asked for each piece once, and the filter made that piece and nothing else.
    EXPECT_TRUE(pipeline.after->VerifyAllInputCanStream(static_cast<int>(divisions)));
    EXPECT_EQ(CountSlices(pipeline.after->GetUpdatedBufferedRegions(), volume), 200u);

    // The reader read what it was asked for and nothing else, each slice once.
    EXPECT_TRUE(pipeline.before->VerifyInputFilterBufferedRequestedRegions());
    EXPECT_TRUE(pipeline.before->VerifyInputFilterMatchedUpdateOutputInformation());
    EXPECT_EQ(CountSlices(pipeline.before->GetUpdatedBufferedRegions(), volume), 200u);
  }
}

TEST(MedialVoxelPipeline, EveryRequestUpstreamIsServed)
{
  const Volume        volume = ThinVolume();
  const TemporaryFile source("in.nrrd");
  const TemporaryFile target("out.nrrd");
  WriteWhole(MakeImage<ImageType>(volume), source.GetName());
  Pipeline pipeline(source.GetName(), target.GetName(), 10);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*pipeline.filter, 5);
  pipeline.writer->Update();

  // A request that is repeated, as for the first window of a piece, or that is served already, updates nothing.
  Regions requested = pipeline.before->GetInputRequestedRegions();
  requested.erase(std::unique(requested.begin(), requested.end()), requested.end());
  EXPECT_EQ(requested, pipeline.before->GetUpdatedBufferedRegions());
  EXPECT_GE(pipeline.before->GetNumberOfUpdates(), 10u);
  EXPECT_EQ(pipeline.after->GetNumberOfUpdates(), 10u);
}

TEST(MedialVoxelPipeline, ASecondUpdateReadsAndComputesNothing)
{
  const Volume        volume = ThinVolume();
  const TemporaryFile source("in.nrrd");
  WriteWhole(MakeImage<ImageType>(volume), source.GetName());
  Pipeline pipeline(source.GetName(), "", 1);
  int      executions = 0;
  pipeline.filter->AddObserver(itk::StartEvent(), [&executions](const itk::EventObject &) { ++executions; });
  pipeline.filter->Update();
  const auto counts = CountsOf(pipeline.filter.GetPointer());
  EXPECT_EQ(pipeline.before->GetNumberOfUpdates(), 1u);
  pipeline.filter->Update();
  EXPECT_EQ(executions, 1);
  EXPECT_EQ(pipeline.before->GetNumberOfUpdates(), 0u); // counted anew with each update
  EXPECT_EQ(CountsOf(pipeline.filter.GetPointer()), counts);
}

#else

TEST(MedialVoxelPipeline, FromFileToFileInPieces)
{
  GTEST_SKIP() << "this ITK has no itkPipelineMonitorImageFilter.h: it was built without its test kernel";
}

#endif
