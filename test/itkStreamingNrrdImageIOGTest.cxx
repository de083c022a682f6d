// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MedialVoxelTestNrrd.h"

#include "itkImageRegionConstIterator.h"
#include "itkMetaDataObject.h"
#include "itkRGBPixel.h"
#include "itkStreamingImageFilter.h"

#include <utility>
#include <vector>

using namespace MedialVoxelTest;

namespace
{

class StreamingNrrdImageIO : public NrrdFiles
{};

std::string
ErrorOfReading(const std::string & fileName)
{
  return ErrorOf([&] { ReadWith<ShortImage>(itk::StreamingNrrdImageIO::New(), fileName); });
}

} // namespace

TEST_F(StreamingNrrdImageIO, ReadsAttachedFilesAsNrrdImageIO)
{
  ExpectAsNrrdImageIO<ShortImage>(this->WriteShorts());
  const std::string fields = "NRRD0005\n# comment\ntype: ushort\ndimension: 3\nsizes: 7 5 6\nencoding: raw\nkey:=a\n";
  const std::vector<std::string> variants{ "endian: big\n",
                                           "endian: big\nspacings: 0.5 0.1 3\naxis mins: 1 2 3\n",
                                           "endian: little\nspace: RAS\n" + Geometry.substr(Geometry.find('\n') + 1),
                                           "endian: little\nspace dimension: 3\n" +
                                             Geometry.substr(Geometry.find('\n') + 1),
                                           "endian: little\nkinds: domain domain domain\nline skip: 2\n",
                                           "endian: little\nbyte skip: 3\n",
                                           "endian: little\nline skip: 1\nbyte skip: 4\n",
                                           "endian: big\nbyte skip: -1\n" };
  for (const std::string & variant : variants)
  {
    ExpectAsNrrdImageIO<itk::Image<std::uint16_t, 3>>(
      this->Write("a.nrrd", fields + variant + "\nline 1\nline 2\n" + SomeBytes(2 * NumberOfVoxels)));
  }
}

template <typename TPixel>
void
ExpectType(const std::string & fileName, const std::string & type, const std::string & endian)
{
  std::ofstream(fileName, std::ios::binary)
    << "NRRD0004\ntype: " << type << "\ndimension: 2\nsizes: 7 5\nendian: " << endian << "\nencoding: raw\n\n"
    << std::string(35 * sizeof(TPixel), '\x12');
  ExpectAsNrrdImageIO<itk::Image<TPixel, 2>>(fileName);
}

TEST_F(StreamingNrrdImageIO, ReadsAllTypesInBothByteOrders)
{
  for (const char * const endian : { "little", "big" })
  {
    ExpectType<std::uint8_t>(this->Path("a.nrrd"), "unsigned char", endian);
    ExpectType<std::int8_t>(this->Path("a.nrrd"), "signed char", endian);
    ExpectType<std::uint16_t>(this->Path("a.nrrd"), "uint16", endian);
    ExpectType<std::int16_t>(this->Path("a.nrrd"), "signed short int", endian);
    ExpectType<std::uint32_t>(this->Path("a.nrrd"), "uint", endian);
    ExpectType<std::int32_t>(this->Path("a.nrrd"), "int32_t", endian);
    ExpectType<unsigned long long>(this->Path("a.nrrd"), "unsigned long long", endian);
    ExpectType<long long>(this->Path("a.nrrd"), "longlong", endian);
    ExpectType<float>(this->Path("a.nrrd"), "float", endian);
    ExpectType<double>(this->Path("a.nrrd"), "double", endian);
  }
}

