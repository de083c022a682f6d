// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Which pixel values are object (definition 1), on both filters.

#include "itkMedialVoxelFilterAccess.h"
#include "itkMedialVoxelObjectPredicate.h"

#include "MedialVoxelTestRuns.h"

#include <cmath>
#include <numeric>
#include <type_traits>

namespace
{
using namespace MedialVoxelTest;

/** An image that runs through the given values along x, in every row. */
template <typename TPixel>
typename itk::Image<TPixel, 2>::Pointer
ImageOfValues(const std::vector<TPixel> & values)
{
  const Volume volume({ { static_cast<int>(values.size()), 3, 1 } }, UnitSpacing);
  auto         image = MakeImage<itk::Image<TPixel, 2>>(volume);
  itk::ImageRegionIteratorWithIndex<itk::Image<TPixel, 2>> it(image, image->GetLargestPossibleRegion());
  for (std::size_t i = 0; !it.IsAtEnd(); ++it, ++i)
  {
    it.Set(values[i % values.size()]);
  }
  return image;
}

/** The number of object voxels of one row, by both filters: the sign of the distance tells in the vector filter. */
template <typename TPixel, typename TConfigure>
std::string
ObjectOf(const std::vector<TPixel> & values, TConfigure && configure)
{
  using ImageType = itk::Image<TPixel, 2>;
  auto vectors = itk::VectorDistanceMapImageFilter<ImageType>::New();
  vectors->SetInput(ImageOfValues(values));
  vectors->SetBoundary(itk::MedialVoxelBoundary::Background);
  vectors->SetRegion(itk::MedialVoxelRegion::Inside);
  configure(vectors.GetPointer());
  vectors->Update();
  auto medial = itk::MedialVoxelImageFilter<ImageType>::New();
  medial->SetInput(ImageOfValues(values));
  configure(medial.GetPointer());
  medial->Update();
  std::string object;
  const auto  pixels = PixelsOf(vectors->GetOutput());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    object += NormOf(pixels[i]) != 0.0 ? '1' : '0'; // background and boundary have the zero vector
  }
  const auto ones = static_cast<std::size_t>(std::count(object.begin(), object.end(), '1'));
  EXPECT_EQ(medial->GetCounts().objectVoxels, 3 * ones);
  EXPECT_EQ(medial->GetCounts().notANumberVoxels, vectors->GetCounts().notANumberVoxels);
  return object;
}

const auto   Unchanged = [](auto *) {};
const double Infinity = std::numeric_limits<double>::infinity();
} // namespace

TEST(MedialVoxelObject, IsWhatDiffersFromTheBackgroundValue)
{
  EXPECT_EQ(ObjectOf<short>({ 0, 1, -1, 0, 300 }, Unchanged), "01101");
  EXPECT_EQ(ObjectOf<short>({ 0, 1, -1, 0, -7 }, [](auto * f) { f->SetBackgroundValue(-7); }), "11110");
  EXPECT_EQ(ObjectOf<float>({ 0.0f, -0.0f, 0.5f, -2.0f }, Unchanged), "0011");
}

TEST(MedialVoxelObject, IsBetweenTheThresholdsOnceOneIsSet)
{
  const std::vector<short> values{ -5, 0, 71, 72, 73, 200, 201, 0 };
  EXPECT_EQ(ObjectOf<short>(values, [](auto * f) { f->SetLowerThreshold(72); }), "00011110");
  EXPECT_EQ(ObjectOf<short>(values, [](auto * f) { f->SetUpperThreshold(72); }), "11110001");
  EXPECT_EQ(ObjectOf<short>(values,
                            [](auto * f) {
                              f->SetLowerThreshold(72);
                              f->SetUpperThreshold(200);
                            }),
            "00011100");
  EXPECT_EQ(ObjectOf<short>(values,
                            [](auto * f) {
                              f->SetLowerThreshold(72);
                              f->SetUpperThreshold(72);
                            }),
            "00010000");
}

TEST(MedialVoxelObject, BackgroundValueIsIgnoredOnceAThresholdIsSet)
{
  EXPECT_EQ(ObjectOf<short>({ 0, 80, 90, 0 },
                            [](auto * f) {
                              f->SetBackgroundValue(90);
                              f->SetLowerThreshold(72);
                            }),
            "0110");
}

