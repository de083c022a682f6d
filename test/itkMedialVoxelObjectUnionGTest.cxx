// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelInput.h"
#include "itkMedialVoxelObjectUnion.h"
#include "itkMedialVoxelParameters.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace
{

/** Two rows of six voxels: two objects that touch. */
constexpr std::array<std::uint16_t, 12> Values{ { 7, 7, 7, 9, 9, 9, 7, 7, 7, 9, 9, 9 } };
const itk::MedialVoxelBox               Image{ { { 0, 0, 0 } }, { { 6, 2, 1 } } };

class MemorySource : public itk::MedialVoxelValueSource
{
public:
  itk::MedialVoxelValueType
  GetValueType() const override
  {
    return itk::MedialVoxelValueType::UInt16;
  }

  void
  WithBox(const itk::MedialVoxelBox & box, const ViewFunction & function) override
  {
    function({ Values.data() + Image.OffsetOf(box.lower), { 1, 6, 12 } });
  }
};

using Labels = std::array<std::uint8_t, 12>;

/** Of the cells of the first row; those of the second one do not exist. */
constexpr Labels OfSeven{ { 2, 1, 2, 0, 0, 0 } };
constexpr Labels OfNine{ { 0, 0, 3, 1, 2, 0 } };

itk::MedialVoxelTileResult
MakeTile(const Labels & labels)
{
  itk::MedialVoxelTileResult tile;
  tile.box = Image;
  tile.labels = labels.data();
  return tile;
}

} // namespace

TEST(MedialVoxelObjectUnion, SharedCellsAreOfTheSmallerObjectAndTilesMayComeAgain)
{
  for (const int times : { 1, 3 })
  {
    MemorySource               source;
    itk::MedialVoxelLabelInput map(source, Image, {}, 0);
    map.Prepare([](double) {});
    ASSERT_EQ(map.GetNumberOfPasses(), 2u);
    itk::MedialVoxelObjectUnion united(map, Image.upper, 0);
    std::vector<std::uint8_t>   values(12, 0);
    // Each object has its own number as the value of all its cells.
    itk::MedialVoxelObjectNumber        shown = 0;
    itk::MedialVoxelObjectUnion::Values kind{ reinterpret_cast<std::byte *>(values.data()), 1, {} };
    kind.write = [&shown](const auto & tile, void * first, const auto &) {
      std::memset(first, shown, static_cast<std::size_t>(tile.box.NumberOfVoxels()));
    };
    united.Begin(Image, { kind });
    for (unsigned int pass = 0; pass < 2; ++pass)
    {
      map.ShowPass(pass);
      shown = map.IsShown(1) ? 1 : 2;
      for (int i = 0; i < times; ++i)
      {
        united.TakeTile(MakeTile(shown == 1 ? OfSeven : OfNine));
      }
      united.FinishPass();
    }
    united.Finish();
    EXPECT_EQ(united.GetLabels(), (std::vector<std::uint8_t>{ 2, 1, 2, 1, 2, 0, 0, 0, 0, 0, 0, 0 }));
    const std::vector<itk::MedialVoxelObjectNumber> objects{ 1, 1, 1, 2, 2, 0, 0, 0, 0, 0, 0, 0 };
    EXPECT_EQ(united.GetObjects(), objects);
    EXPECT_EQ(values, std::vector<std::uint8_t>(objects.begin(), objects.end()));
    EXPECT_EQ(united.GetSums().shared, 1u);
    EXPECT_EQ(map.GetTable().GetValues(), (std::vector<std::int64_t>{ 7, 9 }));
  }
}

TEST(MedialVoxelObjectUnion, ChosenLabelsThatNoVoxelHasAreMissing)
{
  MemorySource               source;
  itk::MedialVoxelLabelInput map(source, Image, { 7, 8 }, 0);
  map.Prepare([](double) {});
  EXPECT_EQ(map.GetMissingLabels(), (std::vector<std::int64_t>{ 8 }));
  EXPECT_EQ(map.GetObjectVoxels(), (std::vector<std::uint64_t>{ 6, 6 }));
}