TEST_F(StreamingNrrdImageIO, ReadsDetachedFilesAsNrrdImageIO)
{
  const std::string bytes = SomeBytes(2 * NumberOfVoxels);
  this->Write("one.img", "a\nb\nxyz" + bytes);
  this->Write("end.img", "anything" + bytes);
  for (std::uint64_t slice = 0; slice < SizeZ; ++slice)
  {
    // Each data file has a header of its own, as slices of scanners do.
    const std::uint64_t sliceBytes = 2 * SizeX * SizeY;
    const std::string   content = "line\n*" + bytes.substr(slice * sliceBytes, sliceBytes);
    this->Write("slice" + std::to_string(slice + 1) + ".img", content);
    this->Write((slice == 0 ? "slice00" : "slice000") + std::to_string(10 - slice) + ".img", content);
  }
  for (int half = 0; half < 2; ++half)
  {
    this->Write("half" + std::to_string(half) + ".img",
                "line\n*" + bytes.substr(half * NumberOfVoxels, NumberOfVoxels));
  }
  for (std::uint64_t row = 0; row < SizeY * SizeZ; ++row)
  {
    this->Write("row" + std::to_string(row) + ".img", "line\n*" + bytes.substr(row * 2 * SizeX, 2 * SizeX));
  }
  std::string list = "data file: LIST\n";
  for (std::uint64_t slice = SizeZ; slice > 0; --slice)
  {
    list += "slice" + std::to_string(slice) + ".img\n";
  }
  const std::string              skips = "line skip: 1\nbyte skip: 1\n";
  const std::vector<std::string> variants{ "line skip: 2\nbyte skip: 3\ndata file: one.img\n",
                                           "byte skip: -1\ndata file: end.img\n",
                                           "byteskip: -1\ndatafile: " + this->Path("end.img") + "\n\n",
                                           skips + "data file: slice%d.img 1 6 1\n",
                                           skips + "data file: slice%d.img 6 1 -1\n",
                                           skips + "data file: slice%04d.img 10 5 -1 2\n",
                                           skips + "data file: half%d.img 0 1 1 3\n",
                                           skips + "data file: row%d.img 0 29 1 1\n",
                                           skips + list,
                                           skips + "data file: LIST 3\nhalf1.img\nhalf0.img\n" };
  for (const std::string & variant : variants)
  {
    SCOPED_TRACE(variant);
    ExpectAsNrrdImageIO<ShortImage>(this->Write("a.nhdr", "NRRD0004\n" + ShortFields + Geometry + variant));
  }
}

TEST_F(StreamingNrrdImageIO, ReadsComponentsAsNrrdImageIO)
{
  using VectorImage = itk::Image<itk::Vector<float, 3>, 3>;
  using ColorImage = itk::Image<itk::RGBPixel<std::uint8_t>, 2>;
  const std::string vectors = "NRRD0004\ntype: float\ndimension: 4\nsizes: 3 7 5 6\nendian: big\nencoding: raw\n";
  const std::string space = "space: left-posterior-superior\nspace directions: none (0.5,0,0) (0,0.3,0) (0,0,2)\n"
                            "space origin: (1,2,3)\nmeasurement frame: (1,0,0) (0,1,0) (0,0,1)\n";
  for (const char * const kind : { "vector", "3-vector", "list", "covariant-vector", "point" })
  {
    const std::string kinds = std::string("kinds: ") + kind + " domain domain domain\n";
    ExpectAsNrrdImageIO<VectorImage>(
      this->Write("a.nrrd", vectors + space + kinds + "\n" + std::string(12 * NumberOfVoxels, '\x11')));
  }
  ExpectAsNrrdImageIO<ColorImage>(
    this->Write("a.nrrd",
                "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 7 5\nspacings: nan 0.5 0.25\naxis mins: nan 1 2\n"
                "kinds: RGB-color domain domain\nencoding: raw\n\n" +
                  SomeBytes(105)));
}

TEST_F(StreamingNrrdImageIO, ReadsMetaDataAsNrrdImageIO)
{
  const std::string fileName = this->Write("a.nrrd",
                                           "NRRD0005\n" + ShortFields + Geometry +
                                             "content: a phantom\nkinds: space domain domain\n"
                                             "measurement frame: (1,0,0) (0,0,1) (0,1,0)\nkey one:=a \\\\ b\\nc\n\n" +
                                             SomeBytes(2 * NumberOfVoxels));
  const auto        io = itk::StreamingNrrdImageIO::New();
  const auto        stock = itk::NrrdImageIO::New();
  for (itk::ImageIOBase * const each : { static_cast<itk::ImageIOBase *>(io), static_cast<itk::ImageIOBase *>(stock) })
  {
    each->SetFileName(fileName);
    each->ReadImageInformation();
    const itk::MetaDataDictionary & dictionary = each->GetMetaDataDictionary();
    EXPECT_EQ(dictionary.GetKeys().size(), 8u);
    std::string value;
    for (const auto & [key, expected] :
         { std::pair<const char *, const char *>{ "key one", "a \\ b\nc" },
           std::pair<const char *, const char *>{ "NRRD_content", "a phantom" },
           std::pair<const char *, const char *>{ "NRRD_space", "left-posterior-superior" },
           std::pair<const char *, const char *>{ "NRRD_kinds[0]", "space" } })
    {
      EXPECT_TRUE(itk::ExposeMetaData(dictionary, key, value)) << key;
      EXPECT_EQ(value, expected);
    }
    std::vector<std::vector<double>> frame;
    EXPECT_TRUE(itk::ExposeMetaData(dictionary, "NRRD_measurement frame", frame));
    EXPECT_EQ(frame, (std::vector<std::vector<double>>{ { 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } }));
  }
}

