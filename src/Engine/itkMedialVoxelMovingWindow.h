// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelMovingWindow_h
#define itkMedialVoxelMovingWindow_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelEnums.h"
#include "itkMedialVoxelFeatureTransform.h"
#include "itkMedialVoxelObjectSource.h"
#include "itkMedialVoxelSmallComponents.h"
#include "itkMedialVoxelSparseBits.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \brief Boxes of the voxels of \a wanted that are not in \a present, each voxel once.
 *
 * Parts that differ along z come first, so that a slab grows by whole slices.
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT std::vector<MedialVoxelBox>
                   MedialVoxelSubtractBox(const MedialVoxelBox & wanted, const MedialVoxelBox & present);

/** \class MedialVoxelMovingWindow
 * \brief Object and boundary bits of a box that moves over the image.
 *
 * Bits that the old and the new box share are kept, or copied from another window, so the source is asked once for a
 * voxel as long as the window does not return to it. A move is done in parts, by any number of threads: begin, fill all
 * parts, change small components, mark the boundary of all parts. Changing small components extends the object bits by
 * a margin. Gray values are not extended by it; they are requested separately.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelMovingWindow
{
public:
  /** \a kinds lists the boundaries that are kept, \a keepsNotANumber keeps bits of NaN voxels, \a keepsGray keeps
   * values. MedialVoxelSmallComponents of at most \a maximumPoreSize voxels change sides. */
  MedialVoxelMovingWindow(const MedialVoxelGrid &          grid,
                          std::vector<MedialVoxelBoundary> kinds,
                          bool                             keepsNotANumber = false,
                          bool                             keepsGray = false,
                          std::uint64_t                    maximumPoreSize = 0);

  /** Voxels whose object bits decide the boundaries in \a sites. */
  MedialVoxelBox
  GetObjectBox(const MedialVoxelBox & sites) const;

  /** Voxels of the source that decide the object bits for \a sites. */
  MedialVoxelBox
  GetInputBox(const MedialVoxelBox & sites) const;

  /** Bytes of a window on \a sites. */
  std::uint64_t
  GetBytes(const MedialVoxelBox & sites) const;

  /** Largest memory of the window during and after a MoveTo() that keeps bits of the old position. */
  std::uint64_t
  GetBytesToReframe(const MedialVoxelBox & sites, const MedialVoxelBox & largestSites) const;

  /** The same for a move that copies bits of another window. */
  std::uint64_t
  GetBytesToFrame(const MedialVoxelBox & sites, const MedialVoxelBox & largestSites) const;

  /** Memory that the window has now. */
  std::uint64_t
  GetReservedBytes() const;

  /** Forget everything and give the memory back. */
  void
  Clear();

  /** Move in one thread, to know the boundaries in \a sites, a box inside the image. New memory suffices for \a
   * largestSites too. */
  void
  MoveTo(const MedialVoxelBox & sites, const MedialVoxelBox & largestSites, MedialVoxelObjectSource & source);

  /** Begin to move. Bits that \a donor has are copied; it must stay as it is meanwhile. Without a donor the window
   * keeps its own bits. */
  void
  BeginMove(const MedialVoxelBox & sites, const MedialVoxelBox & largestSites, const MedialVoxelMovingWindow * donor);

  /** Parts of the window that the source fills: at most \a number, of whole slices, or of rows where there is one
   * slice. Parts that are known already do not count.
   * \param rows that belong together; more than 1: parts have rows of all slices and begin with a multiple of it */
  std::vector<MedialVoxelBox>
  CutToFill(std::int64_t number, std::int64_t rows) const;

  /** Fill the object bits of a part from the source. Several threads may fill different parts. */
  void
  Fill(const MedialVoxelBox & part, MedialVoxelObjectSource & source);

  /** Whether small components are changed after all parts are filled, in one thread. */
  bool
  ChangesSmallComponents() const
  {
    return m_SmallComponents.IsOn();
  }
  void
  ChangeSmallComponents();

  /** Parts of the sites whose boundary is to be marked. */
  std::vector<MedialVoxelBox>
  CutToMark(std::int64_t number) const;

  /** Mark the boundary in a part. Several threads may mark different parts. */
  void
  Mark(const MedialVoxelBox & part);

  /** Bits for a boundary of the kinds listed. */
  MedialVoxelWindow
  GetWindow(MedialVoxelBoundary kind) const;

  /** Object bits: final in GetObjectBox(); around it, up to GetInputBox(), as in the source except for changed
   * components. */
  const MedialVoxelBits &
  GetObject() const
  {
    return m_Object;
  }

  /** \struct Changes
   * \brief Numbers of voxels that have changed sides.
   * \ingroup MedialVoxel
   */
  struct Changes
  {
    std::uint64_t filled{ 0 };  ///< now object
    std::uint64_t removed{ 0 }; ///< now background
  };

  /** Changes in \a box, which is within the sites. */
  Changes
  CountChanges(const MedialVoxelBox & box) const;

  /** Voxels that are not a number; empty unless they are kept. */
  const MedialVoxelBits &
  GetNotANumber() const
  {
    return m_NotANumber;
  }

  /** Values of the voxels whose object bits are known; empty unless they are kept. */
  const MedialVoxelGray &
  GetGray() const
  {
    return m_Gray;
  }

private:
  /** Calls visit(bits, boxOf) for all bits that are kept; boxOf(sites) is their box. */
  template <typename TWindow, typename TVisitor>
  static void
  VisitBits(TWindow & window, TVisitor && visit);

  /** The known voxels when a move begins, of the window itself or of its donor. */
  struct Known
  {
    const MedialVoxelMovingWindow * donor{ nullptr };
    MedialVoxelBox                  input;
    MedialVoxelBox                  gray;
    MedialVoxelBox                  sites;
  };

  /** Largest memory to change small components in a window on \a sites. */
  std::uint64_t
  GetBytesOfChanges(const MedialVoxelBox & sites) const;

  /** Copy rows of a part from the donor. */
  void
  CopyRows(const MedialVoxelBox & part);

  MedialVoxelGrid                  m_Grid;
  std::vector<MedialVoxelBoundary> m_Kinds;
  bool                             m_KeepsNotANumber;
  bool                             m_KeepsGray;
  MedialVoxelSmallComponents       m_SmallComponents;
  MedialVoxelBits                  m_Object;
  MedialVoxelSparseBits            m_Changed; // voxels that differ from the source; empty if none can
  MedialVoxelBox                   m_FinalBox;
  MedialVoxelBits                  m_NotANumber;
  MedialVoxelGray                  m_Gray;
  std::vector<MedialVoxelBits>     m_Boundaries;
  MedialVoxelBox                   m_Sites;
  Known                            m_Known;
};

} // end namespace itk

#endif
