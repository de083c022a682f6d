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

namespace
{

/** Cuts along the slowest axis that the box has voxels along. */
std::vector<MedialVoxelBox>
CutIntoParts(const MedialVoxelBox & box, const std::int64_t number)
{
  const unsigned int          axis = box.Extent(2) > 1 ? 2 : 1;
  const std::int64_t          length = (box.Extent(axis) + number - 1) / number;
  std::vector<MedialVoxelBox> parts;
  for (MedialVoxelBox part = box; part.lower[axis] < box.upper[axis]; part.lower[axis] = part.upper[axis])
  {
    part.upper[axis] = std::min(part.lower[axis] + length, box.upper[axis]);
    parts.push_back(part);
  }
  return parts;
}

/** Cuts along y, at multiples of \a unit. */
std::vector<MedialVoxelBox>
CutIntoRows(const MedialVoxelBox & box, const std::int64_t number, const std::int64_t unit)
{
  const std::int64_t          units = (box.Extent(1) - 1) / unit / number + 1;
  std::vector<MedialVoxelBox> parts;
  for (MedialVoxelBox part = box; part.lower[1] < box.upper[1]; part.lower[1] = part.upper[1])
  {
    part.upper[1] = std::min((part.lower[1] / unit + units) * unit, box.upper[1]);
    parts.push_back(part);
  }
  return parts;
}

void
RemoveKnownParts(std::vector<MedialVoxelBox> & parts, const MedialVoxelBox & known)
{
  const auto isKnown = [&known](const MedialVoxelBox & part) { return known.Contains(part); };
  parts.erase(std::remove_if(parts.begin(), parts.end(), isKnown), parts.end());
}

} // namespace

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

template <typename TWindow, typename TVisitor>
void
MedialVoxelMovingWindow::VisitBits(TWindow & window, TVisitor && visit)
{
  const auto inputBox = [&window](const MedialVoxelBox & sites) { return window.GetInputBox(sites); };
  const auto sitesBox = [](const MedialVoxelBox & sites) { return sites; };
  visit(window.m_Object, inputBox);
  if (window.m_KeepsNotANumber)
  {
    visit(window.m_NotANumber, inputBox);
  }
  for (auto & boundary : window.m_Boundaries)
  {
    visit(boundary, sitesBox);
  }
}

/** Of the list of a component, and of the changed voxels, which are few. */
std::uint64_t
MedialVoxelMovingWindow::GetBytesOfChanges(const MedialVoxelBox & sites) const
{
  const MedialVoxelBox box = this->GetInputBox(sites);
  return m_SmallComponents.IsOn() ? m_SmallComponents.GetBytes(box) + MedialVoxelSparseBits::GetBytes(box) : 0;
}

std::uint64_t
MedialVoxelMovingWindow::GetBytes(const MedialVoxelBox & sites) const
{
  std::uint64_t bytes = this->GetBytesOfChanges(sites);
  bytes += m_KeepsGray ? MedialVoxelGray::GetBytes(this->GetObjectBox(sites)) : 0;
  VisitBits(*this,
            [&](const MedialVoxelBits &, const auto & boxOf) { bytes += MedialVoxelBits::GetBytes(boxOf(sites)); });
  return bytes;
}

std::uint64_t
MedialVoxelMovingWindow::GetBytesToReframe(const MedialVoxelBox & sites, const MedialVoxelBox & largestSites) const
{
  std::uint64_t bytes = this->GetBytesOfChanges(sites) + m_Changed.GetReservedBytes();
  bytes += m_KeepsGray ? m_Gray.GetBytesToReframe(this->GetObjectBox(sites), this->GetObjectBox(largestSites)) : 0;
  std::uint64_t copy = 0; // of one after the other
  VisitBits(*this, [&](const MedialVoxelBits & bits, const auto & boxOf) {
    const std::uint64_t old = bits.GetReservedBytes();
    if (bits.CanReframeInPlace(boxOf(sites)))
    {
      bytes += old;
      return;
    }
    const std::uint64_t taken =
      std::max(MedialVoxelBits::GetBytes(boxOf(sites)), MedialVoxelBits::GetBytes(boxOf(largestSites)));
    bytes += std::max(old, taken);
    copy = std::max(copy, std::min(old, taken));
  });
  return bytes + copy;
}

std::uint64_t
MedialVoxelMovingWindow::GetBytesToFrame(const MedialVoxelBox & sites, const MedialVoxelBox & largestSites) const
{
  std::uint64_t bytes = this->GetBytesOfChanges(sites);
  bytes += m_KeepsGray ? m_Gray.GetBytesToFrame(this->GetObjectBox(sites), this->GetObjectBox(largestSites)) : 0;
  VisitBits(*this, [&](const MedialVoxelBits & bits, const auto & boxOf) {
    bytes += bits.GetBytesToFrame(boxOf(sites), boxOf(largestSites));
  });
  return bytes;
}

std::uint64_t
MedialVoxelMovingWindow::GetReservedBytes() const
{
  std::uint64_t bytes = m_Gray.GetReservedBytes() + m_Changed.GetReservedBytes();
  VisitBits(*this, [&bytes](const MedialVoxelBits & bits, const auto &) { bytes += bits.GetReservedBytes(); });
  return bytes;
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
  m_Sites = {};
}

void
MedialVoxelMovingWindow::MoveTo(const MedialVoxelBox &    sites,
                                const MedialVoxelBox &    largestSites,
                                MedialVoxelObjectSource & source)
{
  this->BeginMove(sites, largestSites, nullptr);
  for (const MedialVoxelBox & part : this->CutToFill(1, 1))
  {
    this->Fill(part, source);
  }
  this->ChangeSmallComponents();
  for (const MedialVoxelBox & part : this->CutToMark(1))
  {
    this->Mark(part);
  }
}