TEST_F(StreamingNrrdImageIO, TurnsTheAnteriorAxisOfLeftAnteriorSuperior)
{
  const std::string fileName = this->Write(
    "a.nrrd",
    "NRRD0004\n" + ShortFields + "space: LAS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (1,2,3)\n\n" +
      SomeBytes(2 * NumberOfVoxels));
  const auto image = ReadWith<ShortImage>(itk::StreamingNrrdImageIO::New(), fileName);
  EXPECT_EQ(image->GetOrigin()[0], 1.0);
  EXPECT_EQ(image->GetOrigin()[1], -2.0);
  EXPECT_EQ(image->GetDirection()[0][0], 1.0);
  EXPECT_EQ(image->GetDirection()[1][1], -1.0);
}

TEST_F(StreamingNrrdImageIO, ReadsAnyRegionAndNothingElse)
{
  const std::string attached = this->WriteShorts();
  for (std::uint64_t slice = 0; slice < SizeZ; ++slice)
  {
    const std::uint64_t sliceBytes = 2 * SizeX * SizeY;
    this->Write("slice" + std::to_string(slice), SomeBytes(2 * NumberOfVoxels).substr(slice * sliceBytes, sliceBytes));
  }
  const std::string detached =
    this->Write("a.nhdr", "NRRD0004\n" + ShortFields + Geometry + "data file: slice%d 0 5 1\n");
  const auto   whole = ReadWith<ShortImage>(itk::NrrdImageIO::New(), attached);
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round)
  {
    ShortImage::RegionType region;
    const std::uint64_t    sizes[] = { SizeX, SizeY, SizeZ };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      // Whole axes come up often: they decide which voxels are read in one go.
      const bool isWhole = random() % 2 == 0;
      const auto index = isWhole ? 0 : random() % sizes[axis];
      region.SetIndex(axis, static_cast<itk::IndexValueType>(index));
      region.SetSize(axis, isWhole ? sizes[axis] : 1 + random() % (sizes[axis] - index));
    }
    const auto io = itk::StreamingNrrdImageIO::New();
    const auto reader = itk::ImageFileReader<ShortImage>::New();
    reader->SetImageIO(io);
    reader->SetFileName(round % 2 == 0 ? attached : detached);
    reader->GetOutput()->UpdateOutputInformation();
    reader->GetOutput()->SetRequestedRegion(region);
    reader->GetOutput()->Update();
    ASSERT_EQ(reader->GetOutput()->GetBufferedRegion(), region);
    itk::ImageRegionConstIterator<ShortImage> expected(whole, region);
    for (itk::ImageRegionConstIterator<ShortImage> it(reader->GetOutput(), region); !it.IsAtEnd(); ++it, ++expected)
    {
      ASSERT_EQ(it.Get(), expected.Get());
    }
    EXPECT_EQ(io->GetNumberOfBytesRead(), region.GetNumberOfPixels() * sizeof(std::int16_t));
  }
}

TEST_F(StreamingNrrdImageIO, StreamsThroughAPipeline)
{
  const std::string fileName = this->WriteShorts();
  const auto        io = itk::StreamingNrrdImageIO::New();
  const auto        reader = itk::ImageFileReader<ShortImage>::New();
  const auto        streamer = itk::StreamingImageFilter<ShortImage, ShortImage>::New();
  reader->SetImageIO(io);
  reader->SetFileName(fileName);
  std::vector<ShortImage::RegionType> buffered;
  reader->AddObserver(itk::EndEvent(),
                      [&](const itk::EventObject &) { buffered.push_back(reader->GetOutput()->GetBufferedRegion()); });
  streamer->SetInput(reader->GetOutput());
  streamer->SetNumberOfStreamDivisions(3);
  streamer->Update();
  EXPECT_EQ(buffered.size(), 3u);
  for (const ShortImage::RegionType & region : buffered)
  {
    EXPECT_EQ(region.GetSize(2), 2u);
  }
  EXPECT_EQ(io->GetNumberOfBytesRead(), 2 * NumberOfVoxels);
  const auto expected = ReadWith<ShortImage>(itk::NrrdImageIO::New(), fileName);
  ExpectSameImage<ShortImage>(*streamer->GetOutput(), *expected);
}

