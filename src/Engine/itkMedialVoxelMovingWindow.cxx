// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelMovingWindow.h"

#include "itkMedialVoxelBoundary.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace itk
{

std::vector<MedialVoxelBox>
MedialVoxelSubtractBox(const MedialVoxelBox & wanted, const MedialVoxelBox & present)
{
  const MedialVoxelBox shared = wanted.Intersection(present);
  if (shared.IsEmpty())
  {
    return wanted.IsEmpty() ? std::vector<MedialVoxelBox>{} : std::vector<MedialVoxelBox>{ wanted };
  }
  std::vector<MedialVoxelBox> parts;
  MedialVoxelBox              rest = wanted;
  for (unsigned int axis = 3; axis-- > 0;)
  {
    MedialVoxelBox part = rest;
    part.upper[axis] = shared.lower[axis];
    if (!part.IsEmpty())
    {
      parts.push_back(part);
    }
    part = rest;
    part.lower[axis] = shared.upper[axis];
    if (!part.IsEmpty())
    {
      parts.push_back(part);
    }
    rest.lower[axis] = shared.lower[axis];
    rest.upper[axis] = shared.upper[axis];
  }
  return parts;
}

MedialVoxelMovingWindow::MedialVoxelMovingWindow(const MedialVoxelGrid &          grid,
                                                 std::vector<MedialVoxelBoundary> kinds,
                                                 const bool                       keepsNotANumber,
                                                 const bool                       keepsGray,
                                                 const std::uint64_t              maximumPoreSize)
  : m_Grid(grid)
  , m_Kinds(std::move(kinds))
  , m_KeepsNotANumber(keepsNotANumber)
  , m_KeepsGray(keepsGray)
  , m_SmallComponents(grid, maximumPoreSize)
  , m_Boundaries(m_Kinds.size())
{}

MedialVoxelBox
MedialVoxelMovingWindow::GetObjectBox(const MedialVoxelBox & sites) const
{
  return sites.Expanded(m_Grid.GetUnitMargin()).Intersection(m_Grid.GetVoxelBox());
}

MedialVoxelBox
MedialVoxelMovingWindow::GetInputBox(const MedialVoxelBox & sites) const
{
  return this->GetObjectBox(sites).Expanded(m_SmallComponents.GetMargin()).Intersection(m_Grid.GetVoxelBox());
}

template <typename TVisitor>
void
MedialVoxelMovingWindow::VisitBits(TVisitor && visit) const
{
  MedialVoxelIndex inputMargin = m_Grid.GetUnitMargin();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    inputMargin[axis] += m_SmallComponents.GetMargin()[axis];
  }
  visit(m_Object, inputMargin);
  if (m_SmallComponents.IsOn())
  {
    visit(m_Changed, inputMargin);
  }
  if (m_KeepsNotANumber)
  {
    visit(m_NotANumber, inputMargin);
  }
  for (const MedialVoxelBits & boundary : m_Boundaries)
  {
    visit(boundary, MedialVoxelIndex{ { 0, 0, 0 } });
  }
}

std::uint64_t
MedialVoxelMovingWindow::GetBytes(const MedialVoxelBox & sites) const
{
  std::uint64_t bytes = m_SmallComponents.GetWorkspaceBytes(this->GetInputBox(sites));
  bytes += m_KeepsGray ? MedialVoxelGray::GetBytes(this->GetObjectBox(sites)) : 0;
  this->VisitBits([&](const MedialVoxelBits &, const MedialVoxelIndex & margin) {
    bytes += MedialVoxelBits::GetBytes(sites.Expanded(margin).Intersection(m_Grid.GetVoxelBox()));
  });
  return bytes;
}

std::uint64_t
MedialVoxelMovingWindow::GetBytesToMove(const MedialVoxelBox & sites, const MedialVoxelBox & room) const
{
  std::uint64_t bytes = m_SmallComponents.GetWorkspaceBytes(this->GetInputBox(sites));
  bytes += m_KeepsGray ? m_Gray.GetBytesToReframe(this->GetObjectBox(sites), this->GetObjectBox(room)) : 0;
  std::uint64_t copy = 0; // of one after the other
  this->VisitBits([&](const MedialVoxelBits & bits, const MedialVoxelIndex & margin) {
    const auto boxOf = [&](const MedialVoxelBox & box) {
      return box.Expanded(margin).Intersection(m_Grid.GetVoxelBox());
    };
    const std::uint64_t old = bits.GetReservedBytes();
    if (bits.CanReframeInPlace(boxOf(sites)))
    {
      bytes += old;
      return;
    }
    const std::uint64_t taken =
      std::max(MedialVoxelBits::GetBytes(boxOf(sites)), MedialVoxelBits::GetBytes(boxOf(room)));
    bytes += std::max(old, taken);
    copy = std::max(copy, std::min(old, taken));
  });
  return bytes + copy;
}

