// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The medial surface of small images: as many quadrilaterals as brute force finds, a mesh that holds together, and the
// same one for any pieces, threads and memory.

#include "FuzzFilters.h"

#include "MedialVoxelTestMesh.h"

#include "itkMedialSurfaceMeshFilter.h"

#include <map>
#include <string>

namespace
{

using namespace MedialVoxelFuzz;
using namespace MedialVoxelTest;
using ImageType = itk::Image<float, 3>;
using FilterType = itk::MedialSurfaceMeshFilter<ImageType, MeshType>;

/** What is made of the surface. */
struct Finish
{
  bool               subVoxel{ false };
  bool               triangles{ false };
  bool               marksSides{ false };
  double             minimumBranchLength{ 0.0 };
  itk::SizeValueType smallestComponent{ 0 };

  bool
  LeavesOut() const
  {
    return minimumBranchLength > 0 || smallestComponent > 1;
  }
};

Finish
ChooseFinish(Choices & choices, const Scene & scene)
{
  Finish finish;
  finish.subVoxel = scene.HasThresholds() && choices.Flag();
  finish.triangles = choices.Flag();
  finish.marksSides = choices.Flag();
  finish.minimumBranchLength = choices.Next(0, 3) == 0 ? UnitOf(scene.volume) * (choices.Byte() / 16.0) : 0.0;
  finish.smallestComponent = choices.Next(0, 3) == 0 ? static_cast<itk::SizeValueType>(choices.Next(0, 20)) : 0;
  return finish;
}

FilterType::Pointer
MakeFilter(const Scene &                 scene,
           const Question &              question,
           const Finish &                finish,
           const SceneInput<ImageType> & input,
           const Cut &                   cut)
{
  auto filter = FilterType::New();
  SetScene(*filter, scene, input, cut);
  filter->SetNumberOfSlicesPerPiece(cut.slabThickness);
  SetWalls(*filter, question);
  filter->SetSubvoxelThickness(finish.subVoxel);
  filter->SetGenerateTriangles(finish.triangles);
  filter->SetMarkSides(finish.marksSides);
  filter->SetMinimumBranchLength(finish.minimumBranchLength);
  filter->SetSmallestComponent(finish.smallestComponent);
  return filter;
}

using Sides = std::map<std::pair<itk::IdentifierType, itk::IdentifierType>, int>;

/** Faces that have a side, by its points. */
Sides
CountSides(const MeshType & mesh)
{
  Sides sides;
  for (itk::IdentifierType i = 0; i < mesh.GetNumberOfCells(); ++i)
  {
    MeshType::CellAutoPointer cell;
    mesh.GetCell(i, cell);
    const std::vector<itk::IdentifierType> points(cell->PointIdsBegin(), cell->PointIdsEnd());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      ++sides[std::minmax(points[k], points[(k + 1) % points.size()])];
    }
  }
  return sides;
}

/** Points are places and used, and have a length as data. */
void
CheckPoints(const MeshType & mesh)
{
  for (itk::IdentifierType i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    const auto point = mesh.GetPoint(i);
    float      thickness = -1.0F;
    Require(mesh.GetPointData(i, &thickness) && thickness >= 0 && std::isfinite(thickness),
            "a thickness of the surface is no length");
    Require(std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]), "a point is no place");
  }
}

/** Faces have points that there are, different ones, all points in use; areas are areas, and marks say what is so. */
void
CheckFaces(const MeshType & mesh, const Finish & finish)
{
  const Sides                sides = finish.triangles ? Sides() : CountSides(mesh);
  std::vector<unsigned char> used(mesh.GetNumberOfPoints(), 0);
  for (itk::IdentifierType i = 0; i < mesh.GetNumberOfCells(); ++i)
  {
    MeshType::CellAutoPointer cell;
    float                     data = -1.0F;
    Require(mesh.GetCell(i, cell) && mesh.GetCellData(i, &data), "a face is missing");
    const std::vector<itk::IdentifierType> points(cell->PointIdsBegin(), cell->PointIdsEnd());
    Require(points.size() == (finish.triangles ? 3U : 4U), "a face with another number of points");
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      Require(points[k] < used.size() && std::count(points.begin(), points.end(), points[k]) == 1, "a face is no face");
      used[points[k]] = 1;
      if (finish.marksSides && !finish.triangles)
      {
        const int number = sides.at(std::minmax(points[k], points[(k + 1) % points.size()]));
        Require((static_cast<int>(data) >> k & 17) == (number == 1 ? 1 : 0) + (number > 2 ? 16 : 0),
                "a side has a false mark");
      }
    }
    Require(finish.marksSides || (data >= 0 && std::isfinite(data)), "an area is no area");
  }
  Require(std::count(used.begin(), used.end(), 0) == 0, "a point belongs to no face");
}

void
CheckMesh(const MeshType & mesh, const Scene & scene, const Question & question, const Finish & finish)
{
  CheckPoints(mesh);
  CheckFaces(mesh, finish);
  const Volume             volume = CleanedByBruteForce(scene.GetMeasured(), question);
  const auto               expected = CountFacesByBruteForce(volume, question);
  const itk::SizeValueType quads = mesh.GetNumberOfCells() / (finish.triangles ? 2 : 1);
  Require(!expected || quads == *expected || (finish.LeavesOut() && quads < *expected),
          "another number of quadrilaterals than by brute force");
}

/** Whether 32 bits do not keep the points of this image apart, which the filter says before any work. */
bool
IsRefused(FilterType & filter)
{
  try
  {
    filter.Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    const std::string description = error.GetDescription();
    Require(description.find("32 bits do not keep points apart") != std::string::npos, "refused for another reason");
    return true;
  }
  return false;
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  if (size > MostBytesOfScene)
  {
    return 0;
  }
  Choices        choices(data, size);
  Scene          scene = ChooseScene(choices, 3);
  const Question question = ChooseQuestion(choices, scene.GetMeasured());
  const Finish   finish = ChooseFinish(choices, scene);
  const Cut      cut = ChooseCut(choices);
  FillScene(choices, Values::Real, scene);

  const SceneInput<ImageType> input(scene);
  const auto                  whole = MakeFilter(scene, question, finish, input, Cut());
  if (IsRefused(*whole))
  {
    return 0;
  }
  CheckMesh(*whole->GetOutput(), scene, question, finish);
  RunWithin(cut, [&] {
    const auto pieces = MakeFilter(scene, question, finish, input, cut);
    pieces->Update();
    Require(NumbersOf(*pieces->GetOutput()) == NumbersOf(*whole->GetOutput()),
            "the mesh of the pieces differs from the whole");
  });
  return 0;
}
