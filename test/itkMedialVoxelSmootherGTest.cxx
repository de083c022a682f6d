// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRoughness.h"
#include "itkMedialVoxelSmoother.h"
#include "itkMedialVoxelValueSides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace
{

using Box = itk::MedialVoxelBox;
using Index = itk::MedialVoxelIndex;

template <typename TPixel>
struct Volume
{
  Index               size;
  std::vector<TPixel> pixels;

  std::size_t
  OffsetOf(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    return static_cast<std::size_t>((z * size[1] + y) * size[0] + x);
  }

  Box
  GetBox() const
  {
    return { { { 0, 0, 0 } }, size };
  }
};

template <typename TPixel>
Volume<TPixel>
MakeNoise(std::mt19937 & random, const Index & size, double low, double high, bool isMostlyEqual)
{
  Volume<TPixel> volume{ size, {} };
  const auto     number = static_cast<std::size_t>(size[0] * size[1] * size[2]);
  volume.pixels.assign(number, static_cast<TPixel>(low));
  std::uniform_real_distribution<double> value(low, high);
  std::bernoulli_distribution            isSet(isMostlyEqual ? 0.002 : 1.0);
  for (TPixel & pixel : volume.pixels)
  {
    pixel = isSet(random) ? static_cast<TPixel>(value(random)) : pixel;
  }
  return volume;
}

/** The definition: each pass takes twice the value and both neighbors, at a face the value again. */
std::vector<long double>
Step(std::vector<long double> values, const Index & size)
{
  const Index strides{ { 1, size[0], size[0] * size[1] } };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::vector<long double> before = values;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(values.size()); ++i)
    {
      const std::int64_t at = i / strides[axis] % size[axis];
      const auto         left = static_cast<std::size_t>(at > 0 ? i - strides[axis] : i);
      const auto         right = static_cast<std::size_t>(at + 1 < size[axis] ? i + strides[axis] : i);
      const auto         own = static_cast<std::size_t>(i);
      values[own] = (before[left] + before[right] + 2 * before[own]) / 4;
    }
  }
  return values;
}

std::vector<long double>
Smooth(const std::vector<long double> & values, const Index & size)
{
  const std::vector<long double> two = Step(Step(values, size), size);
  std::vector<long double>       four = Step(Step(two, size), size);
  std::transform(
    two.begin(), two.end(), four.begin(), four.begin(), [](long double b2, long double b4) { return 3 * b2 - 2 * b4; });
  return four;
}

Box
PickBox(std::mt19937 & random, const Index & size)
{
  Box box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = std::uniform_int_distribution<std::int64_t>(0, size[axis] - 1)(random);
    box.upper[axis] = std::uniform_int_distribution<std::int64_t>(box.lower[axis] + 1, size[axis])(random);
  }
  return box;
}

/** Runs the smoother on a copy of what it may read, and nothing beside it. */
template <typename TPixel, typename TRule>
itk::MedialVoxelBits
RunSmoother(const Volume<TPixel> & volume, const TRule & rule, const Box & box)
{
  const Box           input = itk::MedialVoxelSmoothingNumbers::GetInputBox(box, volume.GetBox());
  std::vector<TPixel> pixels;
  for (std::int64_t z = input.lower[2]; z < input.upper[2]; ++z)
  {
    for (std::int64_t y = input.lower[1]; y < input.upper[1]; ++y)
    {
      const auto row = volume.pixels.begin() + static_cast<std::ptrdiff_t>(volume.OffsetOf(0, y, z));
      pixels.insert(pixels.end(), row + input.lower[0], row + input.upper[0]);
    }
  }
  itk::MedialVoxelBits                    object(box);
  itk::MedialVoxelSmoother<TPixel, TRule> smoother(volume.GetBox(), rule);
  smoother.Run(pixels.data(), { 1, input.Extent(0), input.Extent(0) * input.Extent(1) }, box, object);
  return object;
}

