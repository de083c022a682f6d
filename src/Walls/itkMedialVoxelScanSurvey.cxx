// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelScanSurvey.h"

#include "itkMedialVoxelDilation.h"
#include "itkMedialVoxelGrayLocal.h"
#include "itkMedialVoxelGrayNormals.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelScanBlocks.h"
#include "itkMedialVoxelScanSamples.h"
#include "itkMedialVoxelText.h"
#include "itkMedialVoxelWallFit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

namespace itk
{
namespace
{

using Index = MedialVoxelIndex;
using Box = MedialVoxelBox;
using Vector = MedialVoxelVector3;
using Samples = MedialVoxelScanSamples;

/** Blocks that are looked at before it is known whether the samples are enough. */
constexpr std::size_t BlocksPerRound = 24;

/** Voxels around an object voxel in which there is background of it, without and with the blur of the object. */
constexpr std::int64_t FarFromObject = 3;
constexpr std::int64_t NearObject = 8;

/** Voxels without object around a mean of 3^D voxels, and of 5^D. */
constexpr std::int64_t FarFromSmallMean = 5;
constexpr std::int64_t FarFromLargeMean = 6;

/** Voxels around a block that must be there. */
constexpr std::int64_t Margin = 9;

/** Faces of some object voxels are looked at, chosen by their place. */
constexpr std::uint64_t ObjectVoxelsPerLook = 4;

/** Time of a row of voxels, and of a surface, in short steps. */
constexpr std::uint32_t StepsOfRow = 128;
constexpr std::uint32_t StepsOfSurface = 128;

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

struct Neighbor
{
  Index  offset;
  double distance;
};

/** Around a voxel along the axes that the image has, the nearest first. */
std::vector<Neighbor>
ListNeighbors(const MedialVoxelGrid & grid)
{
  const auto reach = [&grid](const unsigned int axis) {
    return grid.IsActive(axis) ? static_cast<std::int64_t>(Samples::LargestDepth) : 0;
  };
  std::vector<Neighbor> neighbors;
  for (std::int64_t z = -reach(2); z <= reach(2); ++z)
  {
    for (std::int64_t y = -reach(1); y <= reach(1); ++y)
    {
      for (std::int64_t x = -reach(0); x <= reach(0); ++x)
      {
        const double distance = std::sqrt(static_cast<double>(x * x + y * y + z * z));
        if (distance < Samples::LargestDepth)
        {
          neighbors.push_back({ { { x, y, z } }, distance });
        }
      }
    }
  }
  std::sort(neighbors.begin(), neighbors.end(), [](const Neighbor & first, const Neighbor & second) {
    return first.distance < second.distance;
  });
  return neighbors;
}

/** \class BlockLook
 * \brief Takes the samples of one block. */
class BlockLook
{
public:
  BlockLook(const MedialVoxelGrid &       grid,
            const std::vector<Neighbor> & neighbors,
            const MedialVoxelBits &       object,
            const MedialVoxelGray &       gray)
    : m_Grid(grid)
    , m_Neighbors(neighbors)
    , m_Local(grid, 0.0, 1.0)
    , m_Normals(grid, 0.0, MedialVoxelGrayNormals::FindLargestValue(gray))
    , m_Object(object)
    , m_Near(MedialVoxelDilate(object, FarFromObject))
    , m_NearSmallMean(MedialVoxelDilate(m_Near, FarFromSmallMean - FarFromObject))
    , m_NearLargeMean(MedialVoxelDilate(m_NearSmallMean, FarFromLargeMean - FarFromSmallMean))
    , m_Around(MedialVoxelDilate(m_NearLargeMean, NearObject - FarFromLargeMean))
    , m_Gray(gray)
  {}

  /** Of a part of whole rows of a block. */
  void
  Take(const Box & part, const Box & block, const std::uint64_t seed, Samples & samples)
  {
    Index voxel = part.lower;
    for (voxel[2] = part.lower[2]; voxel[2] < part.upper[2]; ++voxel[2])
    {
      for (voxel[1] = part.lower[1]; voxel[1] < part.upper[1]; ++voxel[1])
      {
        m_Checker.Count(StepsOfRow);
        this->TakeRow(voxel, block, seed, samples);
        if (samples.sides.AreOfMask())
        {
          this->TakeSides(voxel, block.upper[0], samples.sides);
        }
      }
    }
  }

private:
  using Word = MedialVoxelBits::WordType;

