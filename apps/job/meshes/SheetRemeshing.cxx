// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetRemeshing.h"

#include "Errors.h"
#include "RimRays.h"
#include "SheetCoarsening.h"
#include "MeshFormat.h"
#include "MeshReader.h"
#include "TaskRunner.h"
#include "Text.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelFoldedElements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace medialvoxel
{
namespace
{

using Index = itk::MedialVoxelSheet::Index;

/** In mean sides of the fine sheet: its allowed deviation. */
constexpr double NoiseOfSide = 0.5;

/** Vertices or faces that are handed on at a time. */
constexpr std::size_t HandedOnAtATime = std::size_t{ 1 } << 14;

/** As many as the memory allows, and one at least. */
unsigned int
GetThreads(const SheetRemeshing & remeshing)
{
  unsigned int threads = remeshing.threads;
  while (threads > 1 && GetRemeshingMemory(threads) > remeshing.memoryLimit)
  {
    --threads;
  }
  return threads;
}

double
GetArea(const MeshSpool & surface)
{
  double area = 0.0;
  MeshReader(surface, {}).ForEachFace([&](std::uint64_t, const MeshFace & face) { area += face.area; });
  return area;
}

void
CheckMemory(const MeshSpool & surface, const std::uint64_t allowed)
{
  const std::uint64_t triangles = surface.GetNumberOfTriangles() + 2 * surface.GetNumberOfQuads();
  const std::uint64_t needed = triangles * itk::MedialVoxelRemeshingBytesPerTriangle();
  if (needed > allowed)
  {
    FailForMemory("the coarsened surface has ",
                  surface.GetNumberOfFaces(),
                  " faces; giving them the element size takes ",
                  FormatBytes(needed),
                  " of memory, ",
                  FormatBytes(allowed),
                  " are left for it; allow more with --memory, or take --element-size voxel");
  }
  if (std::max(triangles, surface.GetNumberOfVertices()) >= std::numeric_limits<Index>::max() / 4)
  {
    Fail(ExitStatus::Refused,
         "the surface has ",
         surface.GetNumberOfFaces(),
         " faces, which are too many to give them an element size; take --element-size voxel");
  }
}

itk::MedialVoxelSheet
ReadSheet(MeshReader & reader, std::vector<std::uint32_t> & objects)
{
  itk::MedialVoxelSheet sheet;
  reader.ForEachVertex([&](std::uint64_t, const MeshSpool::Vertex & vertex) {
    sheet.points.push_back(vertex.position);
    sheet.thickness.push_back(vertex.thickness);
    objects.push_back(vertex.object);
  });
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    std::array<Index, 4> corners{};
    std::transform(face.vertices.begin(), face.vertices.begin() + face.numberOfVertices, corners.begin(), [](auto v) {
      return static_cast<Index>(v);
    });
    if (face.numberOfVertices == 4)
    {
      sheet.AddQuad(corners);
    }
    else
    {
      sheet.triangles.push_back({ { corners[0], corners[1], corners[2] } });
    }
  });
  sheet.RemoveDuplicates();
  return sheet;
}

/** The area of both halves along the first diagonal. */
double
GetArea(const itk::MedialVoxelRemeshedSheet & sheet, const itk::MedialVoxelShellElement & element)
{
  double area = 0.0;
  for (unsigned int k = 2; k < element.numberOfCorners; ++k)
  {
    area += itk::MedialVoxelNorm(itk::MedialVoxelTriangleNormal({ { sheet.points[element.corners[0]],
                                                                    sheet.points[element.corners[k - 1]],
                                                                    sheet.points[element.corners[k]] } })) /
            2.0;
  }
  return area;
}

/** Points in the order of their objects; the place of each in \a places. */
void
AddVertices(const itk::MedialVoxelRemeshedSheet & sheet,
            const std::vector<std::uint32_t> &    objects,
            std::vector<Index> &                  places,
            MeshSpool &                           surface)
{
  std::vector<Index> order(sheet.points.size());
  std::iota(order.begin(), order.end(), Index{ 0 });
  std::stable_sort(order.begin(), order.end(), [&](const Index a, const Index b) {
    return objects[sheet.finePoint[a]] < objects[sheet.finePoint[b]];
  });
  std::vector<MeshVertex> vertices;
  places.resize(order.size());
  for (Index place = 0; place < order.size(); ++place)
  {
    const Index point = order[place];
    places[point] = place;
    vertices.push_back({ sheet.points[point], sheet.thickness[point], objects[sheet.finePoint[point]] });
    if (vertices.size() == HandedOnAtATime)
    {
      surface.AddVertices(vertices);
      vertices.clear();
    }
  }
  surface.AddVertices(vertices);
}