void
MedialVoxelMovingWindow::Clear()
{
  m_Object = {};
  m_Changed = {};
  m_FinalBox = {};
  m_NotANumber = {};
  m_Gray = {};
  m_Boundaries = std::vector<MedialVoxelBits>(m_Kinds.size());
}

void
MedialVoxelMovingWindow::MoveTo(const MedialVoxelBox &    sites,
                                const MedialVoxelBox &    room,
                                MedialVoxelObjectSource & source)
{
  this->FillObject(sites, room, source);
  this->ChangeSmallComponents(sites, source);
  for (std::size_t i = 0; i < m_Kinds.size(); ++i)
  {
    const auto newParts = MedialVoxelSubtractBox(sites, m_Boundaries[i].GetBox());
    m_Boundaries[i].Reframe(sites, room);
    for (const MedialVoxelBox & part : newParts)
    {
      MedialVoxelComputeBoundary(m_Object, m_Grid.GetVoxelBox(), m_Kinds[i], part, m_Boundaries[i]);
    }
  }
}

void
MedialVoxelMovingWindow::FillObject(const MedialVoxelBox &    sites,
                                    const MedialVoxelBox &    room,
                                    MedialVoxelObjectSource & source)
{
  const MedialVoxelBox inputBox = this->GetInputBox(sites);
  const MedialVoxelBox inputRoom = this->GetInputBox(room);
  const auto           parts = MedialVoxelSubtractBox(inputBox, m_Object.GetBox());
  const auto           grayParts = MedialVoxelSubtractBox(this->GetObjectBox(sites), m_Gray.GetBox());
  m_Object.Reframe(inputBox, inputRoom);
  if (m_SmallComponents.IsOn())
  {
    m_Changed.Reframe(inputBox, inputRoom);
  }
  if (m_KeepsNotANumber)
  {
    m_NotANumber.Reframe(inputBox, inputRoom);
  }
  if (m_KeepsGray)
  {
    m_Gray.Reframe(this->GetObjectBox(sites), this->GetObjectBox(room));
  }
  // Where both reach equally far, the source is asked once for both.
  const bool              isTogether = m_KeepsGray && !m_SmallComponents.IsOn();
  MedialVoxelBits * const notANumber = m_KeepsNotANumber ? &m_NotANumber : nullptr;
  for (const MedialVoxelBox & part : parts)
  {
    if (isTogether)
    {
      source.FillObjectAndGray(part, m_Object, notANumber, m_Gray);
    }
    else
    {
      source.FillObject(part, m_Object, notANumber);
    }
  }
  for (const MedialVoxelBox & part : grayParts)
  {
    if (m_KeepsGray && !isTogether)
    {
      source.FillGray(part, m_Gray);
    }
  }
}

void
MedialVoxelMovingWindow::ChangeSmallComponents(const MedialVoxelBox & sites, MedialVoxelObjectSource & source)
{
  const MedialVoxelBox objectBox = this->GetObjectBox(sites);
  if (m_SmallComponents.IsOn())
  {
    for (const MedialVoxelBox & part : MedialVoxelSubtractBox(objectBox, m_FinalBox))
    {
      m_SmallComponents.Change(part, m_Object, m_Changed, [&source]() { source.ThrowIfAborted(); });
    }
  }
  m_FinalBox = objectBox;
}

auto
MedialVoxelMovingWindow::CountChanges(const MedialVoxelBox & box) const -> Changes
{
  Changes              changes;
  const MedialVoxelBox counted = box.Intersection(m_Changed.GetBox());
  for (std::int64_t z = counted.lower[2]; z < counted.upper[2]; ++z)
  {
    for (std::int64_t y = counted.lower[1]; y < counted.upper[1]; ++y)
    {
      // Both have the same box.
      const auto * const changed = m_Changed.GetRow(y, z) - m_Changed.GetFirstWord();
      const auto * const object = m_Object.GetRow(y, z) - m_Object.GetFirstWord();
      for (std::int64_t word = counted.lower[0] >> 6; word <= (counted.upper[0] - 1) >> 6; ++word)
      {
        if (changed[word] != 0)
        {
          const auto bits = changed[word] & MedialVoxelBits::RangeMask(word, counted.lower[0], counted.upper[0]);
          changes.filled += static_cast<std::uint64_t>(MedialVoxelPopulationCount(bits & object[word]));
          changes.removed += static_cast<std::uint64_t>(MedialVoxelPopulationCount(bits & ~object[word]));
        }
      }
    }
  }
  return changes;
}

MedialVoxelWindow
MedialVoxelMovingWindow::GetWindow(const MedialVoxelBoundary kind) const
{
  const auto position = std::find(m_Kinds.begin(), m_Kinds.end(), kind);
  if (position == m_Kinds.end())
  {
    throw std::invalid_argument("MedialVoxelMovingWindow: this boundary is not kept");
  }
  return { &m_Object, &m_Boundaries[static_cast<std::size_t>(position - m_Kinds.begin())] };
}

} // end namespace itk