template <typename TFunction>
void
ExpectObject(const itk::MedialVoxelBits & object, const Index & size, TFunction && isObject)
{
  const Box & box = object.GetBox();
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x)
      {
        const auto i = static_cast<std::size_t>((z * size[1] + y) * size[0] + x);
        ASSERT_EQ(object.Test({ { x, y, z } }), isObject(i)) << x << ' ' << y << ' ' << z;
      }
    }
  }
}

const std::vector<Index> Sizes = { { { 9, 8, 7 } },    { { 1, 1, 1 } }, { { 2, 3, 20 } },   { { 40, 30, 1 } },
                                   { { 70, 37, 11 } }, { { 1, 9, 5 } }, { { 1100, 3, 2 } }, { { 5, 70, 12 } } };

template <typename TPixel>
void
TestValues(double low, double high)
{
  using Rule = itk::MedialVoxelValueSmoothing<TPixel>;
  std::mt19937 random(static_cast<unsigned int>(sizeof(TPixel) * 7));
  for (const Index & size : Sizes)
  {
    for (const bool isMostlyEqual : { false, true })
    {
      const auto volume = MakeNoise<TPixel>(random, size, low, high, isMostlyEqual);
      const auto smoothed = Smooth({ volume.pixels.begin(), volume.pixels.end() }, size);
      // On a value that occurs, also as a limit between two integers.
      for (const double threshold : { (low + high) / 2, (low + high) / 2 - 0.25, low, high })
      {
        const Box box = PickBox(random, size);
        ExpectObject(RunSmoother(volume, Rule(threshold, true), box), size, [&](std::size_t i) {
          return smoothed[i] >= threshold;
        });
        ExpectObject(RunSmoother(volume, Rule(threshold, false), box), size, [&](std::size_t i) {
          return smoothed[i] <= threshold;
        });
      }
    }
  }
}

} // namespace

TEST(MedialVoxelSmoother, ValuesFollowTheDefinition)
{
  TestValues<std::uint8_t>(0, 255);
  TestValues<std::int8_t>(-128, 127);
  TestValues<std::uint16_t>(0, 65535);
  TestValues<std::int16_t>(-32768, 32767);
  TestValues<std::uint32_t>(0, 4294967295.0);
  TestValues<std::int32_t>(-2147483648.0, 2147483647.0);
  TestValues<float>(-3, 5);
  TestValues<double>(-3, 5);
}

TEST(MedialVoxelSmoother, MasksFollowTheDefinition)
{
  using Predicate = itk::MedialVoxelObjectPredicate<std::int16_t>;
  using Rule = itk::MedialVoxelMaskSmoothing<std::int16_t>;
  std::mt19937 random(5);
  for (const Index & size : Sizes)
  {
    for (const bool isMostlyEqual : { false, true })
    {
      const auto               volume = MakeNoise<std::int16_t>(random, size, 0, 4, isMostlyEqual);
      const Predicate          predicate = Predicate::InRange(1, 2);
      std::vector<long double> mask(volume.pixels.size());
      std::transform(volume.pixels.begin(), volume.pixels.end(), mask.begin(), predicate);
      const auto smoothed = Smooth(mask, size);
      const auto object = RunSmoother(volume, Rule(predicate), PickBox(random, size));
      ExpectObject(object, size, [&](std::size_t i) { return smoothed[i] >= 0.5L; });
    }
  }
}

TEST(MedialVoxelSmoother, ValuesThatAreNotFiniteCountAsTheThreshold)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();
  using Rule = itk::MedialVoxelValueSmoothing<float>;
  std::mt19937   random(6);
  Volume<float>  volume = MakeNoise<float>(random, { { 20, 21, 22 } }, 0, 1, false);
  constexpr auto threshold = 0.5;
  for (std::size_t i = 0; i < volume.pixels.size(); i += 37)
  {
    volume.pixels[i] = i % 3 == 0 ? notANumber : (i % 3 == 1 ? infinity : -infinity);
  }
  std::vector<long double> values(volume.pixels.begin(), volume.pixels.end());
  for (long double & value : values)
  {
    value = std::isfinite(value) ? value : threshold;
  }
  const auto smoothed = Smooth(values, volume.size);
  for (const bool isLower : { true, false })
  {
    ExpectObject(RunSmoother(volume, Rule(threshold, isLower), volume.GetBox()), volume.size, [&](std::size_t i) {
      return !std::isnan(volume.pixels[i]) && (isLower ? smoothed[i] >= threshold : smoothed[i] <= threshold);
    });
  }
}