TEST(MedialVoxelObject, ReturnsToTheBackgroundValueWhenThresholdsAreUnset)
{
  EXPECT_EQ(ObjectOf<short>({ 0, 80, 3, 0 },
                            [](auto * f) {
                              f->SetLowerThreshold(72);
                              EXPECT_TRUE(f->GetUseThresholds());
                              f->UnsetThresholds();
                              EXPECT_FALSE(f->GetUseThresholds());
                            }),
            "0110");
}

TEST(MedialVoxelObject, IsOneValueExactly)
{
  const auto is = [](auto value) { return [value](auto * f) { f->SetObjectValue(value); }; };
  EXPECT_EQ(ObjectOf<short>({ 0, 7, 8, -7, 7 }, is(short{ 7 })), "01001");
  EXPECT_EQ(ObjectOf<short>({ 0, 7, 8, -7, 0 }, is(short{ 0 })), "10001");
  EXPECT_EQ(ObjectOf<float>({ 0.5f, 0.0f, -0.0f, NAN }, is(0.0f)), "0110");
  constexpr std::uint64_t large = (std::uint64_t{ 1 } << 53) + 1;
  EXPECT_EQ(ObjectOf<std::uint64_t>({ large - 1, large, large + 1, ~std::uint64_t{ 0 } }, is(large)), "0100");
  EXPECT_EQ(ObjectOf<std::uint64_t>({ large - 1, large, ~std::uint64_t{ 0 } }, is(~std::uint64_t{ 0 })), "001");
  constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(ObjectOf<std::int64_t>({ least, least + 1, 0, -1 }, is(least)), "1000");
}

TEST(MedialVoxelObject, TheLastWordOnTheObjectCounts)
{
  const std::vector<short> values{ 0, 7, 8, 9 };
  EXPECT_EQ(ObjectOf<short>(values,
                            [](auto * f) {
                              f->SetObjectValue(7);
                              f->SetLowerThreshold(8);
                            }),
            "0011");
  EXPECT_EQ(ObjectOf<short>(values,
                            [](auto * f) {
                              f->SetLowerThreshold(8);
                              f->SetObjectValue(7);
                            }),
            "0100");
  EXPECT_EQ(ObjectOf<short>(values,
                            [](auto * f) {
                              f->SetObjectValue(7);
                              f->UnsetThresholds();
                            }),
            "0111");
}

TEST(MedialVoxelObject, LimitsCompareAsNumbers)
{
  const std::vector<unsigned char> values{ 0, 72, 73, 255, 0 };
  EXPECT_EQ(ObjectOf<unsigned char>(values, [](auto * f) { f->SetLowerThreshold(72.5); }), "00110");
  EXPECT_EQ(ObjectOf<unsigned char>(values, [](auto * f) { f->SetUpperThreshold(72.5); }), "11001");
  EXPECT_EQ(ObjectOf<unsigned char>(values, [](auto * f) { f->SetUpperThreshold(-0.5); }), "00000");
  EXPECT_EQ(ObjectOf<unsigned char>(values, [](auto * f) { f->SetLowerThreshold(255.5); }), "00000");
  EXPECT_EQ(ObjectOf<unsigned char>(values, [](auto * f) { f->SetLowerThreshold(328.0); }), "00000"); // 328 - 256 = 72
  EXPECT_EQ(ObjectOf<unsigned char>(values,
                                    [](auto * f) {
                                      f->SetLowerThreshold(-184.0); // 256 - 184 = 72
                                      f->SetUpperThreshold(1e300);
                                    }),
            "11111"); // no boundary: all vectors are NaN, which is not zero
  EXPECT_EQ(ObjectOf<unsigned char>(values,
                                    [](auto * f) {
                                      f->SetLowerThreshold(72.2);
                                      f->SetUpperThreshold(72.8);
                                    }),
            "00000");
}

TEST(MedialVoxelObject, EveryVoxelIsObjectWithAWideRange)
{
  using ImageType = itk::Image<unsigned char, 2>;
  auto filter = itk::MedialVoxelImageFilter<ImageType>::New();
  filter->SetInput(ImageOfValues<unsigned char>({ 0, 72, 73, 255, 0 }));
  filter->SetLowerThreshold(-184.0);
  filter->SetUpperThreshold(1e300);
  filter->Update();
  EXPECT_EQ(filter->GetCounts().objectVoxels, 15u);
  filter->SetLowerThreshold(-Infinity);
  filter->SetUpperThreshold(Infinity);
  filter->Update();
  EXPECT_EQ(filter->GetCounts().objectVoxels, 15u);
}

