// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MedialVoxelTestNrrd.h"

#include "itkImageFileWriter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkMetaDataObject.h"
#include "itkNrrdImageIOFactory.h"
#include "itkRGBPixel.h"
#include "itkStreamingNrrdImageIOFactory.h"

#include <vector>

using namespace MedialVoxelTest;

namespace
{

class StreamingNrrdImageIOWrite : public NrrdFiles
{};

template <typename TImage>
typename TImage::Pointer
MakeImage()
{
  const auto                  image = TImage::New();
  typename TImage::RegionType region;
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    region.SetSize(axis, 9 - axis);
    region.SetIndex(axis, 3 * static_cast<itk::IndexValueType>(axis));
  }
  image->SetRegions(region);
  image->Allocate();
  typename TImage::SpacingType spacing(0.1);
  spacing[1] = 0.7;
  image->SetSpacing(spacing);
  typename TImage::DirectionType direction;
  direction.SetIdentity();
  direction[0][0] = direction[1][1] = 0.6;
  direction[0][1] = -0.8;
  direction[1][0] = 0.8;
  image->SetDirection(direction);
  const std::string bytes = SomeBytes(region.GetNumberOfPixels() * sizeof(typename TImage::PixelType));
  auto * const      pixels = reinterpret_cast<char *>(image->GetBufferPointer());
  std::transform(bytes.begin(), bytes.end(), pixels, [](char byte) { return static_cast<char>(byte & 0x3f); });
  return image;
}

template <typename TImage>
void
WriteWith(itk::ImageIOBase * io, TImage * image, const std::string & fileName, unsigned int divisions)
{
  const auto writer = itk::ImageFileWriter<TImage>::New();
  writer->SetImageIO(io);
  writer->SetInput(image);
  writer->SetFileName(fileName);
  writer->SetNumberOfStreamDivisions(divisions);
  writer->Update();
}

/** A file written in pieces reads, with ITK's class, as the image that it was written from. */
template <typename TImage>
void
ExpectWritten(const std::string & fileName, unsigned int divisions)
{
  SCOPED_TRACE(divisions);
  const auto image = MakeImage<TImage>();
  WriteWith<TImage>(itk::StreamingNrrdImageIO::New(), image, fileName, divisions);
  const auto read = ReadWith<TImage>(itk::NrrdImageIO::New(), fileName);
  // Files have no start index: the origin moves to the first voxel.
  const auto expected = TImage::New();
  expected->Graft(image);
  typename TImage::PointType origin;
  image->TransformIndexToPhysicalPoint(image->GetBufferedRegion().GetIndex(), origin);
  EXPECT_LT(read->GetOrigin().EuclideanDistanceTo(origin), 1e-12);
  typename TImage::RegionType region;
  region.SetSize(image->GetBufferedRegion().GetSize());
  expected->SetRegions(region);
  expected->SetOrigin(read->GetOrigin());
  ExpectSameImage<TImage>(*read, *expected);
  ExpectAsNrrdImageIO<TImage>(fileName);
}

} // namespace

TEST_F(StreamingNrrdImageIOWrite, WritesInPieces)
{
  for (const unsigned int divisions : { 1u, 3u, 7u })
  {
    ExpectWritten<ShortImage>(this->Path("a.nrrd"), divisions);
    ExpectWritten<itk::Image<double, 2>>(this->Path("b.nrrd"), divisions);
    ExpectWritten<itk::Image<unsigned long, 3>>(this->Path("c.nrrd"), divisions);
    ExpectWritten<itk::Image<itk::Vector<float, 3>, 3>>(this->Path("d.nrrd"), divisions);
    ExpectWritten<itk::Image<itk::RGBPixel<std::uint8_t>, 3>>(this->Path("e.nrrd"), divisions);
    ExpectWritten<itk::Image<itk::CovariantVector<double, 2>, 2>>(this->Path("f.nrrd"), divisions);
  }
}

TEST_F(StreamingNrrdImageIOWrite, WritesThePiecesOfAStreamingPipeline)
{
  const std::string fileName = this->WriteShorts();
  const auto        reader = itk::ImageFileReader<ShortImage>::New();
  reader->SetImageIO(itk::StreamingNrrdImageIO::New());
  reader->SetFileName(fileName);
  unsigned int pieces = 0;
  reader->AddObserver(itk::EndEvent(), [&](const itk::EventObject &) {
    ++pieces;
    EXPECT_EQ(reader->GetOutput()->GetBufferedRegion().GetSize(2), 1u);
  });
  WriteWith<ShortImage>(itk::StreamingNrrdImageIO::New(), reader->GetOutput(), this->Path("out.nrrd"), 6);
  EXPECT_EQ(pieces, 6u);
  const auto written = ReadWith<ShortImage>(itk::NrrdImageIO::New(), this->Path("out.nrrd"));
  const auto expected = ReadWith<ShortImage>(itk::NrrdImageIO::New(), fileName);
  ExpectSameImage<ShortImage>(*written, *expected);
}