void
AddFaces(itk::MedialVoxelRemeshedSheet &    sheet,
         const std::vector<std::uint32_t> & objects,
         const std::vector<Index> &         places,
         MeshSpool &                        surface)
{
  const auto objectOf = [&](const itk::MedialVoxelShellElement & element) {
    return objects[sheet.finePoint[element.corners[0]]];
  };
  std::stable_sort(sheet.elements.begin(), sheet.elements.end(), [&](const auto & a, const auto & b) {
    return objectOf(a) < objectOf(b);
  });
  std::vector<MeshFace> faces;
  for (const itk::MedialVoxelShellElement & element : sheet.elements)
  {
    MeshFace face{ {}, element.numberOfCorners, element.rimSides, element.junctionSides, GetArea(sheet, element) };
    for (unsigned int k = 0; k < element.numberOfCorners; ++k)
    {
      face.vertices[k] = places[element.corners[k]];
    }
    faces.push_back(face);
    if (faces.size() == HandedOnAtATime)
    {
      surface.AddFaces(faces);
      faces.clear();
    }
  }
  surface.AddFaces(faces);
}

} // namespace

itk::MedialVoxelElementSize
GetElementSize(const ExtractOptions & options, const VolumeGeometry & geometry)
{
  const bool                  isAutomatic = options.elementSize.kind == ElementSize::Kind::Automatic;
  const double                largest = *std::max_element(geometry.spacing.begin(), geometry.spacing.end());
  itk::MedialVoxelElementSize size;
  size.least = isAutomatic ? 2.0 * largest : options.elementSize.length;
  size.atThickness = isAutomatic;
  size.joinsTriangles = !options.meshTriangles;
  size.rimLimits = GetRimLimits(geometry);
  return size;
}

std::unique_ptr<MeshSpool>
RemeshSheet(std::unique_ptr<MeshSpool>         surface,
            const SheetRemeshing &             remeshing,
            itk::MedialVoxelRemeshingSummary & summary)
{
  const double area = GetArea(*surface);
  const double fineSide =
    std::sqrt(area / static_cast<double>(std::max<std::uint64_t>(1, surface->GetNumberOfFaces())));
  // Shares of the progress, about, of what comes before the step that is done.
  constexpr double coarsening = 0.3;
  constexpr double remeshingOfAll = 0.5;
  double           share = 0.0;
  SheetRemeshing   settings = remeshing;
  settings.progress = [&](double) { remeshing.progress(share); };
  settings.threads = GetThreads(remeshing);
  settings.size.noise = NoiseOfSide * fineSide;
  const SheetCoarsening                    fine(std::move(surface), settings);
  std::vector<itk::MedialVoxelWallLeftOut> wallsLeftOut;
  const auto                               coarse = fine.Coarsen(wallsLeftOut);
  share = coarsening;
  CheckMemory(*coarse, remeshing.memoryLimit);
  std::vector<std::uint32_t> objects;
  MeshReader                 reader(*coarse, settings.progress);
  const auto                 runTasks = MakeTaskRunner(settings.threads, [&settings] { settings.progress(0.0); });
  const auto                 tell = [&](const double fraction) {
    share = std::max(share, coarsening + remeshingOfAll * fraction);
    remeshing.progress(share);
  };
  auto               sheet = itk::MedialVoxelRemesh(ReadSheet(reader, objects), settings.size, tell, runTasks);
  auto               result = std::make_unique<MeshSpool>(remeshing.scratchFolder, coarse->GetPrecision());
  std::vector<Index> places;
  fine.FitWalls(sheet, settings.size.noise, runTasks);
  itk::MedialVoxelSplitFolded(sheet);
  fine.MeasureDistances(sheet, sheet.summary);
  sheet.summary.fineArea = area;
  sheet.summary.walls += wallsLeftOut.size();
  itk::MedialVoxelAddWallsLeftOut(wallsLeftOut, sheet.summary.wallsLeftOut);
  AddVertices(sheet, objects, places, *result);
  AddFaces(sheet, objects, places, *result);
  summary = sheet.summary;
  return result;
}

std::uint64_t
GetRemeshingMemory(const unsigned int threads)
{
  return SheetCoarsening::GetBytes(threads);
}

void
CheckElementSize(const ExtractOptions & options, const VolumeGeometry & geometry)
{
  const ElementSize & size = options.elementSize;
  const double        smallest = *std::min_element(geometry.spacing.begin(), geometry.spacing.end());
  if (size.kind == ElementSize::Kind::Length && size.length < smallest)
  {
    Fail(ExitStatus::Usage,
         "the element size ",
         FormatNumber(size.length),
         " is below the spacing of the volume, ",
         FormatNumber(smallest),
         "; take that or more, or --element-size voxel");
  }
}

} // end namespace medialvoxel