TEST(MedialVoxelObject, LimitsOfWideTypesAreExact)
{
  using Limits = std::numeric_limits<std::int64_t>;
  const std::vector<std::int64_t> values{ Limits::min(), Limits::min() + 1, 0, Limits::max() - 1, Limits::max() };
  EXPECT_EQ(ObjectOf<std::int64_t>(values, [](auto * f) { f->SetLowerThreshold(9223372036854775808.0); }), "00000");
  EXPECT_EQ(ObjectOf<std::int64_t>(values, [](auto * f) { f->SetLowerThreshold(9223372036854774784.0); }), "00011");
  EXPECT_EQ(ObjectOf<std::int64_t>(values, [](auto * f) { f->SetUpperThreshold(-9223372036854775808.0); }), "10000");
  const std::vector<std::uint64_t> unsignedValues{ 0, 1, std::numeric_limits<std::uint64_t>::max() };
  EXPECT_EQ(ObjectOf<std::uint64_t>(unsignedValues, [](auto * f) { f->SetLowerThreshold(18446744073709549568.0); }),
            "001");
}

namespace
{
/** Every limit against every value, as whole numbers, whatever a double can hold. */
template <typename TPixel>
void
ExpectExactLimits(const std::vector<TPixel> & values, const std::vector<TPixel> & limits)
{
  for (const TPixel limit : limits)
  {
    std::string above;
    std::string below;
    for (const TPixel value : values)
    {
      above += value >= limit ? '1' : '0';
      below += value <= limit ? '1' : '0';
    }
    EXPECT_EQ(ObjectOf<TPixel>(values, [limit](auto * f) { f->SetLowerThreshold(limit); }), above) << limit;
    EXPECT_EQ(ObjectOf<TPixel>(values, [limit](auto * f) { f->SetUpperThreshold(limit); }), below) << limit;
    const auto parsed = itk::MedialVoxelExactNumber::Parse(std::to_string(limit));
    ASSERT_TRUE(parsed);
    EXPECT_EQ(*parsed, itk::MedialVoxelExactNumber(limit));
    EXPECT_EQ(parsed->Format(), itk::MedialVoxelExactNumber(limit).Format());
    EXPECT_EQ(*itk::MedialVoxelExactNumber::Parse(parsed->Format()), *parsed);
  }
}

/** Whole numbers around those at which doubles get sparser, and where they end. */
template <typename TPixel>
std::vector<TPixel>
NumbersAroundPowersOfTwo()
{
  using Limits = std::numeric_limits<TPixel>;
  std::vector<TPixel> numbers{ 0, 1, Limits::max(), Limits::lowest() };
  for (const int power : { 31, 52, 53, 54, 60, 62 })
  {
    for (const int step : { -1025, -513, -1, 0, 1, 3, 513, 1025 })
    {
      numbers.push_back(static_cast<TPixel>((TPixel{ 1 } << power) + static_cast<TPixel>(step)));
      numbers.push_back(static_cast<TPixel>(Limits::max() - static_cast<TPixel>(step + 2000)));
      numbers.push_back(static_cast<TPixel>(Limits::lowest() + static_cast<TPixel>(step + 2000)));
    }
  }
  return numbers;
}
} // namespace

TEST(MedialVoxelObject, IntegersOf64BitsAreExactLimits)
{
  const auto signedNumbers = NumbersAroundPowersOfTwo<std::int64_t>();
  ExpectExactLimits<std::int64_t>({ 0,
                                    (std::int64_t{ 1 } << 53) - 1,
                                    std::int64_t{ 1 } << 53,
                                    (std::int64_t{ 1 } << 53) + 1,
                                    (std::int64_t{ 1 } << 53) + 2,
                                    std::numeric_limits<std::int64_t>::max() - 1,
                                    std::numeric_limits<std::int64_t>::max(),
                                    0 },
                                  { (std::int64_t{ 1 } << 53) + 1, std::numeric_limits<std::int64_t>::max() });
  const std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  ExpectExactLimits<std::uint64_t>({ 0, last - 2049, last - 1, last, 0 }, { last - 1, last, last - 1024 });
  for (const std::int64_t limit : signedNumbers)
  {
    const itk::MedialVoxelExactNumber exact(limit);
    EXPECT_EQ(exact.GetFirstValue<std::int64_t>(), limit);
    EXPECT_EQ(exact.GetLastValue<std::int64_t>(), limit);
    for (const std::int64_t other : signedNumbers)
    {
      EXPECT_EQ(exact.IsAbove(other), limit > other) << limit << ' ' << other;
      EXPECT_EQ(exact == itk::MedialVoxelExactNumber(other), limit == other) << limit << ' ' << other;
    }
  }
  for (const std::uint64_t limit : NumbersAroundPowersOfTwo<std::uint64_t>())
  {
    EXPECT_EQ(itk::MedialVoxelExactNumber(limit).GetFirstValue<std::uint64_t>(), limit);
    EXPECT_EQ(itk::MedialVoxelExactNumber(limit).GetLastValue<std::uint64_t>(), limit);
    EXPECT_EQ(itk::MedialVoxelExactNumber::Parse(std::to_string(limit)), itk::MedialVoxelExactNumber(limit)) << limit;
  }
}

