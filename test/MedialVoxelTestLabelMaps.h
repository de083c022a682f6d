// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestLabelMaps_h
#define MedialVoxelTestLabelMaps_h

// Random label maps, and the results of single objects put together cell by cell.

#include "MedialVoxelTestRuns.h"

#include "itkMedialVoxelObjectsImageFilter.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace MedialVoxelTest
{
template <typename TPixel, unsigned int D>
using ObjectFilter = itk::MedialVoxelObjectsImageFilter<itk::Image<TPixel, D>>;

/** Random numbers with ends included. */
class Dice
{
public:
  explicit Dice(const unsigned int seed)
    : m_Generator(seed)
  {}

  int
  Roll(const int low, const int high)
  {
    return low + static_cast<int>(m_Generator() % static_cast<unsigned int>(high - low + 1));
  }

  template <typename TValue>
  TValue
  Choose(const std::vector<TValue> & values)
  {
    return values[static_cast<std::size_t>(this->Roll(0, static_cast<int>(values.size()) - 1))];
  }

private:
  std::mt19937 m_Generator;
};

/** Labels of the voxels of an image, x fastest. */
struct LabelVolume
{
  Index3                    size;
  Vector3                   spacing;
  std::vector<std::int64_t> labels;

  std::set<std::int64_t>
  GetLabels() const
  {
    std::set<std::int64_t> found(labels.begin(), labels.end());
    found.erase(0);
    return found;
  }

  /** The object with a label. */
  Volume
  Select(const std::int64_t label) const
  {
    Volume volume;
    volume.size = size;
    volume.spacing = spacing;
    for (const std::int64_t value : labels)
    {
      volume.object.push_back(value == label ? 1 : 0);
    }
    return volume;
  }
};

template <typename TImage>
typename TImage::Pointer
MakeLabelImage(const LabelVolume & map, const itk::IndexValueType start = 0)
{
  Volume shape;
  shape.size = map.size;
  shape.spacing = map.spacing;
  shape.object.assign(map.labels.size(), 0);
  const auto image = MakeImage<TImage>(shape, start);
  std::transform(map.labels.begin(), map.labels.end(), image->GetBufferPointer(), [](const std::int64_t label) {
    return static_cast<typename TImage::PixelType>(label);
  });
  return image;
}

/** Full and hollow boxes, later ones over earlier ones, and dust. */
inline LabelVolume
RandomLabelBoxes(Dice & dice, const Index3 & size, const std::vector<std::int64_t> & labels)
{
  LabelVolume map{ size, UnitSpacing, {} };
  map.labels.assign(static_cast<std::size_t>(size[0]) * size[1] * size[2], 0);
  const int boxes = dice.Roll(3, 10);
  for (int box = 0; box < boxes; ++box)
  {
    Index3 lower;
    Index3 upper;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      lower[axis] = dice.Roll(-2, size[axis] - 1);
      upper[axis] = lower[axis] + dice.Roll(1, std::max(2, size[axis] / 2));
    }
    const int  wall = dice.Choose<int>({ 0, 0, 1, 2, 3 });
    const auto label = dice.Roll(0, 4) == 0 ? 0 : dice.Choose(labels);
    for (std::size_t i = 0; i < map.labels.size(); ++i)
    {
      const auto   at = static_cast<int>(i);
      const Index3 v{ { at % size[0], at / size[0] % size[1], at / size[0] / size[1] } };
      int          depth = std::numeric_limits<int>::max();
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        depth = std::min({ depth, v[axis] - lower[axis], upper[axis] - 1 - v[axis] });
      }
      if (depth >= 0 && (wall == 0 || depth < wall))
      {
        map.labels[i] = label;
      }
    }
  }
  const int grains = dice.Roll(0, 20);
  for (int grain = 0; grain < grains; ++grain)
  {
    map.labels[static_cast<std::size_t>(dice.Roll(0, static_cast<int>(map.labels.size()) - 1))] = dice.Choose(labels);
  }
  return map;
}

/** Voxels without any order. */
inline LabelVolume
RandomLabelNoise(Dice & dice, const Index3 & size, const std::vector<std::int64_t> & labels)
{
  LabelVolume map{ size, UnitSpacing, {} };
  const int   percent = dice.Choose<int>({ 3, 30, 90 });
  for (int i = 0; i < size[0] * size[1] * size[2]; ++i)
  {
    map.labels.push_back(dice.Roll(1, 100) <= percent ? dice.Choose(labels) : 0);
  }
  return map;
}

/** What a filter found for one object, or for several that were put together. */
struct CellResults
{
  std::vector<unsigned char> labels;
  std::vector<std::int64_t>  objects;
  std::vector<float>         thicknesses;
  std::size_t                sharedCells{ 0 };
};

/** The definition: a cell has the smallest object for which it is medial, else for which it is added, else the smallest
 * one. */
inline CellResults
PutTogether(const std::map<std::int64_t, CellResults> & single, const std::size_t numberOfCells)
{
  CellResults all;
  all.labels.assign(numberOfCells, 0);
  all.objects.assign(numberOfCells, 0);
  all.thicknesses.assign(numberOfCells, 0.0f);
  for (std::size_t cell = 0; cell < numberOfCells; ++cell)
  {
    // Objects for which the cell is not medial, medial and added.
    std::array<std::vector<std::int64_t>, 3> candidates;
    for (const auto & [object, results] : single)
    {
      const int label = results.labels[cell];
      if (label >= 1)
      {
        candidates[label == 4 ? 2 : label >= 2 ? 1 : 0].push_back(object);
      }
    }
    const auto & [others, medial, added] = candidates;
    all.sharedCells += medial.size() + added.size() > 1 ? 1 : 0;
    if (!others.empty() || !medial.empty() || !added.empty())
    {
      all.objects[cell] = (!medial.empty() ? medial : !added.empty() ? added : others).front();
      all.labels[cell] = single.at(all.objects[cell]).labels[cell];
      all.thicknesses[cell] = single.at(all.objects[cell]).thicknesses[cell];
    }
  }
  return all;
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestLabelMaps_h
