// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshElementSets_h
#define medialvoxelMeshElementSets_h

#include "MeshElements.h"
#include "MeshFormat.h"

#include <cstddef>
#include <optional>

namespace medialvoxel
{

/** \class MeshElementSets
 * \brief Writes the elements of groups, group after group. Runs of groups are kept at once; a group that is too large
 * is a run of its own, which need not be kept. */
class MeshElementSets
{
public:
  /** \param sizes numbers of elements of all groups */
  MeshElementSets(const std::vector<std::uint64_t> & sizes, std::uint64_t keptElements);

  /** How often Write() walks over all faces. */
  std::uint64_t
  GetNumberOfPasses() const
  {
    return m_Ends.size();
  }

  /** \param groupOf the group of a face; beyond the last: it is of none
   * \param makeSet of a group with elements, with Add(number) and Finish() */
  template <typename TGroupOf, typename TMakeSet>
  void
  Write(MeshReader & reader, TGroupOf && groupOf, TMakeSet && makeSet) const
  {
    std::size_t begin = 0;
    for (const std::size_t end : m_Ends)
    {
      std::vector<std::vector<std::uint64_t>> kept(end - begin);
      std::optional<decltype(makeSet(begin))> alone;
      ForEachElement(reader, [&](std::uint64_t number, const MeshFace & face, const MeshCorners &) {
        const std::size_t group = groupOf(face);
        if (group < begin || group >= end)
        {
          return;
        }
        if (kept.size() > 1)
        {
          kept[group - begin].push_back(number);
          return;
        }
        if (!alone)
        {
          alone.emplace(makeSet(group));
        }
        alone->Add(number);
      });
      if (alone)
      {
        alone->Finish();
      }
      for (std::size_t group = begin; group < end; ++group)
      {
        WriteKept(kept[group - begin], [&] { return makeSet(group); });
      }
      begin = end;
    }
  }

private:
  template <typename TMakeSet>
  static void
  WriteKept(const std::vector<std::uint64_t> & numbers, TMakeSet && makeSet)
  {
    if (!numbers.empty())
    {
      auto set = makeSet();
      for (const std::uint64_t number : numbers)
      {
        set.Add(number);
      }
      set.Finish();
    }
  }

  std::vector<std::size_t> m_Ends; ///< of the runs
};

/** The elements of each wall, from wall 1 on; none without walls. Walks over all faces once. */
std::vector<std::uint64_t>
CountElementsOfWalls(MeshReader & reader, const MeshWriteOptions & options);

/** The place of a face among them. */
inline std::size_t
GetWallGroup(const MeshFace & face)
{
  return std::size_t{ face.wall } - 1;
}

} // end namespace medialvoxel

#endif