  /** Of the row of a block through a voxel. */
  void
  TakeRow(const Index & first, const Box & block, const std::uint64_t seed, Samples & samples)
  {
    const auto         row = [&](const MedialVoxelBits & bits) { return bits.GetRow(first[1], first[2]); };
    const std::int64_t firstWord = m_Object.GetFirstWord();
    const auto         hashOf = [&](const Index & voxel) {
      return MedialVoxelHash(seed + static_cast<std::uint64_t>(block.OffsetOf(voxel)));
    };
    for (std::int64_t i = 0; i < m_Object.GetWordsPerRow(); ++i)
    {
      const Word inBlock = MedialVoxelBits::RangeMask(firstWord + i, block.lower[0], block.upper[0]);
      const Word object = row(m_Object)[i] & inBlock;
      Index      voxel = first;
      for (Word rest = object == 0 ? 0 : object & ~this->GetInner(first, i); rest != 0; rest &= rest - 1)
      {
        voxel[0] = (firstWord + i) * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(rest);
        this->TakeOuter(voxel, hashOf(voxel), samples);
      }
      this->TakeMaterial(first, firstWord + i, object, hashOf, samples.material);
      for (Word rest = row(m_Around)[i] & ~row(m_Near)[i] & inBlock; rest != 0; rest &= rest - 1)
      {
        voxel[0] = (firstWord + i) * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(rest);
        const std::uint64_t hash = hashOf(voxel);
        if (samples.background.Wants(hash))
        {
          this->TakeBackground(voxel, hash, samples);
        }
      }
    }
  }

  /** All values of a row from a voxel on. */
  void
  TakeSides(Index voxel, const std::int64_t end, MedialVoxelValueSides & sides) const
  {
    for (; voxel[0] < end; ++voxel[0])
    {
      sides.Add(static_cast<double>(m_Gray.Get(voxel)), m_Object.Test(voxel));
    }
  }

  /** Voxels of a word of a row that have no background beside them. */
  Word
  GetInner(const Index & row, const std::int64_t word) const
  {
    const Word * const own = m_Object.GetRow(row[1], row[2]) + word;
    constexpr auto     last = MedialVoxelBits::BitsPerWord - 1;
    Word               inner = own[0] & (own[0] << 1 | own[-1] >> last) & (own[0] >> 1 | own[1] << last);
    for (const std::int64_t step : { -1, 1 })
    {
      inner &= m_Object.HasRow(row[1] + step, row[2]) ? m_Object.GetRow(row[1] + step, row[2])[word] : ~Word{ 0 };
      inner &= m_Object.HasRow(row[1], row[2] + step) ? m_Object.GetRow(row[1], row[2] + step)[word] : ~Word{ 0 };
    }
    return inner;
  }

  /** Of an object voxel with background beside it. */
  void
  TakeOuter(const Index & voxel, const std::uint64_t hash, Samples & samples)
  {
    if (hash % ObjectVoxelsPerLook == 0)
    {
      this->CountFaces(voxel, samples.faces);
    }
    if (samples.surfaces.Wants(hash))
    {
      this->TakeSurface(voxel, hash, samples);
    }
  }

  /** Of the object voxels of a word of a row. The depth is the distance to the nearest voxel that is background or not
   * in the image, up to a limit; a neighbor is looked at for all voxels of the word at once. */
  template <typename THashOf>
  void
  TakeMaterial(const Index &                                row,
               const std::int64_t                           word,
               const Word                                   object,
               const THashOf &                              hashOf,
               MedialVoxelRandomSample<Samples::Material> & material)
  {
    const auto forEach = [&](Word voxels, const auto & visit) {
      for (; voxels != 0; voxels &= voxels - 1)
      {
        const Index voxel{ { word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(voxels), row[1], row[2] } };
        visit(voxel, hashOf(voxel), voxels & (~voxels + 1));
      }
    };
    Word rest = 0;
    forEach(object,
            [&](const Index &, const std::uint64_t hash, const Word bit) { rest |= material.Wants(hash) ? bit : 0; });
    const auto take = [&](const Word voxels, const double depth) {
      forEach(depth >= Samples::SmallestDepth ? voxels : 0, [&](const Index & voxel, const std::uint64_t hash, Word) {
        material.Add(hash, { static_cast<double>(m_Gray.Get(voxel)), depth });
      });
    };
    for (auto neighbor = m_Neighbors.begin(); neighbor != m_Neighbors.end() && rest != 0; ++neighbor)
    {
      const auto & [x, y, z] = neighbor->offset;
      m_Checker.Count();
      const Word moved = m_Object.HasRow(row[1] + y, row[2] + z)
                           ? m_Object.Extract(word * MedialVoxelBits::BitsPerWord + x, row[1] + y, row[2] + z)
                           : 0;
      take(rest & ~moved, neighbor->distance);
      rest &= moved;
    }
    take(rest, Samples::LargestDepth);
  }

