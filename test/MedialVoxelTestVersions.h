// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestVersions_h
#define MedialVoxelTestVersions_h

// Results of kernels as bytes, to compare versions of a kernel, or classes that are compiled in two ways.

#include "itkMedialVoxelGray.h"
#include "itkMedialVoxelGrayLocal.h"
#include "itkMedialVoxelRowPass.h"
#include "itkMedialVoxelSquaredLengths.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace MedialVoxelTest
{
class Bytes
{
public:
  /** Of types without gaps. */
  template <typename TValue>
  void
  Add(const TValue * const values, const std::size_t number)
  {
    const auto * const bytes = reinterpret_cast<const unsigned char *>(values);
    m_Bytes.insert(m_Bytes.end(), bytes, bytes + number * sizeof(TValue));
  }

  template <typename TValue>
  void
  Add(const std::vector<TValue> & values)
  {
    this->Add(values.data(), values.size());
  }

  const std::vector<unsigned char> &
  Get() const
  {
    return m_Bytes;
  }

private:
  std::vector<unsigned char> m_Bytes;
};

/** Of a record. */
template <typename TRecord>
Bytes
BytesOf(const TRecord & record)
{
  Bytes bytes;
  record(bytes);
  return bytes;
}

/** Equal bytes, and more than a few. */
inline ::testing::AssertionResult
AreSame(const Bytes & actual, const Bytes & expected)
{
  constexpr std::size_t few = 1000;
  const auto &          a = actual.Get();
  const auto &          b = expected.Get();
  if (a.size() != b.size() || a.size() < few)
  {
    return ::testing::AssertionFailure() << a.size() << " and " << b.size() << " bytes";
  }
  const auto first = std::mismatch(a.begin(), a.end(), b.begin()).first;
  if (first != a.end())
  {
    return ::testing::AssertionFailure() << "byte " << first - a.begin() << " of " << a.size() << " differs";
  }
  return ::testing::AssertionSuccess();
}

/** Sums of fits to noisy samples, of any number. */
template <typename TFitSums>
void
RecordFits(Bytes & bytes)
{
  std::mt19937                     random(31);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial)
  {
    itk::MedialVoxelGrayLocal::Samples samples;
    for (auto number = random() % 150; number > 0; --number)
    {
      const double along = 16.0 * uniform(random) - 8.0;
      const double weight = uniform(random);
      samples.Add(along, weight, 1.5 * uniform(random) - 0.2);
    }
    const double   place = uniform(random) - 0.5;
    const double   thickness = 12.0 * uniform(random);
    const double   blur = 0.05 + uniform(random);
    const TFitSums sums(samples, place, 1.0 + 7.0 * uniform(random));
    const auto     wall = sums.SumWall(place, thickness, blur);
    const auto     surface = sums.SumSurface(place, blur);
    const auto     misfit = sums.SumMisfit(place, thickness, blur, 4.0 * uniform(random));
    bytes.Add(&wall, 1);
    bytes.Add(&surface, 1);
    bytes.Add(&misfit, 1);
  }
}

/** Normals at random places of noise, of images with and without all axes. */
template <typename TGrayNormals>
void
RecordNormals(Bytes & bytes)
{
  std::mt19937                     random(32);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  for (const itk::MedialVoxelIndex & size :
       { itk::MedialVoxelIndex{ { 45, 41, 38 } }, itk::MedialVoxelIndex{ { 60, 1, 47 } } })
  {
    const itk::MedialVoxelGrid grid(size, { { 1.0, 1.0, 1.0 } });
    const auto                 box = grid.GetVoxelBox();
    itk::MedialVoxelGray       gray;
    gray.Frame(box, box);
    for (std::int64_t row = 0; row < size[1] * size[2]; ++row)
    {
      std::generate_n(gray.GetRow(row % size[1], row / size[1]), size[0], [&] {
        return static_cast<float>(200.0 * uniform(random));
      });
    }
    TGrayNormals normals(grid, 20.0, 180.0);
    for (int trial = 0; trial < 200; ++trial)
    {
      itk::MedialVoxelVector3 place;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        place[axis] = uniform(random) * static_cast<double>(size[axis] - 1);
      }
      itk::MedialVoxelVector3 normal;
      ASSERT_TRUE(normals.Find(gray, place, normal));
      bytes.Add(&normal, 1);
    }
  }
}