TEST_F(StreamingNrrdImageIO, LeavesOtherFilesToNrrdImageIO)
{
  const auto io = itk::StreamingNrrdImageIO::New();
  const auto canRead = [&](const std::string & name, const std::string & content) {
    return io->CanReadFile(this->Write(name, content).c_str());
  };
  const std::string head = "NRRD0004\ntype: short\nendian: little\n";
  const std::string volume = head + "dimension: 3\nsizes: 7 5 6\n";
  const std::string data = "\n" + SomeBytes(2 * NumberOfVoxels);
  EXPECT_TRUE(canRead("a.nrrd", volume + "encoding: raw\n" + data));
  EXPECT_TRUE(canRead("a.nrrd", volume + "encoding: RAW\n" + data));
  EXPECT_TRUE(canRead("a.nrrd", volume + "encoding: raw\nspacings: 1 -1 1\n" + data));
  EXPECT_FALSE(canRead("a.mha", volume + "encoding: raw\n" + data));
  for (const char * const encoding : { "gzip", "ascii", "bzip2", "hex" })
  {
    EXPECT_FALSE(canRead("a.nrrd", volume + "encoding: " + encoding + "\n" + data));
  }
  EXPECT_FALSE(canRead("a.nrrd", head + "dimension: 4\nsizes: 7 5 3 2\nencoding: raw\n" + data));
  EXPECT_FALSE(canRead("a.nrrd", head + "dimension: 1\nsizes: 7\nencoding: raw\n" + data));
  EXPECT_FALSE(
    canRead("a.nrrd", head + "dimension: 3\nsizes: 7 5 3\nkinds: domain domain vector\nencoding: raw\n" + data));
  EXPECT_FALSE(io->CanReadFile(this->Path("missing.nrrd").c_str()));
  EXPECT_TRUE(io->CanWriteFile("a.nrrd"));
  EXPECT_FALSE(io->CanWriteFile("a.nhdr"));
  EXPECT_TRUE(io->CanStreamRead());
  EXPECT_TRUE(io->CanStreamWrite());
  EXPECT_TRUE(io->SupportsDimension(3));
  EXPECT_FALSE(io->SupportsDimension(4));
}