TEST(MedialVoxelSmoother, EqualValuesStay)
{
  const Volume<float> volume{ { { 30, 30, 30 } }, std::vector<float>(27000, 0.1f) };
  using Rule = itk::MedialVoxelValueSmoothing<float>;
  const auto count = [&](const Rule & rule) {
    return RunSmoother(volume, rule, volume.GetBox()).Count(volume.GetBox());
  };
  EXPECT_EQ(count(Rule(0.2, true)), 0u);
  EXPECT_EQ(count(Rule(0.05, true)), 27000u);
  EXPECT_EQ(count(Rule(0.2, false)), 27000u);
}

TEST(MedialVoxelValueSides, TheLevelFollowsFromAllVoxels)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  using Predicate = itk::MedialVoxelObjectPredicate<double>;
  std::mt19937 random(8);
  for (int repetition = 0; repetition < 2000; ++repetition)
  {
    const auto          pick = [&](const int most) { return std::uniform_int_distribution<int>(0, most)(random); };
    const int           numberOfValues = 1 + pick(5);
    const int           lower = pick(6);
    const int           upper = repetition % 2 == 0 ? 6 : lower + pick(3);
    std::vector<double> values(static_cast<std::size_t>(1 + pick(12)));
    std::generate(values.begin(), values.end(), [&] { return pick(numberOfValues) * 0.5 + pick(1); });
    std::vector<double> sides[2];
    for (const double value : values)
    {
      sides[value >= lower && value <= upper ? 1 : 0].push_back(value);
    }
    bool   hasSeveral[2];
    double lowest[2];
    double highest[2];
    for (const int side : { 0, 1 })
    {
      std::sort(sides[side].begin(), sides[side].end());
      hasSeveral[side] = !sides[side].empty() && sides[side].front() < sides[side].back();
      lowest[side] = hasSeveral[side] ? sides[side].front() : 0.0;
      highest[side] = hasSeveral[side] ? sides[side].back() : 0.0;
    }
    values.insert(values.begin() + pick(1), { infinity, -infinity, std::nan("") });
    itk::MedialVoxelValueSides together;
    itk::MedialVoxelValueSides one;
    const Predicate            isObject = Predicate::InRange(lower, upper);
    const auto                 cut = static_cast<std::int64_t>(values.size() / 2);
    const auto                 size = static_cast<std::int64_t>(values.size());
    one.Add(values.data() + cut, size - cut, isObject);
    const bool wasDecided = one.AreDecided(false);
    const auto before = one.GetLevel();
    together.Add(values.data(), cut, isObject);
    together += one;
    const auto level = together.GetLevel();
    if (wasDecided)
    {
      EXPECT_EQ(level.value, before.value);
    }
    const bool isAbove = lowest[1] > highest[0];
    const bool isBelow = highest[1] < lowest[0];
    if (!hasSeveral[0] || !hasSeveral[1] || !(isAbove || isBelow))
    {
      EXPECT_FALSE(level.value);
      continue;
    }
    ASSERT_TRUE(level.value);
    EXPECT_EQ(level.objectIsAbove, isAbove);
    EXPECT_EQ(*level.value, isAbove ? (lowest[1] + highest[0]) / 2 : (highest[1] + lowest[0]) / 2);
  }
}