TEST(MedialVoxelObject, LimitsBetweenDoublesHoldForRealPixelsToo)
{
  const double              at = 9007199254740992.0; // 2^53, after which come +2, +4
  const std::vector<double> values{ 0.0, at, at + 2.0, at + 4.0, 0.0 };
  const std::int64_t        between = (std::int64_t{ 1 } << 53) + 3;
  EXPECT_EQ(ObjectOf<double>(values, [=](auto * f) { f->SetLowerThreshold(between); }), "00010");
  EXPECT_EQ(ObjectOf<double>(values, [=](auto * f) { f->SetUpperThreshold(between); }), "11101");
  EXPECT_EQ(ObjectOf<double>(values, [=](auto * f) { f->SetLowerThreshold(between - 2); }), "00110");
  EXPECT_EQ(ObjectOf<double>(values, [=](auto * f) { f->SetUpperThreshold(between - 2); }), "11001");
}

TEST(MedialVoxelObject, LimitsReadTextAsTheNumberThatItIs)
{
  using Limit = itk::MedialVoxelExactNumber;
  EXPECT_EQ(Limit::Parse("72.5"), Limit(72.5));
  EXPECT_EQ(Limit::Parse("-72"), Limit(-72));
  EXPECT_EQ(Limit::Parse("+9007199254740993"), Limit((std::int64_t{ 1 } << 53) + 1));
  EXPECT_EQ(Limit::Parse("-9223372036854775807"), Limit(-std::numeric_limits<std::int64_t>::max()));
  EXPECT_EQ(Limit::Parse("-9223372036854775809"), Limit(-9223372036854775808.0)); // no value is that small
  EXPECT_EQ(Limit::Parse("18446744073709551616"), Limit(18446744073709551616.0)); // or that large
  EXPECT_EQ(Limit::Parse("9007199254740993.000"), Limit((std::int64_t{ 1 } << 53) + 1));
  EXPECT_EQ(Limit::Parse("1e300"), Limit(1e300));
  EXPECT_EQ(Limit::Parse("-inf"), Limit(-Infinity));
  EXPECT_TRUE(Limit::Parse("nan")->IsNotANumber());
  for (const char * text : { "", "-", "x", "72x", "9007199254740993.5", "--1", "1 2" })
  {
    EXPECT_FALSE(Limit::Parse(text)) << text;
  }
  const Limit notANumber(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(notANumber.GetFirstValue<short>());
  EXPECT_FALSE(notANumber.GetLastValue<short>());
}

TEST(MedialVoxelObject, IsCountedByTheVectorFilterToo)
{
  using ImageType = itk::Image<short, 2>;
  auto filter = itk::VectorDistanceMapImageFilter<ImageType>::New();
  filter->SetInput(ImageOfValues<short>({ 0, 80, 90, 0 }));
  for (int update = 0; update < 2; ++update)
  {
    filter->Modified();
    filter->Update();
    EXPECT_EQ(filter->GetCounts().objectVoxels, 6u);
  }
}

TEST(MedialVoxelObject, NaNIsBackgroundAndCounted)
{
  const float              nan = std::numeric_limits<float>::quiet_NaN();
  const float              inf = std::numeric_limits<float>::infinity();
  const std::vector<float> values{ 0.0f, nan, 1.0f, inf, -inf, nan };
  EXPECT_EQ(ObjectOf<float>(values, Unchanged), "001110");
  EXPECT_EQ(ObjectOf<float>(values, [](auto * f) { f->SetLowerThreshold(0.5); }), "001100");
  EXPECT_EQ(ObjectOf<float>(values, [](auto * f) { f->SetLowerThreshold(-Infinity); }), "101110");
  auto filter = itk::MedialVoxelImageFilter<itk::Image<float, 2>>::New();
  filter->SetInput(ImageOfValues<float>(values));
  filter->Update();
  EXPECT_EQ(filter->GetCounts().notANumberVoxels, 6u);
}

TEST(MedialVoxelObject, NaNIsCountedOnceHoweverTheWorkIsCut)
{
  using ImageType = itk::Image<float, 3>;
  const Volume                                 volume = RandomBoxes({ { 40, 30, 35 } }, UnitSpacing, 20, 221);
  const Volume                                 nan = RandomVolume(volume.size, UnitSpacing, 0.05, 222);
  auto                                         image = MakeImage<ImageType>(volume);
  itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetLargestPossibleRegion());
  std::vector<std::uint64_t>                   perSlice(35, 0);
  for (std::size_t i = 0; !it.IsAtEnd(); ++it, ++i)
  {
    if (nan.object[i])
    {
      it.Set(std::numeric_limits<float>::quiet_NaN());
      ++perSlice[nan.IndexAt(i)[2]];
    }
  }
  auto source = RecordingSource<ImageType>::New();
  source->SetImage(image);
  auto filter = itk::MedialVoxelImageFilter<ImageType>::New();
  filter->SetInput(source->GetOutput());
  for (const auto & cut : { std::make_pair(0u, 0u), { 5u, 1u }, { 9u, 4u }, { 40u, 100u } })
  {
    itk::MedialVoxelFilterAccess::SetTileSize(*filter, cut.first);
    itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, cut.second);
    filter->Modified();
    filter->UpdateLargestPossibleRegion();
    EXPECT_EQ(filter->GetCounts().notANumberVoxels, std::accumulate(perSlice.begin(), perSlice.end(), std::uint64_t{}));
    filter->Modified();
    filter->UpdateOutputInformation();
    std::uint64_t expected = 0;
    for (const int z : { 20, 0, 28, 9 }) // disjoint requests in no order
    {
      filter->GetOutput()->SetRequestedRegion(itk::ImageRegion<3>({ { 0, 0, z } }, { { 40, 30, 7 } }));
      filter->GetOutput()->PropagateRequestedRegion();
      filter->GetOutput()->UpdateOutputData();
      expected += std::accumulate(perSlice.begin() + z, perSlice.begin() + z + 7, std::uint64_t{});
    }
    EXPECT_EQ(filter->GetCounts().notANumberVoxels, expected) << "tile " << cut.first;
  }
}

