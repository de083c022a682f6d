// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Manifest.h"
#include "Outputs.h"
#include "VolumeFormats.h"

#include "Errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace
{

using namespace medialvoxel;

TEST(MedialVoxelVolumeFormats, HaveExtensionsOfTheirOwn)
{
  const std::vector<std::string> extensions = ListInputExtensions();
  EXPECT_EQ(std::set<std::string>(extensions.begin(), extensions.end()).size(), extensions.size());
  for (const std::string & extension : extensions)
  {
    const VolumeFormat & format = FindInputFormat("no-such-file" + extension);
    EXPECT_EQ(&FindInputFormat("NO-SUCH-FILE" + extension), &format) << extension;
    EXPECT_TRUE(format.input.readHeader) << extension;
    EXPECT_NE(format.input.makeReader == nullptr, format.input.makeChunkReader == nullptr) << extension;
    EXPECT_EQ(format.input.openCompressed == nullptr, format.input.makeReader == nullptr) << extension;
  }
}

TEST(MedialVoxelVolumeFormats, OfOutputsAreRead)
{
  for (const std::string & extension : ListOutputExtensions())
  {
    const OutputFormat output = FindOutputFormat("out" + extension);
    EXPECT_EQ(output.extension.text, extension);
    EXPECT_EQ(&FindInputFormat("no-such-file" + extension), &output.format) << extension;
    EXPECT_EQ(output.format.writer->makeFolder != nullptr, output.format.IsFolder()) << extension;
    EXPECT_EQ(output.format.writer->makeHeader == nullptr, output.format.IsFolder()) << extension;
  }
  EXPECT_THROW(FindOutputFormat("out.tif"), JobError);
}

TEST(MedialVoxelVolumeFormats, WithoutComponentsAreNotListedForVectors)
{
  const std::vector<std::string> extensions = ListOutputExtensions(3);
  EXPECT_EQ(std::count(extensions.begin(), extensions.end(), ".nii"), 0);
  EXPECT_EQ(std::count(extensions.begin(), extensions.end(), ".nrrd"), 1);
}

VolumeHeader
MakeHeader()
{
  VolumeHeader header;
  header.geometry.size = { 5, 4, 3 };
  header.geometry.spacing = { 1.0, 1.0, 1.0 };
  header.geometry.origin = { 0.0, 0.0, 0.0 };
  header.geometry.SetIdentityDirection();
  return header;
}

/** Options that ask for all outputs, each in a file with the name of its role. */
template <typename TOptions>
TOptions
AskForAll()
{
  TOptions options;
  for (const auto & kind : ListOutputKinds(options))
  {
    EXPECT_TRUE((options.*kind.option).empty()) << kind.role << " has the option of another output";
    options.*kind.option = kind.role;
  }
  return options;
}

template <typename TOptions>
void
CheckListing()
{
  const auto            options = AskForAll<TOptions>();
  const auto            outputs = ListOutputs(options, MakeHeader());
  std::set<std::string> roles;
  for (const OutputRequest & output : outputs)
  {
    EXPECT_EQ(output.fileName, output.role);
    roles.insert(output.role);
  }
  EXPECT_EQ(roles.size(), ListOutputKinds(options).size());
  std::set<TileWriter> writers;
  std::size_t          written = 0; // others are filled at the end
  for (const VolumeRequest & volume : ListVolumes(options, MakeHeader()))
  {
    if (volume.write != nullptr)
    {
      writers.insert(volume.write);
      ++written;
    }
    const bool isOfLabels = volume.role == "labels" || volume.role == "objects";
    const bool isOfVoxels = volume.role == "local_thickness" || volume.role == "distance" || volume.role == "vectors";
    EXPECT_EQ(volume.geometry.origin.front(), isOfVoxels ? 0.0 : 0.5) << volume.role;
    EXPECT_EQ(volume.layout.components, volume.role == "vectors" ? 3 : 1) << volume.role;
    EXPECT_EQ(volume.layout.pixelType,
              volume.role == "walls" ? PixelType::UInt32
              : isOfLabels           ? PixelType::UInt8
                                     : PixelType::Float32)
      << volume.role;
  }
  EXPECT_EQ(writers.size(), written) << "two volumes are written the same way";
  EXPECT_TRUE(ListOutputs(TOptions(), MakeHeader()).empty());
}

TEST(MedialVoxelOutputs, OfAnExtractionAreListed)
{
  CheckListing<ExtractOptions>();
  EXPECT_EQ(ListVolumeNames(AskForAll<ExtractOptions>()).size(), 10);
}

TEST(MedialVoxelOutputs, OfDistancesAreListed)
{
  CheckListing<DistanceOptions>();
}

TEST(MedialVoxelOutputs, OfASurfaceAreListed)
{
  CheckListing<PartOptions>();
}

TEST(MedialVoxelOutputs, OfAJobAreInItsManifestOrRefused)
{
  for (const auto & kind : ListOutputKinds(ExtractOptions()))
  {
    ExtractOptions options;
    options.*kind.option = "name";
    EXPECT_EQ(FindDifference(options, ExtractOptions()).empty(), kind.refusal.has_value()) << kind.role;
  }
}

TEST(MedialVoxelOutputs, AReportForTheStandardOutputIsNoFile)
{
  ExtractOptions options;
  options.reportFile = StandardOutput;
  EXPECT_TRUE(ListOutputs(options, MakeHeader()).empty());
}

TEST(MedialVoxelOutputs, WithOtherExtensionsAreRefused)
{
  ExtractOptions options;
  options.htmlFile = "page.htm";
  options.previewFile = "picture.PNG";
  EXPECT_NO_THROW(CheckExtensions(options));
  options.placesFile = "places.txt";
  EXPECT_THROW(CheckExtensions(options), JobError);
}

} // namespace