TEST(MedialVoxelValueSides, WholeNumbersAreDecidedSoon)
{
  using Predicate = itk::MedialVoxelObjectPredicate<short>;
  const auto decide = [](const std::vector<short> & values, const double lower, const double upper) {
    itk::MedialVoxelValueSides sides;
    sides.Add(values.data(), static_cast<std::int64_t>(values.size()), Predicate::InRange(lower, upper));
    return sides.AreDecided(true);
  };
  EXPECT_TRUE(decide({ 3, 4, 5, 6 }, 5, 9));
  EXPECT_FALSE(decide({ 3, 5, 6 }, 5, 9));
  EXPECT_FALSE(decide({ 4, 5, 6 }, 5, 9));
  EXPECT_FALSE(decide({ 3, 4, 5 }, 5, 9));
  EXPECT_TRUE(decide({ 3, 4, 5, 6 }, -9, 4));
  EXPECT_TRUE(decide({ 1, 5, 9 }, 4, 6));
  EXPECT_FALSE(decide({}, 4, 6));
}

TEST(MedialVoxelRoughness, CountsFollowTheDefinition)
{
  std::mt19937 random(7);
  for (const Index & size : { Index{ { 70, 6, 5 } },
                              Index{ { 9, 8, 7 } },
                              Index{ { 30, 20, 1 } },
                              Index{ { 1, 9, 5 } },
                              Index{ { 7, 1, 1 } },
                              Index{ { 1, 1, 1 } },
                              Index{ { 2, 2, 2 } },
                              Index{ { 64, 5, 3 } } })
  {
    const auto           volume = MakeNoise<std::uint8_t>(random, size, 0, 2.5, false);
    itk::MedialVoxelBits object(volume.GetBox());
    itk::MedialVoxelPackBox(
      volume.pixels.data(),
      { 1, size[0], size[0] * size[1] },
      volume.GetBox(),
      [](std::uint8_t value) { return value > 0; },
      object);
    const Box                 box = PickBox(random, size);
    itk::MedialVoxelRoughness expected;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(volume.pixels.size()); ++i)
    {
      const Index at{ { i % size[0], i / size[0] % size[1], i / size[0] / size[1] } };
      bool        isInside = true;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const bool isAtFace = size[axis] > 1 && (at[axis] == 0 || at[axis] + 1 == size[axis]);
        isInside = isInside && !isAtFace && at[axis] >= box.lower[axis] && at[axis] < box.upper[axis];
      }
      unsigned int others = 0;
      unsigned int neighbors = 0;
      unsigned int allOthers = 0;
      for (std::int64_t n = 0; isInside && n < 27; ++n)
      {
        const Index step{ { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 } };
        Index       there = at;
        bool        isThere = true;
        int         length = 0;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          there[axis] += step[axis];
          length += step[axis] != 0 ? 1 : 0;
          isThere = isThere && there[axis] >= 0 && there[axis] < size[axis];
        }
        const bool isOther = isThere && object.Test(there) != object.Test(at);
        allOthers += isOther ? 1 : 0;
        neighbors += isThere && length == 1 ? 1 : 0;
        others += isOther && length == 1 ? 1 : 0;
      }
      expected.borderVoxels += allOthers > 0 ? 1 : 0;
      expected.roughVoxels += allOthers > 0 && others + 1 >= neighbors ? 1 : 0;
    }
    const auto found = itk::MedialVoxelMeasureRoughness(object, box, volume.GetBox());
    EXPECT_EQ(found.borderVoxels, expected.borderVoxels);
    EXPECT_EQ(found.roughVoxels, expected.roughVoxels);
  }
}

TEST(MedialVoxelRoughness, TheThresholdIsExact)
{
  using Roughness = itk::MedialVoxelRoughness;
  EXPECT_FALSE((Roughness{ 0, 0 }).NeedsSmoothing());
  EXPECT_TRUE((Roughness{ 3, 400 }).NeedsSmoothing());
  EXPECT_FALSE((Roughness{ 3, 401 }).NeedsSmoothing());
  EXPECT_DOUBLE_EQ((Roughness{ 3, 400 }).GetRatio(), 0.0075);
  EXPECT_EQ((Roughness{ 0, 0 }).GetRatio(), 0.0);
}
