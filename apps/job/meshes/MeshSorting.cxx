// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshSorting.h"

#include "ScratchFile.h"
#include "RecordBlocks.h"
#include "MeshReader.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace medialvoxel
{
namespace
{

/** Vertices or faces that are sorted at a time. */
constexpr std::uint64_t SortedAtATime = std::uint64_t{ 1 } << 14;

/** \class SortedPlaces
 * \brief The next place of each group in a sorted list. */
class SortedPlaces
{
public:
  explicit SortedPlaces(std::size_t largestGroup)
    : m_Places(largestGroup + 2, 0)
  {}

  void
  Count(std::uint32_t group)
  {
    ++m_Places[group + std::size_t{ 1 }];
  }

  /** When all are counted. \return the first place of each group, and the number of all */
  std::vector<std::uint64_t>
  Start()
  {
    std::partial_sum(m_Places.begin(), m_Places.end(), m_Places.begin());
    return m_Places;
  }

  /** The place of the next \a count records of a group. */
  std::uint64_t
  Take(std::uint32_t group, std::uint64_t count)
  {
    const std::uint64_t place = m_Places[group];
    m_Places[group] += count;
    return place;
  }

private:
  std::vector<std::uint64_t> m_Places;
};

/** Calls function(first, count) for all blocks of records. */
template <typename TFunction>
void
ForEachBlock(std::uint64_t records, const std::function<void(double)> & progress, TFunction && function)
{
  for (std::uint64_t first = 0; first < records; first += SortedAtATime)
  {
    function(first, std::min(SortedAtATime, records - first));
    progress(0.0);
  }
}

/** Writes the vertices to their places. \return their new numbers, in a file */
std::unique_ptr<ScratchFile>
SortVertices(const MeshSpool &                   from,
             MeshSpool &                         to,
             const MeshGrouping &                groupOf,
             SortedPlaces &                      places,
             const std::filesystem::path &       folder,
             const std::function<void(double)> & progress)
{
  auto                           numbers = std::make_unique<ScratchFile>(folder);
  std::vector<MeshSpool::Vertex> vertices;
  ForEachBlock(from.GetNumberOfVertices(), progress, [&](std::uint64_t first, std::uint64_t count) {
    from.ReadVertices(first, count, vertices);
    std::map<std::uint32_t, std::vector<MeshSpool::Vertex>> sorted;
    for (const MeshSpool::Vertex & vertex : vertices)
    {
      sorted[groupOf(vertex)].push_back(vertex);
    }
    std::map<std::uint32_t, std::uint64_t> next;
    for (const auto & [group, ofGroup] : sorted)
    {
      next[group] = places.Take(group, ofGroup.size());
      to.PutVertices(next[group], ofGroup);
    }
    std::vector<std::uint64_t> ofBlock(count);
    std::transform(vertices.begin(), vertices.end(), ofBlock.begin(), [&](const MeshSpool::Vertex & vertex) {
      return next[groupOf(vertex)]++;
    });
    numbers->WriteAt(first * sizeof(std::uint64_t), ofBlock.data(), count * sizeof(std::uint64_t));
  });
  return numbers;
}

/** Writes the faces to their places, with the new numbers of their vertices. */
void
SortFaces(const MeshSpool &                   from,
          MeshSpool &                         to,
          const MeshGrouping &                groupOf,
          SortedPlaces &                      places,
          const ScratchFile &                 numbers,
          const std::function<void(double)> & progress)
{
  MeshReader                  reader(from, {});
  RecordBlocks<std::uint64_t> newNumbers(
    from.GetNumberOfVertices(), [&numbers](std::uint64_t first, std::uint64_t count, auto & records) {
      records.resize(count);
      numbers.ReadAt(first * sizeof(std::uint64_t), records.data(), count * sizeof(std::uint64_t));
    });
  std::vector<MeshFace> faces;
  ForEachBlock(from.GetNumberOfFaces(), progress, [&](std::uint64_t first, std::uint64_t count) {
    from.ReadFaces(first, count, faces);
    std::map<std::uint32_t, std::vector<MeshFace>> sorted;
    for (MeshFace & face : faces)
    {
      const std::uint32_t group = groupOf(reader.GetVertex(face.vertices[0]));
      const auto          end = face.vertices.begin() + face.numberOfVertices;
      std::transform(face.vertices.begin(), end, face.vertices.begin(), [&](std::uint64_t vertex) {
        return newNumbers.Get(vertex);
      });
      sorted[group].push_back(face);
    }
    for (const auto & [group, ofGroup] : sorted)
    {
      to.PutFaces(places.Take(group, ofGroup.size()), ofGroup);
    }
  });
}

} // namespace

GroupedMesh
SortMesh(std::unique_ptr<MeshSpool>          surface,
         const MeshGrouping &                groupOf,
         const std::size_t                   largestGroup,
         const std::filesystem::path &       scratchFolder,
         const std::function<void(double)> & progress)
{
  SortedPlaces vertexPlaces(largestGroup);
  SortedPlaces facePlaces(largestGroup);
  MeshReader   reader(*surface, {});
  reader.ForEachVertex([&](std::uint64_t, const auto & vertex) { vertexPlaces.Count(groupOf(vertex)); });
  reader.ForEachFace(
    [&](std::uint64_t, const MeshFace & face) { facePlaces.Count(groupOf(reader.GetVertex(face.vertices[0]))); });
  GroupedMesh grouped;
  grouped.firstVertex = vertexPlaces.Start();
  grouped.firstFace = facePlaces.Start();
  grouped.surface = std::make_unique<MeshSpool>(scratchFolder, surface->GetPrecision());
  const auto numbers = SortVertices(*surface, *grouped.surface, groupOf, vertexPlaces, scratchFolder, progress);
  SortFaces(*surface, *grouped.surface, groupOf, facePlaces, *numbers, progress);
  return grouped;
}

} // end namespace medialvoxel