  void
  CountFaces(const Index & voxel, Samples::Faces & faces)
  {
    m_Checker.Count();
    for (unsigned int direction = 0; direction < 6; ++direction)
    {
      const unsigned int axis = direction / 2;
      const std::int64_t outwards = direction % 2 == 0 ? -1 : 1;
      const auto         at = [&](const std::int64_t steps) {
        Index moved = voxel;
        moved[axis] += steps * outwards;
        return moved;
      };
      if (!this->IsBackground(at(1)))
      {
        continue;
      }
      const bool hasInner = m_Grid.GetVoxelBox().Contains(at(-1)) && m_Object.Test(at(-1));
      const bool hasOuter = this->IsBackground(at(2));
      if (!hasInner && !hasOuter)
      {
        continue;
      }
      const bool isSharp =
        (!hasInner || m_Gray.Get(at(-1)) == m_Gray.Get(voxel)) && (!hasOuter || m_Gray.Get(at(2)) == m_Gray.Get(at(1)));
      ++faces.all;
      faces.sharp += isSharp ? 1 : 0;
    }
  }

  bool
  IsBackground(const Index & voxel) const
  {
    return m_Grid.GetVoxelBox().Contains(voxel) && !m_Object.Test(voxel);
  }

  void
  TakeBackground(const Index & voxel, const std::uint64_t hash, Samples & samples)
  {
    Samples::Background sample{ static_cast<double>(m_Gray.Get(voxel)), NotANumber, NotANumber };
    if (!m_NearSmallMean.Test(voxel))
    {
      sample.smallMean = this->GetMean(voxel, 1);
    }
    if (!m_NearLargeMean.Test(voxel))
    {
      sample.largeMean = this->GetMean(voxel, 2);
    }
    samples.background.Add(hash, sample);
  }

  /** At the first face of a voxel that is next to background. */
  void
  TakeSurface(const Index & voxel, const std::uint64_t hash, Samples & samples)
  {
    for (unsigned int direction = 0; direction < 6; ++direction)
    {
      const unsigned int axis = direction / 2;
      Index              neighbor = voxel;
      neighbor[axis] += direction % 2 == 0 ? -1 : 1;
      if (!m_Grid.GetVoxelBox().Contains(neighbor) || m_Object.Test(neighbor))
      {
        continue;
      }
      if (!this->MayBeFlat(voxel, neighbor))
      {
        return;
      }
      m_Checker.Count(StepsOfSurface);
      Vector place;
      Vector inwards;
      Vector normal;
      for (unsigned int i = 0; i < 3; ++i)
      {
        place[i] = 0.5 * static_cast<double>(voxel[i] + neighbor[i]);
        inwards[i] = static_cast<double>(voxel[i] - neighbor[i]);
      }
      if (!m_Normals.Find(m_Gray, place, normal))
      {
        return;
      }
      if (MedialVoxelDot(normal, inwards) < 0.0)
      {
        normal = { { -normal[0], -normal[1], -normal[2] } };
      }
      if (!this->IsFlat(place, normal))
      {
        return;
      }
      Samples::Surface sample;
      m_Local.FindSamples(m_Gray, place, normal, MedialVoxelWallFit::ReachOfSurface, sample);
      samples.surfaces.Add(hash, std::move(sample));
      return;
    }
  }

  /** Whether flat sides fit along an axis: normals take long to find, and most surfaces of thin walls have none. \a
   * inside is the object voxel of a face, \a outside its other voxel. */
  bool
  MayBeFlat(const Index & inside, const Index & outside) const
  {
    for (std::int64_t steps = 2; steps <= 4; ++steps)
    {
      Index inwards;
      Index outwards;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        inwards[axis] = inside[axis] + steps * (inside[axis] - outside[axis]);
        outwards[axis] = outside[axis] + steps * (outside[axis] - inside[axis]);
      }
      if ((m_Grid.GetVoxelBox().Contains(inwards) && !m_Object.Test(inwards)) ||
          (m_Grid.GetVoxelBox().Contains(outwards) && m_Object.Test(outwards)))
      {
        return false;
      }
    }
    return true;
  }

  /** Whether the voxels along a normal are object on its side and background on the other. */
  bool
  IsFlat(const Vector & place, const Vector & normal) const
  {
    for (double distance = Samples::NearestFlat; distance <= Samples::FarthestFlat; distance += 0.5)
    {
      for (const double side : { -1.0, 1.0 })
      {
        Index voxel;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          voxel[axis] = static_cast<std::int64_t>(std::floor(place[axis] + side * distance * normal[axis] + 0.5));
        }
        if (m_Grid.GetVoxelBox().Contains(voxel) && m_Object.Test(voxel) != (side > 0.0))
        {
          return false;
        }
      }
    }
    return true;
  }

  Box
  Around(const Index & voxel, const std::int64_t reach) const
  {
    const Box own{ voxel, { { voxel[0] + 1, voxel[1] + 1, voxel[2] + 1 } } };
    return own.Expanded({ { reach, reach, reach } }).Intersection(m_Grid.GetVoxelBox());
  }

