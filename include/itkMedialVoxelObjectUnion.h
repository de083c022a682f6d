// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectUnion_h
#define itkMedialVoxelObjectUnion_h

#include "itkMedialVoxelParameters.h"

#include <cstdint>

namespace itk
{

/** \class MedialVoxelObjectUnion
 * \brief How the cells of several objects are put together, in any order of the objects.
 *
 * Of two objects that have a cell, that for which it is medial gets it, and otherwise the smaller one. Until all
 * objects have come, the label of a cell has a mark when the cell is medial for several of them, so that it counts
 * once.
 * \ingroup MedialVoxel
 */
class MedialVoxelObjectUnion
{
public:
  /** What became of a cell. */
  struct Change
  {
    bool isTaken{ false };  ///< the object has it now
    bool isShared{ false }; ///< it is medial for a second object, after one
  };

  /** Let an object have a cell, unless another one keeps it.
   * \param label of the cell for the object, not NoObject
   * \param object its number or value, not 0
   * \param knownLabel, owner of the cell so far; both 0 at first */
  template <typename TLabel, typename TObject>
  static Change
  TakeCell(const std::uint8_t label, const TObject object, TLabel & knownLabel, TObject & owner)
  {
    const auto         known = static_cast<std::uint8_t>(knownLabel);
    const std::uint8_t mark = known & SharedMark;
    const bool         isMedial = label >= MedialVoxelLabel::MedialByBound;
    const bool         wasMedial = (known & ~SharedMark) >= MedialVoxelLabel::MedialByBound;
    const bool         areBoth = isMedial && wasMedial;
    Change             change;
    change.isShared = areBoth && mark == 0;
    change.isTaken = owner == TObject{} || (isMedial == wasMedial ? object < owner : isMedial);
    if (change.isTaken)
    {
      owner = object;
    }
    knownLabel =
      static_cast<TLabel>((change.isTaken ? label : known & ~SharedMark) | mark | (areBoth ? SharedMark : 0));
    return change;
  }

  /** The label of a cell when all objects have come. */
  template <typename TLabel>
  static TLabel
  WithoutMark(const TLabel label)
  {
    return static_cast<TLabel>(static_cast<std::uint8_t>(label) & ~SharedMark);
  }

private:
  /** A bit that no label has, in any type that holds the labels. */
  static constexpr std::uint8_t SharedMark = 4;
};

} // end namespace itk

#endif