void
MedialVoxelMovingWindow::BeginMove(const MedialVoxelBox &                sites,
                                   const MedialVoxelBox &                largestSites,
                                   const MedialVoxelMovingWindow * const donor)
{
  const MedialVoxelMovingWindow & known = donor != nullptr ? *donor : *this;
  m_Known = { donor, known.m_Object.GetBox(), known.m_Gray.GetBox(), known.m_Sites };
  m_FinalBox = known.m_FinalBox;
  m_Sites = sites;
  VisitBits(*this, [&](MedialVoxelBits & bits, const auto & boxOf) {
    if (donor != nullptr)
    {
      bits.Frame(boxOf(sites), boxOf(largestSites));
    }
    else
    {
      bits.Reframe(boxOf(sites), boxOf(largestSites));
    }
  });
  if (m_KeepsGray && donor != nullptr)
  {
    m_Gray.Frame(this->GetObjectBox(sites), this->GetObjectBox(largestSites));
  }
  else if (m_KeepsGray)
  {
    m_Gray.Reframe(this->GetObjectBox(sites), this->GetObjectBox(largestSites));
  }
}

std::vector<MedialVoxelBox>
MedialVoxelMovingWindow::CutToFill(const std::int64_t number, const std::int64_t rows) const
{
  std::vector<MedialVoxelBox> parts =
    rows > 1 ? CutIntoRows(m_Object.GetBox(), number, rows) : CutIntoParts(m_Object.GetBox(), number);
  if (m_Known.donor == nullptr)
  {
    RemoveKnownParts(parts, m_KeepsGray ? m_Known.input.Intersection(m_Known.gray) : m_Known.input);
  }
  return parts;
}

std::vector<MedialVoxelBox>
MedialVoxelMovingWindow::CutToMark(const std::int64_t number) const
{
  std::vector<MedialVoxelBox> parts = CutIntoParts(m_Sites, number);
  if (m_Known.donor == nullptr)
  {
    RemoveKnownParts(parts, m_Known.sites);
  }
  return parts;
}

void
MedialVoxelMovingWindow::Fill(const MedialVoxelBox & part, MedialVoxelObjectSource & source)
{
  if (m_Known.donor != nullptr)
  {
    this->CopyRows(part);
  }
  // Where both reach equally far, the source is asked once for both.
  const bool              isTogether = m_KeepsGray && !m_SmallComponents.IsOn();
  MedialVoxelBits * const notANumber = m_KeepsNotANumber ? &m_NotANumber : nullptr;
  for (const MedialVoxelBox & box : MedialVoxelSubtractBox(part, m_Known.input))
  {
    source.Fill(box, { &m_Object, notANumber, isTogether ? &m_Gray : nullptr });
  }
  if (m_KeepsGray && !isTogether)
  {
    for (const MedialVoxelBox & box : MedialVoxelSubtractBox(part.Intersection(m_Gray.GetBox()), m_Known.gray))
    {
      source.Fill(box, { nullptr, nullptr, &m_Gray });
    }
  }
}

void
MedialVoxelMovingWindow::CopyRows(const MedialVoxelBox & part)
{
  const MedialVoxelMovingWindow & donor = *m_Known.donor;
  m_Object.CopyRows(donor.m_Object, part);
  if (m_KeepsNotANumber)
  {
    m_NotANumber.CopyRows(donor.m_NotANumber, part);
  }
  if (m_KeepsGray)
  {
    m_Gray.CopyRows(donor.m_Gray, part);
  }
}

void
MedialVoxelMovingWindow::ChangeSmallComponents()
{
  const MedialVoxelBox objectBox = this->GetObjectBox(m_Sites);
  if (m_SmallComponents.IsOn())
  {
    if (m_Known.donor != nullptr)
    {
      m_Changed.CopyFrom(m_Known.donor->m_Changed, m_Object.GetBox());
    }
    else
    {
      m_Changed.Reframe(m_Object.GetBox());
    }
    for (const MedialVoxelBox & part : MedialVoxelSubtractBox(objectBox, m_FinalBox))
    {
      m_SmallComponents.Change(part, m_Object, m_Changed);
    }
  }
  m_FinalBox = objectBox;
}

void
MedialVoxelMovingWindow::Mark(const MedialVoxelBox & part)
{
  for (std::size_t i = 0; i < m_Kinds.size(); ++i)
  {
    if (m_Known.donor != nullptr)
    {
      m_Boundaries[i].CopyRows(m_Known.donor->m_Boundaries[i], part);
    }
    for (const MedialVoxelBox & box : MedialVoxelSubtractBox(part, m_Known.sites))
    {
      MedialVoxelComputeBoundary(m_Object, m_Grid.GetVoxelBox(), m_Kinds[i], box, m_Boundaries[i]);
    }
  }
}

auto
MedialVoxelMovingWindow::CountChanges(const MedialVoxelBox & box) const -> Changes
{
  Changes changes;
  m_Changed.VisitWords(
    box,
    [&](const MedialVoxelBits::WordType bits, const std::int64_t word, const std::int64_t y, const std::int64_t z) {
      const auto object = m_Object.GetRow(y, z)[word - m_Object.GetFirstWord()];
      changes.filled += static_cast<std::uint64_t>(MedialVoxelPopulationCount(bits & object));
      changes.removed += static_cast<std::uint64_t>(MedialVoxelPopulationCount(bits & ~object));
    });
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