  double
  GetMean(const Index & voxel, const std::int64_t reach) const
  {
    const Box box = this->Around(voxel, reach);
    double    sum = 0.0;
    Index     at;
    for (at[2] = box.lower[2]; at[2] < box.upper[2]; ++at[2])
    {
      for (at[1] = box.lower[1]; at[1] < box.upper[1]; ++at[1])
      {
        for (at[0] = box.lower[0]; at[0] < box.upper[0]; ++at[0])
        {
          sum += static_cast<double>(m_Gray.Get(at));
        }
      }
    }
    return sum / static_cast<double>(box.NumberOfVoxels());
  }

  const MedialVoxelGrid &       m_Grid;
  const std::vector<Neighbor> & m_Neighbors;
  MedialVoxelGrayLocal          m_Local;
  MedialVoxelGrayNormals        m_Normals;
  const MedialVoxelBits &       m_Object;
  MedialVoxelBits               m_Near; // within FarFromObject of the object
  MedialVoxelBits               m_NearSmallMean;
  MedialVoxelBits               m_NearLargeMean;
  MedialVoxelBits               m_Around; // within NearObject
  const MedialVoxelGray &       m_Gray;
  MedialVoxelAbortChecker       m_Checker;
};

} // namespace

std::string
MedialVoxelScanLevels::FindProblem(const double lower, const double upper) const
{
  const std::string values = "the values of background and material are " + MedialVoxelText::FormatNumber(background) +
                             " and " + MedialVoxelText::FormatNumber(material) + "; ";
  if (!std::isfinite(background) || !std::isfinite(material))
  {
    return values + "they must be finite";
  }
  if (!(background < material || material < background))
  {
    return values + "they must differ";
  }
  const bool isBright = background < lower && lower < material && material <= upper;
  const bool isDark = background > upper && upper > material && material >= lower;
  if (isBright || isDark || (std::isinf(lower) && std::isinf(upper)))
  {
    return "";
  }
  const bool hasLower = !std::isinf(lower);
  return values + "the threshold " + MedialVoxelText::FormatNumber(hasLower ? lower : upper) +
         (hasLower && !std::isinf(upper) ? " or " + MedialVoxelText::FormatNumber(upper) : "") +
         " must be between them, and the material in the object";
}

MedialVoxelScanSurvey::MedialVoxelScanSurvey(const MedialVoxelGrid &                    grid,
                                             const double                               threshold,
                                             const std::optional<MedialVoxelScanLevels> levels)
  : m_Grid(grid)
  , m_Threshold(threshold)
  , m_Levels(levels)
{}

auto
MedialVoxelScanSurvey::Run(const Source & source) const -> Result
{
  const Box                   image = m_Grid.GetVoxelBox();
  const Boxes                 blocks = MedialVoxelChooseScanBlocks(image);
  const std::vector<Neighbor> neighbors = ListNeighbors(m_Grid);
  Samples                     samples;
  std::mutex                  mutex;
  double                      done = 0.0;
  const double all = std::accumulate(blocks.begin(), blocks.end(), 0.0, [](double sum, const Box & block) {
    return sum + static_cast<double>(block.NumberOfVoxels());
  });
  source.observe(0.0);
  const auto take = [&](const Box & part) {
    const Box       block = MedialVoxelGetScanBlock(part.lower).Intersection(image);
    const Box       box = part.Expanded({ { Margin, Margin, Margin } }).Intersection(image);
    MedialVoxelBits object;
    MedialVoxelGray gray;
    object.Reshape(box);
    gray.Frame(box, box);
    source.fill(box, object, gray);
    if (object.Any(box))
    {
      Samples ofBlock;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        ofBlock.LimitTo(samples);
      }
      BlockLook(m_Grid, neighbors, object, gray)
        .Take(part, block, MedialVoxelHash(static_cast<std::uint64_t>(image.OffsetOf(block.lower))), ofBlock);
      const std::lock_guard<std::mutex> lock(mutex);
      samples.Add(std::move(ofBlock));
    }
    const std::lock_guard<std::mutex> lock(mutex);
    done += static_cast<double>(part.NumberOfVoxels());
    source.observe(done / all);
  };
  for (std::size_t begin = 0; begin < blocks.size() && !samples.AreEnough(); begin += BlocksPerRound)
  {
    const std::size_t end = std::min(begin + BlocksPerRound, blocks.size());
    source.forEach(MedialVoxelCutScanBlocks(Boxes(blocks.data() + begin, blocks.data() + end)), take);
  }
  return MedialVoxelSummarizeScan(samples, m_Grid.GetNumberOfActiveAxes(), m_Threshold, m_Levels);
}

} // end namespace itk