TEST(MedialVoxelObject, RealThresholdsAreNotRounded)
{
  const float tenth = 0.1f; // slightly more than 0.1
  EXPECT_EQ(ObjectOf<float>({ 0.0f, tenth, 0.0f }, [](auto * f) { f->SetLowerThreshold(0.1); }), "010");
  EXPECT_EQ(ObjectOf<float>({ 1.0f, tenth, 0.0f }, [](auto * f) { f->SetUpperThreshold(0.1); }), "001");
}

/** Every pair of limits and every value: bits of a row are what a comparison of numbers says. */
template <typename TPixel>
void
CheckRows(const std::vector<TPixel> & values)
{
  using Limits = std::numeric_limits<TPixel>;
  const double              largest = static_cast<double>(Limits::max());
  const double              least = static_cast<double>(Limits::lowest());
  const std::vector<double> limits{ -Infinity, 2.0 * least - 1.0, least, -2.5, -1.0, 0.0,  0.1,
                                    0.5,       1.0,               7.0,   99.5, 100,  255., largest,
                                    2.0 * largest,                Infinity };
  std::vector<TPixel>       pixels;
  while (pixels.size() < 200)
  {
    pixels.insert(pixels.end(), values.begin(), values.end());
  }
  const auto check = [&](const auto & predicate, const auto & isObject, const std::int64_t first) {
    std::vector<itk::MedialVoxelBits::WordType> words(pixels.size() / 64 + 3, 0);
    itk::MedialVoxelPackRow(pixels.data(), first, static_cast<std::int64_t>(pixels.size()), predicate, words.data());
    for (std::size_t i = 0; i < 64 * words.size(); ++i)
    {
      const std::size_t pixel = i - static_cast<std::size_t>(first);
      const bool        bit = (words[i / 64] >> (i % 64) & 1) != 0;
      ASSERT_EQ(bit, pixel < pixels.size() && isObject(pixels[pixel])) << sizeof(TPixel) << ", pixel " << pixel;
    }
  };
  using Predicate = itk::MedialVoxelObjectPredicate<TPixel>;
  for (const std::int64_t first : { 0, 1, 63, 64 })
  {
    for (const double lower : limits)
    {
      for (const double upper : limits)
      {
        const auto isObject = [=](const TPixel value) {
          return static_cast<double>(value) >= lower && static_cast<double>(value) <= upper;
        };
        check(Predicate::InRange(lower, upper), isObject, first);
      }
    }
    for (const TPixel value : values)
    {
      check(Predicate::EqualTo(value), [=](const TPixel other) { return other == value; }, first);
      const auto isOther = [=](const TPixel other) { return other == other && other != value; };
      check(Predicate::DifferentFrom(value), isOther, first);
    }
  }
}

