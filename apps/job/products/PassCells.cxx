// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PassCells.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>
#include <system_error>

namespace medialvoxel
{

PassCells::PassCells(const std::filesystem::path & folder,
                     const itk::MedialVoxelBox &   image,
                     const unsigned int            numberOfPasses,
                     const bool                    isSparse)
  : m_Image(image)
  , m_Voxels(static_cast<std::uint64_t>(image.NumberOfVoxels()))
  , m_PerSlice(static_cast<std::uint64_t>(image.Extent(0) * image.Extent(1)))
  , m_File(folder)
{
  const std::uint64_t bytes = this->PlaceOfPass(numberOfPasses, 0);
  std::error_code     error;
  const auto          space = std::filesystem::space(folder, error);
  if (!isSparse && !error && bytes > space.free)
  {
    Fail(ExitStatus::Refused,
         "no space for the scratch file in ",
         folder.string(),
         ": the cells of ",
         numberOfPasses,
         " passes need up to ",
         FormatBytes(bytes),
         ", ",
         FormatBytes(space.free),
         " are free; with --sparse this is not checked");
  }
  m_File.SetSize(bytes);
}

void
PassCells::BeginPass(const itk::MedialVoxelBox & region, const unsigned int pass)
{
  m_Region = region;
  m_Pass = pass;
  m_Cells.assign(static_cast<std::size_t>(region.NumberOfVoxels()), 0);
}

void
PassCells::TakeTile(const itk::MedialVoxelTileResult & tile)
{
  tile.WriteTopologyCells(m_Cells.data() + m_Region.OffsetOf(tile.box.lower),
                          { 1, m_Region.Extent(0), m_Region.Extent(0) * m_Region.Extent(1) });
}

/** What is not written is zero. */
void
PassCells::FinishPass()
{
  if (std::any_of(m_Cells.begin(), m_Cells.end(), [](const std::uint16_t cell) { return cell != 0; }))
  {
    m_File.WriteAt(this->PlaceOfPass(m_Pass, static_cast<std::uint64_t>(m_Image.OffsetOf(m_Region.lower))),
                   m_Cells.data(),
                   m_Cells.size() * BytesOfPass);
  }
}

void
PassCells::ReadPass(const unsigned int pass, const std::uint64_t slice, std::vector<std::uint16_t> & cells) const
{
  cells.resize(m_PerSlice);
  m_File.ReadAt(this->PlaceOfPass(pass, slice * m_PerSlice), cells.data(), cells.size() * BytesOfPass);
}

void
PassCells::WriteUnion(const itk::MedialVoxelBox & region, const itk::MedialVoxelObjectUnion & united)
{
  const auto   first = static_cast<std::uint64_t>(m_Image.OffsetOf(region.lower));
  const auto & labels = united.GetLabels();
  const auto & objects = united.GetObjects();
  m_File.WriteAt(first, labels.data(), labels.size());
  m_File.WriteAt(this->PlaceOfObjects(first), objects.data(), objects.size() * sizeof(ObjectNumber));
}

void
PassCells::ReadUnion(const std::uint64_t         slice,
                     std::vector<std::uint8_t> & labels,
                     std::vector<ObjectNumber> & objects) const
{
  labels.resize(m_PerSlice);
  objects.resize(m_PerSlice);
  m_File.ReadAt(slice * m_PerSlice, labels.data(), labels.size());
  m_File.ReadAt(this->PlaceOfObjects(slice * m_PerSlice), objects.data(), objects.size() * sizeof(ObjectNumber));
}

void
WriteObjectValues(const std::vector<itk::MedialVoxelObjectNumber> & objects,
                  const itk::MedialVoxelLabelTable &                table,
                  const PixelType                                   type,
                  const std::size_t                                 perSlice,
                  const std::uint64_t                               firstVoxel,
                  VoxelOutput &                                     output)
{
  DispatchPixelType(type, [&](auto zero) {
    using ValueType = decltype(zero);
    const auto valueOf = [&table](const itk::MedialVoxelObjectNumber object) {
      return object > 0 ? static_cast<ValueType>(table.GetValue(object)) : ValueType{};
    };
    std::vector<ValueType> slice(perSlice);
    for (std::size_t voxel = 0; voxel < objects.size(); voxel += slice.size())
    {
      std::transform(objects.data() + voxel, objects.data() + voxel + slice.size(), slice.begin(), valueOf);
      output.Write(firstVoxel + voxel, slice.size(), slice.data());
    }
  });
}

} // end namespace medialvoxel