TEST_F(StreamingNrrdImageIO, ReadsADamagedHeaderOrSaysWhatIsWrong)
{
  const std::string                                      data = "\n" + SomeBytes(2 * NumberOfVoxels);
  const std::string                                      type = "NRRD0004\ntype: short\n";
  const std::string                                      sizes = "dimension: 3\nsizes: 7 5 6\n";
  const std::string                                      order = "endian: little\n";
  const std::string                                      raw = "encoding: raw\n";
  const std::vector<std::pair<std::string, std::string>> headers{
    { "", "NRRD000" },
    { "NRRD0004", "dimension" },
    { "NRRD0004\ntype: floot\n" + sizes + order + raw + data, "'floot'" },
    { type + "dimension: three\nsizes: 7 5 6\n" + order + raw + data, "'three'" },
    { type + "dimension: 3\nsizes: 7 5\n" + order + raw + data, "sizes has 2 values, not 3" },
    { type + "dimension: 3\nsizes: 7 -5 6\n" + order + raw + data, "'-5'" },
    { type + "dimension: 3\nsizes: 7 5 0\n" + order + raw + data, "'0'" },
    { type + "dimension: 3\nsizes: 2147483648 2147483648 2147483648\n" + order + raw + data, "more voxels" },
    { type + "dimension: 3\nsizes: 100000 100000 100000\n" + order + raw + data, "2000000000000000" },
    { type + "dimension: 3\nsizes: 7 5 7\n" + order + raw + data, "490" },
    { type + sizes + raw + data, "endian" },
    { type + sizes + "endian: middle\n" + raw + data, "'middle'" },
    { type + sizes + order + data, "encoding" },
    { type + sizes + sizes + order + raw + data, "twice" },
    { type + sizes + order + raw + "no field\n" + data, "line 7" },
    { type + sizes + order + raw + "spacings: 1 0 1\n" + data, "'0'" },
    { type + sizes + order + raw + "spacings: 1 nan 1\n" + data, "'nan'" },
    { type + sizes + order + raw + "space directions: (1,0,0) (0,1,0)\n" + data, "2 vectors, not 3" },
    { type + sizes + order + raw + "space directions: (1,0,0) (0,0,0) (0,0,1)\n" + data, "(0,0,0)" },
    { type + sizes + order + raw + "space directions: (1,0,0) (0,1,0) 1\n" + data, "vectors such as" },
    { type + sizes + order + raw + "kinds: domain domain\n" + data, "kinds has 2 values, not 3" },
    { type + sizes + order + raw + "kinds: domain domain dome\n" + data, "'dome'" },
    { type + sizes + order + raw + "byte skip: -2\n" + data, "'-2'" },
    { type + sizes + order + raw + "byte skip: 1\n" + data, "420" },
    { type + sizes + order + raw + "byte skip: 9223372036854775807\n" + data, "9223372036854775" },
    { type + sizes + order + raw + "line skip: 1000\n" + data, "1000" },
    { type + sizes + order + raw + "data file: missing.img\n", "missing.img" },
    { type + sizes + order + raw + "data file: \n", "data file is ''" },
    { type + sizes + order + raw + "data file: LIST\n", "0 files; there must be 6" },
    { type + sizes + order + raw + "data file: LIST 4\nx\n", "1 to 3" },
    { type + sizes + order + raw + "data file: LIST 3\nx\nx\nx\nx\n", "4 files" },
    { type + sizes + order + raw + "data file: s%d.img 1 5 1\n", "5 files; there must be 6" },
    { type + sizes + order + raw + "data file: s%d.img 1 6\n", "step" },
    { type + sizes + order + raw + "data file: s%d.img 1 6 0\n", "step" },
    { type + sizes + order + raw + "data file: s%d.img 1 6 -1\n", "step" },
    { type + sizes + order + raw + "data file: s%d.img 1 2147483647 1\n", "2147483647 files" },
    { type + sizes + order + raw + "data file: s%d.img 1 6 1\n", "s1.img" },
    { type + sizes + order + raw + std::string(1, '\0') + data, "not text" },
  };
  for (const auto & [header, expected] : headers)
  {
    const std::string fileName = this->Write("a.nrrd", header);
    const std::string error = ErrorOfReading(fileName);
    EXPECT_TRUE(Contains(error, expected)) << expected << "\n" << error << "\n" << header.substr(0, 200);
    EXPECT_TRUE(Contains(error, this->Path(""))) << error;
  }
}

TEST_F(StreamingNrrdImageIO, NoticesAFileThatBecameShorter)
{
  const std::string fileName = this->WriteShorts();
  const auto        reader = itk::ImageFileReader<ShortImage>::New();
  reader->SetImageIO(itk::StreamingNrrdImageIO::New());
  reader->SetFileName(fileName);
  reader->UpdateOutputInformation();
  std::filesystem::resize_file(fileName, std::filesystem::file_size(fileName) - 1);
  EXPECT_TRUE(Contains(ErrorOf([&] { reader->Update(); }), "ends early"));
  EXPECT_TRUE(Contains(ErrorOfReading(fileName), std::to_string(2 * NumberOfVoxels)));
}

TEST_F(StreamingNrrdImageIO, SurvivesRandomDamage)
{
  const std::string text = "NRRD0004\n" + ShortFields + Geometry + "kinds: domain domain domain\nline skip: 0\n\n";
  std::mt19937      random(1);
  int               refused = 0;
  constexpr int     rounds = 500;
  const auto        io = itk::StreamingNrrdImageIO::New();
  for (int round = 0; round < rounds; ++round)
  {
    std::string damaged = text;
    for (unsigned int damage = 0; damage <= random() % 3; ++damage)
    {
      const size_t position = random() % damaged.size();
      if (random() % 2 == 0)
      {
        damaged[position] = static_cast<char>(random() % 256);
      }
      else
      {
        damaged.erase(position, 1 + random() % 20);
      }
    }
    const std::string fileName = this->Write("a.nrrd", damaged + SomeBytes(2 * NumberOfVoxels));
    io->CanReadFile(fileName.c_str());
    io->SetFileName(fileName);
    const std::string error = ErrorOf([&] { io->ReadImageInformation(); });
    refused += error.empty() ? 0 : 1;
    EXPECT_TRUE(error.empty() || Contains(error, fileName)) << error;
    EXPECT_LE(error.empty() ? static_cast<std::uint64_t>(io->GetImageSizeInBytes()) : 0,
              std::filesystem::file_size(fileName));
  }
  EXPECT_GT(refused, rounds / 4);
  EXPECT_LT(refused, rounds);
}
