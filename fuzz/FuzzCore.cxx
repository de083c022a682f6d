// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The filter on small volumes in pieces, with tiles, slabs, threads and a memory limit, against brute force.

#include "FuzzOracle.h"
#include "FuzzSupport.h"

#include "itkImage.h"
#include "itkImageRegionSplitterMultidimensional.h"
#include "itkMedialVoxelImageFilter.h"
#include "itkStreamingImageFilter.h"

namespace
{

using namespace MedialVoxelFuzz;
using namespace MedialVoxelTest;
using ImageType = itk::Image<unsigned char, 3>;
using FilterType = itk::MedialVoxelImageFilter<ImageType>;

/** \class Choices
 * \brief Takes numbers from the bytes of an input, 0 behind its end. */
class Choices
{
public:
  Choices(const std::uint8_t * data, std::size_t size)
    : m_Data(data)
    , m_Size(size)
  {}

  unsigned int
  Byte()
  {
    return m_Position < m_Size ? m_Data[m_Position++] : 0;
  }

  int
  Next(int low, int high)
  {
    return low + static_cast<int>(this->Byte()) % (high - low + 1);
  }

  bool
  IsAtEnd() const
  {
    return m_Position >= m_Size;
  }

private:
  const std::uint8_t * m_Data;
  std::size_t          m_Size;
  std::size_t          m_Position{ 0 };
};

/** How the work is cut, which must not change a byte. */
struct Cut
{
  unsigned int       tileSize;
  unsigned int       slabThickness;
  unsigned int       workUnits;
  unsigned int       divisions;
  itk::SizeValueType memoryLimit;
};

// Brute force takes the square of it; rows longer than a word of bits stay possible.
constexpr int MaximumVoxels = 800;

Index3
ChooseSize(Choices & choices)
{
  const int x = choices.Next(1, 140);
  const int y = choices.Next(1, std::min(40, MaximumVoxels / x));
  return { { x, y, choices.Next(1, std::min(40, MaximumVoxels / (x * y))) } };
}

Vector3
ChooseSpacing(Choices & choices)
{
  const std::array<double, 6> lengths{ 1.0, 0.5, 0.7, 1.3, 2.0, 0.25 };
  const auto                  next = [&] { return lengths[choices.Next(0, 5)]; };
  const double                x = next();
  return choices.Next(0, 1) == 0 ? Vector3{ { x, x, x } } : Vector3{ { x, next(), next() } };
}

/** Either one bit per voxel, or boxes that add and remove object. */
void
FillVolume(Choices & choices, Volume & volume)
{
  if (choices.Next(0, 1) == 0)
  {
    unsigned int bits = 0;
    for (std::size_t i = 0; i < volume.object.size(); ++i)
    {
      bits = i % 8 == 0 ? choices.Byte() : bits >> 1;
      volume.object[i] = bits & 1;
    }
    return;
  }
  while (!choices.IsAtEnd())
  {
    const bool isObject = choices.Next(0, 1) == 0;
    Index3     low;
    Index3     high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = choices.Next(0, volume.size[axis] - 1);
      high[axis] = std::min(volume.size[axis], low[axis] + choices.Next(1, volume.size[axis]));
    }
    for (int z = low[2]; z < high[2]; ++z)
    {
      for (int y = low[1]; y < high[1]; ++y)
      {
        for (int x = low[0]; x < high[0]; ++x)
        {
          volume.Set({ { x, y, z } }, isObject);
        }
      }
    }
  }
}

Question
ChooseQuestion(Choices & choices)
{
  Question question;
  question.volume = Volume(ChooseSize(choices), ChooseSpacing(choices));
  question.bound = std::array<Bound, 3>{ Bound::FreeSpace, Bound::Paper, Bound::Off }[choices.Next(0, 2)];
  const bool isAutomatic = choices.Next(0, 2) == 0;
  // Not the round numbers at which paths have the length that decides.
  const double first = 0.113 + choices.Byte() / 16.0;
  const double second = first + choices.Byte() / 16.0;
  question.thickness = isAutomatic ? std::nullopt : std::optional<double>(first);
  question.minimumThickness = first;
  question.maximumThickness = second;
  return question;
}

Cut
ChooseCut(Choices & choices)
{
  Cut cut{};
  cut.tileSize = static_cast<unsigned int>(choices.Next(0, 70));
  cut.slabThickness = static_cast<unsigned int>(choices.Next(0, 20));
  cut.workUnits = static_cast<unsigned int>(choices.Next(1, 2));
  cut.divisions = static_cast<unsigned int>(choices.Next(1, 4));
  cut.memoryLimit = choices.Next(0, 3) == 0 ? (1u << 18) * choices.Byte() : 0;
  return cut;
}