TEST_F(StreamingNrrdImageIOWrite, WritesKeyValuePairs)
{
  const auto image = MakeImage<ShortImage>();
  itk::EncapsulateMetaData<std::string>(image->GetMetaDataDictionary(), "line\\end", "a\nb");
  WriteWith<ShortImage>(itk::StreamingNrrdImageIO::New(), image, this->Path("a.nrrd"), 2);
  const auto  read = ReadWith<ShortImage>(itk::NrrdImageIO::New(), this->Path("a.nrrd"));
  std::string value;
  EXPECT_TRUE(itk::ExposeMetaData(read->GetMetaDataDictionary(), "line\\end", value));
  EXPECT_EQ(value, "a\nb");
}

TEST_F(StreamingNrrdImageIOWrite, PastesIntoFilesOfTheSameImageOnly)
{
  const auto        image = MakeImage<ShortImage>();
  const std::string fileName = this->Path("a.nrrd");
  WriteWith<ShortImage>(itk::NrrdImageIO::New(), image, fileName, 1);
  const auto paste = [&](ShortImage * source) {
    WriteWith<ShortImage>(itk::NrrdImageIO::New(), source, this->Path("source.nrrd"), 1);
    const auto reader = itk::ImageFileReader<ShortImage>::New();
    reader->SetImageIO(itk::StreamingNrrdImageIO::New());
    reader->SetFileName(this->Path("source.nrrd"));
    const auto         writer = itk::ImageFileWriter<ShortImage>::New();
    itk::ImageIORegion region(3);
    region.SetIndex({ 2, 3, 1 });
    region.SetSize({ 4, 2, 3 });
    writer->SetImageIO(itk::StreamingNrrdImageIO::New());
    writer->SetInput(reader->GetOutput());
    writer->SetFileName(fileName);
    writer->SetIORegion(region);
    writer->Update();
  };
  const auto changed = MakeImage<ShortImage>();
  changed->FillBuffer(-5);
  paste(changed);
  const auto read = ReadWith<ShortImage>(itk::NrrdImageIO::New(), fileName);
  for (itk::ImageRegionIteratorWithIndex<ShortImage> it(read, read->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto index = it.GetIndex();
    const bool inside = index[0] >= 2 && index[0] < 6 && index[1] >= 3 && index[1] < 5 && index[2] >= 1 && index[2] < 4;
    const auto offset = image->GetBufferedRegion().GetIndex() - ShortImage::IndexType{ { 0, 0, 0 } };
    EXPECT_EQ(it.Get(), inside ? -5 : image->GetPixel(index + offset)) << index;
  }
  auto spacing = changed->GetSpacing();
  spacing[0] *= 2;
  changed->SetSpacing(spacing);
  EXPECT_TRUE(Contains(ErrorOf([&] { paste(changed); }), "differs from the image in: spacing"));
  this->Write("a.nrrd", "not a header");
  EXPECT_TRUE(Contains(ErrorOf([&] { paste(image); }), "NRRD000"));
}

TEST_F(StreamingNrrdImageIOWrite, WriteErrorsAreExceptions)
{
  const auto image = MakeImage<ShortImage>();
  const auto write = [&](const std::string & fileName, const std::function<void(itk::StreamingNrrdImageIO *)> & set) {
    return ErrorOf([&] {
      const auto io = itk::StreamingNrrdImageIO::New();
      set(io);
      WriteWith<ShortImage>(io, image, fileName, 3);
    });
  };
  const auto asItIs = [](itk::StreamingNrrdImageIO *) {};
  EXPECT_TRUE(Contains(write(this->Path("missing/a.nrrd"), asItIs), "missing/a.nrrd"));

  const auto writer = itk::ImageFileWriter<ShortImage>::New();
  writer->SetImageIO(itk::StreamingNrrdImageIO::New());
  writer->SetInput(image);
  writer->SetFileName(this->Path("b.nrrd"));
  writer->UseCompressionOn();
  EXPECT_TRUE(Contains(ErrorOf([&] { writer->Update(); }), "compressed"));
  EXPECT_FALSE(std::filesystem::exists(this->Path("b.nrrd")));

  const auto io = itk::StreamingNrrdImageIO::New();
  io->SetFileName(this->Path("c.nrrd"));
  io->SetComponentType(itk::IOComponentEnum::UCHAR);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    io->SetDimensions(axis, itk::SizeValueType{ 1 } << 20);
  }
  // No disk has 2^60 bytes left.
  EXPECT_TRUE(Contains(ErrorOf([&] { io->WriteImageInformation(); }), "1152921504606"));
  EXPECT_FALSE(std::filesystem::exists(this->Path("c.nrrd")));
  io->SetDimensions(2, 0);
  EXPECT_TRUE(Contains(ErrorOf([&] { io->WriteImageInformation(); }), "empty"));
  io->SetComponentType(itk::IOComponentEnum::LDOUBLE);
  EXPECT_TRUE(Contains(ErrorOf([&] { io->WriteImageInformation(); }), "component type"));
}

