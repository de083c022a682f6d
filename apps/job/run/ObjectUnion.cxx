// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectUnion.h"

#include "itkMedialVoxelObjectPredicate.h"
#include "itkMedialVoxelObjectUnion.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace medialvoxel
{
namespace
{

/** Cells that a look tells to be all without a result. */
constexpr std::uint64_t CellsLookedAt = 64;

} // namespace

/** \class ObjectUnion::PassVolume
 * \brief Takes the results of passes for a volume, which those who made it create, finish and publish. */
class ObjectUnion::PassVolume : public VoxelReceiver
{
public:
  PassVolume(ObjectUnion & owner, const VolumeRequest & request, VoxelOutput & volume)
    : m_Owner(owner)
    , m_Volume(volume)
    , m_BytesPerVoxel(request.layout.GetBytes())
  {}

  void
  Begin(std::uint64_t numberOfVoxels)
  {
    m_Union.assign(numberOfVoxels * m_BytesPerVoxel, std::byte{ 0 });
  }

  void
  WriteUnion(std::uint64_t firstVoxel) const
  {
    m_Volume.Write(firstVoxel, m_Union.size() / m_BytesPerVoxel, m_Union.data());
  }

  std::uint8_t *
  GetLabels()
  {
    return reinterpret_cast<std::uint8_t *>(m_Union.data());
  }

  /** Results of a pass. */
  void
  Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data) override
  {
    if (this == m_Owner.m_Volumes.front().get())
    {
      m_Owner.TakeLabels(firstVoxel, numberOfVoxels, static_cast<const std::uint8_t *>(data));
      return;
    }
    const auto * const from = static_cast<const std::byte *>(data);
    std::byte * const  to = m_Union.data() + (firstVoxel - m_Owner.m_Piece.GetFirstVoxel()) * m_BytesPerVoxel;
    for (std::uint64_t voxel = 0; voxel < numberOfVoxels; ++voxel)
    {
      if (m_Owner.m_IsTaken[voxel] != 0)
      {
        std::memcpy(to + voxel * m_BytesPerVoxel, from + voxel * m_BytesPerVoxel, m_BytesPerVoxel);
      }
    }
  }

private:
  ObjectUnion &          m_Owner;
  VoxelOutput &          m_Volume;
  std::uint64_t          m_BytesPerVoxel;
  std::vector<std::byte> m_Union;
};

ObjectUnion::ObjectUnion(LabelMap & map, const VolumeGeometry & geometry, std::uint64_t maximumPoreSize)
  : m_Map(map)
  , m_VoxelsPerSlice(geometry.GetVoxelsPerSlice())
  , m_Piece(map, geometry, maximumPoreSize)
{}

ObjectUnion::~ObjectUnion() = default;

VoxelOutput &
ObjectUnion::AddVolume(const VolumeRequest & request, VoxelOutput & volume)
{
  m_Volumes.push_back(std::make_unique<PassVolume>(*this, request, volume));
  return *m_Volumes.back();
}

void
ObjectUnion::AddObjects(const VolumeRequest & request, VoxelOutput & volume)
{
  m_ObjectVolume = &volume;
  m_ObjectType = request.layout.pixelType;
}

void
ObjectUnion::BeginPiece(const SliceRange & piece)
{
  m_Piece.Read(piece.begin, piece.end);
  const std::uint64_t voxels = (piece.end - piece.begin) * m_VoxelsPerSlice;
  m_Objects.assign(voxels, 0);
  for (const auto & volume : m_Volumes)
  {
    volume->Begin(voxels);
  }
}

void
ObjectUnion::TakeLabels(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const std::uint8_t * labels)
{
  const std::uint64_t offset = firstVoxel - m_Piece.GetFirstVoxel();
  // Only other volumes ask for it.
  const bool keepsTaken = m_Volumes.size() > 1;
  m_IsTaken.assign(keepsTaken ? numberOfVoxels : 0, 0);
  for (std::uint64_t begin = 0; begin < numberOfVoxels; begin += CellsLookedAt)
  {
    const std::uint64_t end = std::min(begin + CellsLookedAt, numberOfVoxels);
    // Most cells have no corner in the objects of a pass.
    if (itk::MedialVoxelAllBytesAreZero(labels + begin, static_cast<std::int64_t>(end - begin)))
    {
      continue;
    }
    for (std::uint64_t cell = begin; cell < end; ++cell)
    {
      const bool isTaken = labels[cell] != 0 && this->TakeCell(offset + cell, labels[cell]);
      if (keepsTaken)
      {
        m_IsTaken[cell] = isTaken ? 1 : 0;
      }
    }
  }
}

bool
ObjectUnion::TakeCell(std::uint64_t offset, std::uint8_t label)
{
  const std::uint64_t voxel = m_Piece.GetFirstVoxel() + offset;
  const ObjectNumber  object = m_Piece.FindOwner(voxel, m_Pass);
  assert(object > 0);
  const auto change =
    itk::MedialVoxelObjectUnion::TakeCell(label, object, m_Volumes.front()->GetLabels()[offset], m_Objects[offset]);
  m_SharedCells += change.isShared ? 1 : 0;
  return change.isTaken;
}

void
ObjectUnion::FinishPiece()
{
  std::uint8_t * const labels = m_Volumes.front()->GetLabels();
  std::transform(labels, labels + m_Objects.size(), labels, itk::MedialVoxelObjectUnion::WithoutMark<std::uint8_t>);
  for (const auto & volume : m_Volumes)
  {
    volume->WriteUnion(m_Piece.GetFirstVoxel());
  }
  if (m_ObjectVolume == nullptr)
  {
    return;
  }
  DispatchPixelType(m_ObjectType, [this](auto zero) {
    using ValueType = decltype(zero);
    std::vector<ValueType> slice(m_VoxelsPerSlice);
    for (std::uint64_t voxel = 0; voxel < m_Objects.size(); voxel += slice.size())
    {
      const auto first = m_Objects.begin() + static_cast<std::ptrdiff_t>(voxel);
      std::transform(
        first, first + static_cast<std::ptrdiff_t>(slice.size()), slice.begin(), [this](ObjectNumber object) {
          return object > 0 ? static_cast<ValueType>(m_Map.GetTable().GetValue(object)) : ValueType{};
        });
      m_ObjectVolume->Write(m_Piece.GetFirstVoxel() + voxel, slice.size(), slice.data());
    }
  });
}

} // end namespace medialvoxel
