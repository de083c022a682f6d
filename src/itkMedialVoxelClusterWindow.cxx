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

MedialVoxelClusterWindow::MedialVoxelClusterWindow(const MedialVoxelGrid &          grid,
                                                   std::vector<MedialVoxelBoundary> kinds,
                                                   const bool                       keepsNotANumber)
  : m_Grid(grid)
  , m_Kinds(std::move(kinds))
  , m_KeepsNotANumber(keepsNotANumber)
  , m_Boundaries(m_Kinds.size())
{}

MedialVoxelBox
MedialVoxelClusterWindow::GetObjectBox(const MedialVoxelBox & sites) const
{
  return sites.Expanded(m_Grid.GetUnitMargin()).Intersection(m_Grid.GetVoxelBox());
}

template <typename TVisitor>
void
MedialVoxelClusterWindow::VisitBits(const MedialVoxelBox & sites, TVisitor && visit) const
{
  const MedialVoxelBox objectBox = this->GetObjectBox(sites);
  visit(m_Object, objectBox);
  if (m_KeepsNotANumber)
  {
    visit(m_NotANumber, objectBox);
  }
  for (const MedialVoxelBits & boundary : m_Boundaries)
  {
    visit(boundary, sites);
  }
}

std::uint64_t
MedialVoxelClusterWindow::GetBytes(const MedialVoxelBox & sites) const
{
  std::uint64_t bytes = 0;
  this->VisitBits(
    sites, [&bytes](const MedialVoxelBits &, const MedialVoxelBox & box) { bytes += MedialVoxelBits::GetBytes(box); });
  return bytes;
}

std::uint64_t
MedialVoxelClusterWindow::GetBytesToMove(const MedialVoxelBox & sites) const
{
  std::uint64_t surplus = 0;
  std::uint64_t copy = 0; // of one after the other
  this->VisitBits(sites, [&surplus, &copy](const MedialVoxelBits & bits, const MedialVoxelBox & box) {
    const std::uint64_t needed = MedialVoxelBits::GetBytes(box);
    const std::uint64_t shared = std::min(needed, bits.GetReservedBytes());
    surplus += bits.GetReservedBytes() - shared;
    copy = std::max(copy, bits.CanReframeInPlace(box) ? 0 : shared);
  });
  return surplus + copy;
}

void
MedialVoxelClusterWindow::Clear()
{
  m_Object = {};
  m_NotANumber = {};
  m_Boundaries = std::vector<MedialVoxelBits>(m_Kinds.size());
}

void
MedialVoxelClusterWindow::MoveTo(const MedialVoxelBox & sites, MedialVoxelObjectSource & source)
{
  const MedialVoxelBox objectBox = this->GetObjectBox(sites);
  const auto           parts = MedialVoxelSubtractBox(objectBox, m_Object.GetBox());
  m_Object.Reframe(objectBox);
  if (m_KeepsNotANumber)
  {
    m_NotANumber.Reframe(objectBox);
  }
  for (const MedialVoxelBox & part : parts)
  {
    source.FillObject(part, m_Object, m_KeepsNotANumber ? &m_NotANumber : nullptr);
  }
  for (std::size_t i = 0; i < m_Kinds.size(); ++i)
  {
    const auto newParts = MedialVoxelSubtractBox(sites, m_Boundaries[i].GetBox());
    m_Boundaries[i].Reframe(sites);
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