TEST_F(StreamingNrrdImageIOWrite, ReadsAndWritesBeyondFourGigabytes)
{
  // Two slices of 2^32 voxels each; the file is a hole but for one line.
  using ByteImage = itk::Image<std::uint8_t, 3>;
  constexpr itk::SizeValueType size = itk::SizeValueType{ 1 } << 16;
  const auto                   io = itk::StreamingNrrdImageIO::New();
  EXPECT_TRUE(io->GetReserveSpace());
  io->ReserveSpaceOff();
  io->SetFileName(this->Path("large.nrrd"));
  io->SetComponentType(itk::IOComponentEnum::UCHAR);
  io->SetDimensions(0, size);
  io->SetDimensions(1, size);
  io->SetDimensions(2, 2);
  itk::ImageIORegion line(3);
  line.SetIndex({ size - 3, size - 1, 1 });
  line.SetSize({ 3, 1, 1 });
  io->SetIORegion(line);
  io->Write("xyz");
  EXPECT_GT(std::filesystem::file_size(this->Path("large.nrrd")), std::uint64_t{ 1 } << 33);

  const auto reader = itk::ImageFileReader<ByteImage>::New();
  reader->SetImageIO(itk::StreamingNrrdImageIO::New());
  reader->SetFileName(this->Path("large.nrrd"));
  reader->GetOutput()->UpdateOutputInformation();
  reader->GetOutput()->SetRequestedRegion({ { { size - 4, size - 1, 1 } }, { { 4, 1, 1 } } });
  reader->GetOutput()->Update();
  const std::uint8_t * const voxels = reader->GetOutput()->GetBufferPointer();
  EXPECT_EQ(std::vector<std::uint8_t>(voxels, voxels + 4), (std::vector<std::uint8_t>{ 0, 'x', 'y', 'z' }));
}

TEST_F(StreamingNrrdImageIOWrite, StandsInFrontOfNrrdImageIOOnceRegistered)
{
  itk::StreamingNrrdImageIOFactory::RegisterOneFactory();
  itk::StreamingNrrdImageIOFactory::RegisterOneFactory();
  const auto factories = itk::ObjectFactoryBase::GetRegisteredFactories();
  const auto isOurs = [](itk::ObjectFactoryBase * factory) {
    return dynamic_cast<itk::StreamingNrrdImageIOFactory *>(factory) != nullptr;
  };
  EXPECT_EQ(std::count_if(factories.begin(), factories.end(), isOurs), 1);

  const auto read = [](const std::string & fileName) {
    const auto reader = itk::ImageFileReader<ShortImage>::New();
    reader->SetFileName(fileName);
    reader->Update();
    return std::string(reader->GetModifiableImageIO()->GetNameOfClass());
  };
  EXPECT_EQ(read(this->WriteShorts()), "StreamingNrrdImageIO");
  const auto image = MakeImage<ShortImage>();
  const auto writer = itk::ImageFileWriter<ShortImage>::New();
  writer->SetInput(image);
  writer->SetFileName(this->Path("out.nrrd"));
  writer->SetNumberOfStreamDivisions(2);
  writer->Update();
  EXPECT_EQ(std::string(writer->GetModifiableImageIO()->GetNameOfClass()), "StreamingNrrdImageIO");

  const auto stock = itk::NrrdImageIO::New();
  itk::NrrdImageIOFactory::RegisterOneFactory();
  const auto compressing = itk::ImageFileWriter<ShortImage>::New();
  compressing->SetImageIO(stock);
  compressing->SetInput(image);
  compressing->SetFileName(this->Path("gzip.nrrd"));
  compressing->UseCompressionOn();
  compressing->Update();
  EXPECT_EQ(read(this->Path("gzip.nrrd")), "NrrdImageIO");

  const auto factory = std::find_if(factories.begin(), factories.end(), isOurs);
  EXPECT_NE(std::string((*factory)->GetDescription()), "");
  itk::ObjectFactoryBase::UnRegisterFactory(*factory);
  EXPECT_EQ(read(this->Path("out.nrrd")), "NrrdImageIO");
}

TEST_F(StreamingNrrdImageIOWrite, PrintsItsState)
{
  std::ostringstream text;
  itk::StreamingNrrdImageIO::New()->Print(text);
  for (const char * const part : { "ReserveSpace: 1", "NumberOfBytesRead: 0", "NumberOfDataFiles: 0" })
  {
    EXPECT_TRUE(Contains(text.str(), part)) << part;
  }
}