TEST(MedialVoxelObject, RowsOfEveryTypeAreComparedAsNumbers)
{
  const auto ofIntegers = [](const auto zero) {
    using Pixel = std::decay_t<decltype(zero)>;
    using Limits = std::numeric_limits<Pixel>;
    // Of 64 bits: values that are doubles, too.
    const auto most = static_cast<Pixel>(sizeof(Pixel) < 8 ? Limits::max() : Limits::max() / 2 + 1);
    CheckRows<Pixel>({ Limits::lowest(), Pixel{ 0 }, Pixel{ 1 }, Pixel{ 7 }, Pixel{ 99 }, Pixel{ 100 }, most });
  };
  ofIntegers(std::uint8_t{});
  ofIntegers(std::int8_t{});
  ofIntegers(std::uint16_t{});
  ofIntegers(std::int16_t{});
  ofIntegers(std::uint32_t{});
  ofIntegers(std::int32_t{});
  ofIntegers(std::uint64_t{});
  ofIntegers(std::int64_t{});
  const auto ofReals = [](const auto zero) {
    using Pixel = std::decay_t<decltype(zero)>;
    using Limits = std::numeric_limits<Pixel>;
    CheckRows<Pixel>({ -Limits::infinity(), Limits::lowest(), Pixel(-2.5), -zero, zero, Limits::denorm_min(), Pixel(0.1),
                       std::nextafter(Pixel(0.1), zero), Pixel(0.5), Pixel(1), Pixel(99.5), Limits::max(),
                       Limits::infinity(), Limits::quiet_NaN() });
  };
  ofReals(0.0f);
  ofReals(0.0);
}

TEST(MedialVoxelObject, BytesOfZerosAreToldFromAllOthers)
{
  std::vector<unsigned char> bytes(70, 0);
  for (std::int64_t count = 0; count <= 70; ++count)
  {
    EXPECT_TRUE(itk::MedialVoxelAreAllZero(bytes.data(), count));
    for (std::int64_t set = 0; set < 70; ++set)
    {
      bytes[static_cast<std::size_t>(set)] = 128;
      EXPECT_EQ(itk::MedialVoxelAreAllZero(bytes.data(), count), set >= count) << set << " of " << count;
      bytes[static_cast<std::size_t>(set)] = 0;
    }
  }
  const std::vector<short> last{ 0, 0, 0, 0, 256 };
  EXPECT_TRUE(itk::MedialVoxelAreAllZero(last.data(), 4));
  EXPECT_FALSE(itk::MedialVoxelAreAllZero(last.data(), 5));
}

TEST(MedialVoxelObject, LongRunsOfZerosAreWhatTheObjectSays)
{
  // Rows of several words, most of which are zero: background, object, or negative zero.
  std::vector<float> values(200, 0.0f);
  values[70] = 3.0f;
  values[131] = -0.0f;
  values[199] = std::numeric_limits<float>::quiet_NaN();
  std::string expected(200, '0');
  expected[70] = '1';
  EXPECT_EQ(ObjectOf<float>(values, Unchanged), expected);
  std::string inverse(200, '1');
  inverse[70] = inverse[199] = '0';
  EXPECT_EQ(ObjectOf<float>(values, [](auto * f) { f->SetBackgroundValue(3.0f); }), inverse);
  EXPECT_EQ(ObjectOf<float>(values, [](auto * f) { f->SetUpperThreshold(1.0); }), inverse);
}
