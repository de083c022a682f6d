// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelClusterWindow.h"

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

MedialVoxelObjectSource::~MedialVoxelObjectSource() = default;

void
MedialVoxelObjectSource::FillObjectAndGray(const MedialVoxelBox &,
                                           MedialVoxelBits &,
                                           MedialVoxelBits *,
                                           MedialVoxelGray &)
{
  throw std::logic_error("MedialVoxelObjectSource: this source has no values");
}

MedialVoxelClusterWindow::MedialVoxelClusterWindow(const MedialVoxelGrid &          grid,
                                                   std::vector<MedialVoxelBoundary> kinds,
                                                   const bool                       keepsNotANumber,
                                                   const bool                       keepsGray)
  : m_Grid(grid)
  , m_Kinds(std::move(kinds))
  , m_KeepsNotANumber(keepsNotANumber)
  , m_KeepsGray(keepsGray)
  , m_Boundaries(m_Kinds.size())
{}

MedialVoxelBox
MedialVoxelClusterWindow::GetObjectBox(const MedialVoxelBox & sites) const
{
  return sites.Expanded(m_Grid.GetUnitMargin()).Intersection(m_Grid.GetVoxelBox());
}

template <typename TVisitor>
void
MedialVoxelClusterWindow::VisitBits(TVisitor && visit) const
{
  visit(m_Object, m_Grid.GetUnitMargin());
  if (m_KeepsNotANumber)
  {
    visit(m_NotANumber, m_Grid.GetUnitMargin());
  }
  for (const MedialVoxelBits & boundary : m_Boundaries)
  {
    visit(boundary, MedialVoxelIndex{ { 0, 0, 0 } });
  }
}

std::uint64_t
MedialVoxelClusterWindow::GetBytes(const MedialVoxelBox & sites) const
{
  std::uint64_t bytes = m_KeepsGray ? MedialVoxelGray::GetBytes(this->GetObjectBox(sites)) : 0;
  this->VisitBits([&](const MedialVoxelBits &, const MedialVoxelIndex & margin) {
    bytes += MedialVoxelBits::GetBytes(sites.Expanded(margin).Intersection(m_Grid.GetVoxelBox()));
  });
  return bytes;
}

std::uint64_t
MedialVoxelClusterWindow::GetBytesToMove(const MedialVoxelBox & sites, const MedialVoxelBox & room) const
{
  std::uint64_t bytes = m_KeepsGray ? m_Gray.GetBytesToReframe(this->GetObjectBox(sites), this->GetObjectBox(room)) : 0;
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
MedialVoxelClusterWindow::Clear()
{
  m_Object = {};
  m_NotANumber = {};
  m_Gray = {};
  m_Boundaries = std::vector<MedialVoxelBits>(m_Kinds.size());
}

void
MedialVoxelClusterWindow::MoveTo(const MedialVoxelBox &    sites,
                                 const MedialVoxelBox &    room,
                                 MedialVoxelObjectSource & source)
{
  const MedialVoxelBox objectBox = this->GetObjectBox(sites);
  const auto           parts = MedialVoxelSubtractBox(objectBox, m_Object.GetBox());
  const MedialVoxelBox objectRoom = this->GetObjectBox(room);
  m_Object.Reframe(objectBox, objectRoom);
  if (m_KeepsNotANumber)
  {
    m_NotANumber.Reframe(objectBox, objectRoom);
  }
  if (m_KeepsGray)
  {
    m_Gray.Reframe(objectBox, objectRoom);
  }
  MedialVoxelBits * const notANumber = m_KeepsNotANumber ? &m_NotANumber : nullptr;
  for (const MedialVoxelBox & part : parts)
  {
    if (m_KeepsGray)
    {
      source.FillObjectAndGray(part, m_Object, notANumber, m_Gray);
    }
    else
    {
      source.FillObject(part, m_Object, notANumber);
    }
  }
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

MedialVoxelWindow
MedialVoxelClusterWindow::GetWindow(const MedialVoxelBoundary kind) const
{
  const auto position = std::find(m_Kinds.begin(), m_Kinds.end(), kind);
  if (position == m_Kinds.end())
  {
    throw std::invalid_argument("MedialVoxelClusterWindow: this boundary is not kept");
  }
  return { &m_Object, &m_Boundaries[static_cast<std::size_t>(position - m_Kinds.begin())] };
}

} // end namespace itk