/** Smallest sums of random columns. */
template <typename TColumnPass>
void
RecordColumns(Bytes & bytes)
{
  constexpr std::int32_t none = itk::MedialVoxelSquaredLengths::None;
  std::mt19937           random(33);
  for (int trial = 0; trial < 300; ++trial)
  {
    const auto                length = static_cast<std::int64_t>(1 + random() % 150);
    const auto                first = static_cast<std::int64_t>(random()) % length;
    const auto                number = 1 + static_cast<std::int64_t>(random()) % (length - first);
    const unsigned int        gap = 1 + random() % 40;
    std::vector<std::int32_t> costs(static_cast<std::size_t>(length * TColumnPass::Columns));
    std::generate(costs.begin(), costs.end(), [&] {
      return random() % gap == 0 ? static_cast<std::int32_t>(random() % 3000) : none;
    });
    std::vector<std::int32_t> sums(static_cast<std::size_t>(TColumnPass::GetResultRows(number) * TColumnPass::Columns));
    TColumnPass().Search(costs.data(), length, first, number, sums.data());
    bytes.Add(sums.data(), static_cast<std::size_t>(number * TColumnPass::Columns));
  }
}

/** Smallest keys of random rows, of all blocks that are inside. */
template <typename TRowPass>
void
RecordRows(Bytes & bytes)
{
  using Key = itk::MedialVoxelSiteKey;
  std::mt19937 random(34);
  for (int trial = 0; trial < 300; ++trial)
  {
    const bool                alongX = trial % 2 == 0;
    const auto                blocks = static_cast<std::int64_t>(1 + random() % 8);
    const std::int64_t        length = blocks * TRowPass::BlockSize;
    const unsigned int        gap = 1 + random() % 40;
    std::vector<double>       keys(static_cast<std::size_t>(length), Key::NoSite);
    std::vector<std::uint8_t> needed(static_cast<std::size_t>(blocks));
    for (double & key : keys)
    {
      if (random() % gap == 0)
      {
        key = Key::AlongZ(random() % 30) + (alongX ? Key::StepAlongY(static_cast<std::int64_t>(random() % 30)) : 0.0);
      }
    }
    std::generate(needed.begin(), needed.end(), [&] { return static_cast<std::uint8_t>(random() % 4 != 0); });
    std::vector<double> result(keys.size());
    TRowPass            pass(alongX ? TRowPass::Axis::X : TRowPass::Axis::Y);
    pass.SetLongestRow(length);
    pass.Search(keys.data(), length, 0, blocks, needed.data(), result.data());
    bytes.Add(result);
  }
}

/** Squared distances of all voxels of random volumes. */
template <typename TTransform>
void
RecordDistances(Bytes & bytes)
{
  for (unsigned int seed = 1; seed <= 3; ++seed)
  {
    const Volume                   volume = RandomBoxes({ { 70, 41, 37 } }, UnitSpacing, 25, seed);
    const auto                     image = GridOf(volume).GetVoxelBox();
    typename TTransform::Workspace workspace;
    itk::MedialVoxelSquaredLengths lengths;
    const auto                     sites = SiteBits(BoundarySites(volume, BoundarySide::Object), image);
    ASSERT_TRUE(TTransform(GridOf(volume)).Compute(sites, image, workspace, lengths).IsEmpty());
    for (std::int64_t row = 0; row < image.Extent(1) * image.Extent(2); ++row)
    {
      const itk::MedialVoxelIndex first{ { 0, row % image.Extent(1), row / image.Extent(1) } };
      bytes.Add(lengths.values.data() + lengths.box.OffsetOf(first), static_cast<std::size_t>(image.Extent(0)));
    }
  }
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestVersions_h
