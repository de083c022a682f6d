// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeHeader.h"

#include "ReadVolumeHeader.h"
#include "TemporaryFolder.h"

#include "itkMetaImageIO.h"
#include "itkNrrdImageIO.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace medialvoxel;

namespace
{

const std::string MetaText = "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
                             "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1 2 3\n"
                             "ElementSpacing = 0.5 0.5 2\nDimSize = 4 3 2\nElementType = MET_SHORT\n"
                             "ElementDataFile = LOCAL\n";
const std::string NrrdText =
  "NRRD0004\n# comment\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
  "sizes: 4 3 2\nspace directions: (0.5,0,0) (0,0.5,0) (0,0,2)\nkinds: domain domain domain\n"
  "endian: little\nencoding: raw\nspace origin: (1,2,3)\nkey:=value\n\n";
const std::string Voxels(48, '\1');

/** Damages a text in one of the ways in which files get damaged, or attacked. */
std::string
Mutate(std::string text, std::mt19937 & random)
{
  static const std::vector<std::string> pieces{
    "-1",   "0",  "999999999999999999", "nan", "1e308", "=", ":", "\n", "\r\n", "LIST", "%d",
    "MET_", "()", std::string(1, '\0'), "gzip"
  };
  const auto at = [&](size_t end) { return random() % std::max<size_t>(1, end); };
  switch (random() % 5)
  {
    case 0:
      text[at(text.size())] = static_cast<char>(random() % 256);
      break;
    case 1:
      text.erase(at(text.size()), 1 + random() % 20);
      break;
    case 2:
      text.insert(at(text.size()), pieces[at(pieces.size())]);
      break;
    case 3:
      text.resize(at(text.size()) + 1);
      break;
    default:
      text.insert(at(text.size()), std::string(random() % 5000, static_cast<char>('0' + random() % 70)));
      break;
  }
  return text;
}

} // namespace

TEST(VolumeHeader, SameVolumeInBothFormats)
{
  const TemporaryFolder folder;
  folder.Write("a.mha", MetaText + Voxels);
  folder.Write("a.nrrd", NrrdText + Voxels);
  for (const char * const name : { "a.mha", "a.nrrd" })
  {
    const VolumeHeader header = ReadVolumeHeader(folder / name, std::nullopt);
    EXPECT_EQ(header.geometry.size, (std::vector<std::uint64_t>{ 4, 3, 2 }));
    EXPECT_EQ(header.geometry.spacing, (std::vector<double>{ 0.5, 0.5, 2.0 }));
    EXPECT_EQ(header.geometry.origin, (std::vector<double>{ 1, 2, 3 }));
    EXPECT_EQ(header.pixelType, PixelType::Int16);
    EXPECT_EQ(header.GetDataSize(), 48u);
    EXPECT_EQ(header.dataOffset + 48, header.dataFileSize);
    EXPECT_FALSE(header.compressed);
    EXPECT_FALSE(header.bigEndian);
  }
}

TEST(VolumeHeader, GeometryIsTheOneThatItkReads)
{
  const std::string meta = "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 4 3 2\n";
  const std::string metaEnd = "ElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  const std::string nrrd = "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 2\nendian: little\nencoding: raw\n";
  const std::string vectors = "space directions: (0,0.5,0) (-0.25,0,0.25) (1.5,0,1.5)\nspace origin: (1,-2,3.5)\n";
  const std::vector<std::string> metaFields{
    "",
    "ElementSpacing = 0.1 0.2 0.3\n",
    "ElementSize = 0.1 0.2 0.3\n",
    "ElementSize = 3 4 5\nElementSpacing = 0.1 0.2 0.3\n",
    "Offset = 1 2 3\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\n",
    "Position = 1 2 3\nRotation = 0 1 0 -1 0 0 0 0 1\n",
    "Origin = 1 2 3\nOrientation = 0.6 0.8 0 -0.8 0.6 0 0 0 1\n",
    "Origin = 1 2 3\nPosition = 4 5 6\nOffset = 7 8 9\n",
    "TransformMatrix = 0 1 0 1 0 0 0 0 1\nRotation = 0 0 1 0 1 0 1 0 0\nOrientation = 1 0 0 0 0 1 0 1 0\n",
    "Comment = anything = goes\nCenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\n"
  };
  const std::vector<std::string> nrrdFields{ "",
                                             "spacings: 0.1 0.2 0.3\n",
                                             "space: left-posterior-superior\n" + vectors,
                                             "space: LPS\n" + vectors,
                                             "space: right-anterior-superior\n" + vectors,
                                             "space: RAS\n" + vectors,
                                             "space: scanner-xyz\n" + vectors,
                                             "space dimension: 3\n" + vectors,
                                             "space: LPS\nspace directions: ( 1, 0 ,0)  (0,2,0)\t(0,0,3)\n",
                                             "spacings: 0.5 1 2\naxis mins: 1 2 3\n",
                                             "spacings: 0.5 1 2\naxis mins: 1 2 3\ncenters: node cell ???\n",
                                             "axis mins: 1 2 3\naxis maxs: 5 8 9\ncenters: cell node cell\n",
                                             "axis mins: 1 2 3\n" };
  const TemporaryFolder          folder;
  const auto compare = [&](const std::string & name, const std::string & text, itk::ImageIOBase & io) {
    folder.Write(name, text + Voxels);
    const VolumeGeometry geometry = ReadVolumeHeader(folder / name, std::nullopt).geometry;
    io.SetFileName((folder / name).string());
    io.ReadImageInformation();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(geometry.size[axis], io.GetDimensions(axis)) << text;
      EXPECT_DOUBLE_EQ(geometry.spacing[axis], io.GetSpacing(axis)) << text;
      EXPECT_DOUBLE_EQ(geometry.origin[axis], io.GetOrigin(axis)) << text;
      for (unsigned int row = 0; row < 3; ++row)
      {
        EXPECT_NEAR(geometry.direction[axis][row], io.GetDirection(axis)[row], 1e-15) << text;
      }
    }
  };
  for (const std::string & fields : metaFields)
  {
    compare("a.mha", meta + fields + metaEnd, *itk::MetaImageIO::New());
  }
  for (const std::string & fields : nrrdFields)
  {
    compare("a.nrrd", nrrd + fields + "\n", *itk::NrrdImageIO::New());
  }
}

TEST(VolumeHeader, DamagedHeadersAreReadOrRefused)
{
  const TemporaryFolder folder;
  std::mt19937          random(1);
  int                   refused = 0;
  constexpr int         rounds = 1000;
  for (int round = 0; round < rounds; ++round)
  {
    const bool        isMeta = round % 2 == 0;
    const std::string name = isMeta ? "a.mha" : "a.nrrd";
    std::string       text = (isMeta ? MetaText : NrrdText);
    for (unsigned int damage = 0; damage <= random() % 3; ++damage)
    {
      text = Mutate(text, random);
    }
    folder.Write(name, text + Voxels);
    try
    {
      const VolumeHeader header = ReadVolumeHeader(folder / name, std::nullopt);
      EXPECT_LE(header.GetDataSize(), header.compressed ? 1032 * header.dataFileSize : header.dataFileSize) << text;
      for (const double spacing : header.geometry.spacing)
      {
        EXPECT_GT(spacing, 0.0) << text;
      }
    }
    catch (const JobError & error)
    {
      ++refused;
      EXPECT_NE(error.GetStatus(), ExitStatus::Done) << text;
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(refused, rounds / 4);
  EXPECT_LT(refused, rounds);
}