ImageType::Pointer
MakeImage(const Volume & volume)
{
  auto                   image = ImageType::New();
  ImageType::SizeType    size;
  ImageType::SpacingType spacing;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<itk::SizeValueType>(volume.size[axis]);
    spacing[axis] = volume.spacing[axis];
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->Allocate();
  std::copy(volume.object.begin(), volume.object.end(), image->GetBufferPointer());
  return image;
}

FilterType::Pointer
MakeFilter(const Question & question)
{
  using BoundEnum = itk::MedialVoxelPseudoGeodesicBound;
  auto filter = FilterType::New();
  filter->SetInput(MakeImage(question.volume));
  filter->SetPseudoGeodesicBound(question.bound == Bound::FreeSpace ? BoundEnum::FreeSpace
                                 : question.bound == Bound::Paper   ? BoundEnum::Paper
                                                                    : BoundEnum::Off);
  if (question.thickness)
  {
    filter->SetThickness(*question.thickness);
    return filter;
  }
  filter->SetThicknessMode(itk::MedialVoxelThicknessMode::Automatic);
  filter->SetMinimumThickness(question.minimumThickness);
  filter->SetMaximumThickness(question.maximumThickness);
  return filter;
}

Classification
ResultOf(const FilterType * filter, const ImageType * labels)
{
  const auto     numberOfVoxels = labels->GetBufferedRegion().GetNumberOfPixels();
  Classification result;
  result.labels.assign(labels->GetBufferPointer(), labels->GetBufferPointer() + numberOfVoxels);
  result.counts = { filter->GetNumberOfObjectVoxels(),
                    filter->GetNumberOfBoundaryVoxels(),
                    filter->GetNumberOfCandidateCells(),
                    filter->GetNumberOfTrivialCells(),
                    filter->GetNumberOfBoundCells(),
                    filter->GetNumberOfGeodesicMedialCells(),
                    filter->GetNumberOfGeodesicNonMedialCells() };
  return result;
}

bool
AreEqual(const Classification & a, const Classification & b)
{
  const Counts & c = a.counts;
  const Counts & d = b.counts;
  return a.labels == b.labels && c.objectVoxels == d.objectVoxels && c.boundaryVoxels == d.boundaryVoxels &&
         c.candidateCells == d.candidateCells && c.trivialCells == d.trivialCells && c.boundCells == d.boundCells &&
         c.geodesicMedialCells == d.geodesicMedialCells && c.geodesicNonMedialCells == d.geodesicNonMedialCells;
}

void
CheckVectors(const FilterType * filter, const Question & question, BoundarySide side)
{
  const auto * const vectors = filter->GetVectorDistanceOutput()->GetBufferPointer();
  const auto         expected = VectorsByBruteForce(question.volume, side);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      Require(vectors[i][axis] == expected[i][axis], "a vector differs from that by brute force");
    }
  }
}

/** In one piece, with the vectors of one of the boundaries. */
Classification
RunWhole(const Question & question, BoundarySide side)
{
  auto filter = MakeFilter(question);
  filter->SetNumberOfWorkUnits(1);
  filter->GenerateVectorDistanceOn();
  filter->SetVectorDistanceBoundary(side == BoundarySide::Object ? itk::MedialVoxelBoundary::Object
                                                                 : itk::MedialVoxelBoundary::Background);
  filter->Update();
  CheckVectors(filter, question, side);
  return ResultOf(filter, filter->GetOutput());
}

/** In pieces; nothing when the memory does not suffice. */
std::optional<Classification>
RunInPieces(const Question & question, const Cut & cut)
try
{
  auto filter = MakeFilter(question);
  filter->SetTileSize(cut.tileSize);
  filter->SetSlabThickness(cut.slabThickness);
  filter->SetNumberOfWorkUnits(cut.workUnits);
  filter->SetWorkingMemoryLimit(cut.memoryLimit);
  auto streamer = itk::StreamingImageFilter<ImageType, ImageType>::New();
  streamer->SetInput(filter->GetOutput());
  streamer->SetRegionSplitter(itk::ImageRegionSplitterMultidimensional::New());
  streamer->SetNumberOfStreamDivisions(cut.divisions);
  streamer->Update();
  return ResultOf(filter, streamer->GetOutput());
}
catch (const itk::MedialVoxelMemoryError & error)
{
  Require(cut.memoryLimit > 0 && error.GetNeededBytes() > cut.memoryLimit, error.what());
  return std::nullopt;
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  Choices            choices(data, size);
  Question           question = ChooseQuestion(choices);
  const Cut          cut = ChooseCut(choices);
  const BoundarySide side = choices.Next(0, 1) == 0 ? BoundarySide::Object : BoundarySide::Background;
  FillVolume(choices, question.volume);

  const Classification whole = RunWhole(question, side);
  const auto           pieces = RunInPieces(question, cut);
  Require(!pieces || AreEqual(*pieces, whole), "the pieces differ from the whole");
  const auto expected = AnswerByBruteForce(question);
  Require(!expected || AreEqual(*expected, whole), "the whole differs from brute force");
  return 0;
}
