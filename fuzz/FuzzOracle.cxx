// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FuzzOracle.h"

#include "MedialVoxelTestAutomatic.h"
#include "MedialVoxelTestPores.h"
#include "MedialVoxelTestSurfaceOracle.h"
#include "MedialVoxelTestThickness.h"

namespace MedialVoxelFuzz
{

using namespace MedialVoxelTest;

namespace
{

constexpr int DefaultPoreSize = 32; // with an automatic thickness

// The number of paths grows fast with both.
constexpr double      MostEdgesOfExactPaths = 3.5;
constexpr std::size_t MostSitesOfExactPaths = 60;

double
ShortestSpacing(const Volume & volume)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const int axis : volume.Axes())
  {
    shortest = std::min(shortest, volume.spacing[axis]);
  }
  return std::isfinite(shortest) ? shortest : 1.0;
}

WallLimits
LimitsOf(const Volume & volume, const Question & question)
{
  const double unit = ShortestSpacing(volume);
  const double least = LeastThickness(volume);
  const double most = std::max(16.0 * unit, 4.0 * least);
  return { std::max(question.minimumThickness > 0 ? question.minimumThickness : 3.0 * unit, least),
           std::max(question.maximumThickness > 0 ? question.maximumThickness : most, least) };
}

/** Epsilon of the edge from \a v along \a axis: the largest of the cells around. */
double
EpsilonAround(const Volume & volume, const JointClassifier & classifier, const Index3 & v, int axis)
{
  double largest = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    Index3 cell = v;
    cell[(axis + 1) % 3] -= k & 1;
    cell[(axis + 2) % 3] -= k >> 1;
    largest = std::max(largest, classifier.EpsilonOf(volume.Offset(cell)));
  }
  return largest;
}

/** Calls \a visit(voxel, axis) for the edges that have four cells around them and an object voxel at an end. */
template <typename TVisitor>
void
ForEachInnerEdge(const Volume & volume, TVisitor && visit)
{
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    const Index3 v = volume.IndexAt(i);
    for (int axis = 0; axis < 3; ++axis)
    {
      Index3 other = v;
      ++other[axis];
      bool isInside = volume.Contains(other);
      for (int across = 0; across < 3; ++across)
      {
        isInside = isInside && (across == axis || (v[across] > 0 && v[across] < volume.size[across] - 1));
      }
      if (isInside && (volume.IsObject(v) || volume.IsObject(other)))
      {
        visit(v, axis);
      }
    }
  }
}

} // namespace

double
ChooseThicknessOfPath(Choices & choices, const Volume & volume, int edges)
{
  const std::vector<int> axes = volume.Axes();
  EdgeCounts             counts{};
  for (int edge = 0; edge < edges; ++edge)
  {
    const int bits = choices.Next(1, 7);
    int       mask = 0;
    for (std::size_t i = 0; i < axes.size(); ++i)
    {
      mask |= (bits >> i & 1) << axes[i];
    }
    ++counts[mask];
  }
  counts[0] = 0;
  return ThicknessForEpsilon(PathLength(volume, counts));
}

double
UnitOf(const Volume & volume)
{
  const double shortest = ShortestSpacing(volume);
  return shortest > 0.1 && shortest < 10.0 ? 1.0 : shortest;
}

Question
ChooseQuestion(Choices & choices, const Volume & volume)
{
  Question question;
  question.bound = choices.OneOf(std::array<Bound, 3>{ { Bound::FreeSpace, Bound::Paper, Bound::Off } });
  const int kind = choices.Next(0, 7);
  // Not the round numbers at which paths have the length that decides.
  const double unit = UnitOf(volume);
  const double first = unit * (0.113 + choices.Byte() / 16.0);
  const double second = first + unit * (choices.Byte() / 16.0);
  if (kind < 4)
  {
    question.thickness = first;
  }
  else if (kind == 4)
  {
    const double thickness = ChooseThicknessOfPath(choices, volume, choices.Next(1, 4));
    question.thickness = thickness > 0 ? thickness : first;
  }
  else if (kind < 7)
  {
    question.minimumThickness = first;
    question.maximumThickness = second;
  }
  if (choices.Next(0, 3) != 0)
  {
    question.maximumPoreSize = choices.Flag() ? choices.Next(1, 64) : 0;
  }
  return question;
}

Volume
CleanedByBruteForce(const Volume & volume, const Question & question)
{
  const int size = question.maximumPoreSize.value_or(question.thickness ? 0 : DefaultPoreSize);
  return size > 0 ? WithoutPores(volume, static_cast<std::size_t>(size)) : volume;
}

std::size_t
CountVoxelsOnlyIn(const Volume & volume, const Volume & other)
{
  return VoxelsOnlyIn(volume, other);
}

std::optional<Classification>
AnswerByBruteForce(const Volume & volume, const Question & question)
try
{
  return question.thickness ? Classify(volume, *question.thickness, question.bound)
                            : JointClassifier(volume, LimitsOf(volume, question)).Run(question.bound);
}
catch (const std::logic_error &)
{
  const bool isSmall = question.thickness &&
                       EpsilonOf(std::max(*question.thickness, LeastThickness(volume))) <
                         MostEdgesOfExactPaths * ShortestSpacing(volume) &&
                       BoundarySites(volume).size() <= MostSitesOfExactPaths;
  return isSmall ? std::optional<Classification>(Classify(volume, *question.thickness, question.bound, PathSums::Exact))
                 : std::nullopt;
}

std::optional<std::size_t>
CountFacesByBruteForce(const Volume & volume, const Question & question)
{
  const std::vector<Index3> sites = BoundarySites(volume);
  const std::vector<long>   nearest = NearestBoundaryPoints(volume, sites);
  bool                      isSure = true;
  const auto                count = [&](auto & classifier, auto epsilonAround, auto epsilonOf) {
    const auto areApart = [&](const Index3 & v, const Index3 & w, double epsilon) {
      const long a = nearest[volume.Offset(v)];
      const long b = nearest[volume.Offset(w)];
      if (a < 0 || b < 0)
      {
        return false;
      }
      const double length = classifier.GeodesicDistance(a, b);
      isSure = isSure && std::abs(length - epsilon) >= 1e-9 * epsilon;
      return length >= epsilon;
    };
    std::set<SurfaceOracle::Edge> crossed;
    ForEachInnerEdge(volume, [&](const Index3 & v, int axis) {
      if (areApart(v, Moved(v, axis, 1), epsilonAround(v, axis)))
      {
        crossed.insert({ v, axis });
      }
    });
    const SurfaceOracle oracle(crossed,
                                              { [&](const Index3 & v, const Index3 & w, const Index3 & cell, const Index3 & behind) {
                                  return areApart(v, w, std::max(epsilonOf(cell), epsilonOf(behind)));
                                },
                                 [&](const Index3 & v, const Index3 & w) {
                                   return KeyDistance(
                                     volume, sites[nearest[volume.Offset(v)]], sites[nearest[volume.Offset(w)]]);
                                 } });
    return crossed.size() - oracle.GetTrimmed().size();
  };
  std::size_t faces = 0;
  if (question.thickness)
  {
    Classifier classifier(volume, *question.thickness);
    const auto epsilon = [&](auto &&...) { return classifier.GetEpsilon(); };
    faces = count(classifier, epsilon, epsilon);
  }
  else
  {
    JointClassifier classifier(volume, LimitsOf(volume, question));
    faces = count(
      classifier,
      [&](const Index3 & v, int axis) { return EpsilonAround(volume, classifier, v, axis); },
      [&](const Index3 & cell) { return classifier.EpsilonOf(volume.Offset(cell)); });
  }
  return isSure ? std::optional<std::size_t>(faces) : std::nullopt;
}

std::vector<double>
ThicknessByBruteForce(const Volume & volume, const std::vector<unsigned char> & labels)
{
  const std::vector<Index3> sites = BoundarySites(volume);
  const std::vector<long>   nearest = NearestBoundaryPoints(volume, sites);
  std::vector<double>       thicknesses(labels.size(), 0.0);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] >= 2)
    {
      thicknesses[i] = ExpectWall(volume, sites, nearest, volume.IndexAt(i)).thickness;
    }
  }
  return thicknesses;
}

std::vector<std::array<float, 3>>
VectorsByBruteForce(const Scene &                      scene,
                    const Volume &                     volume,
                    BoundarySide                       side,
                    const std::vector<unsigned char> & wanted)
{
  const std::vector<Index3>         sites = BoundarySites(volume, side);
  const std::vector<long>           nearest = NearestSites(volume, sites, wanted);
  std::vector<std::array<float, 3>> vectors(volume.object.size(), { { 0.0F, 0.0F, 0.0F } });
  for (std::size_t i = 0; i < vectors.size(); ++i)
  {
    for (int axis = 0; wanted[i] != 0 && axis < 3; ++axis)
    {
      const int row = scene.useImageSpacing ? scene.axisOf[axis] : axis;
      const int sign = scene.useImageSpacing ? scene.signOf[axis] : 1;
      vectors[i][row] =
        nearest[i] < 0
          ? std::numeric_limits<float>::quiet_NaN()
          : static_cast<float>(sign * (sites[nearest[i]][axis] - volume.IndexAt(i)[axis]) * volume.spacing[axis]);
    }
  }
  return vectors;
}

} // namespace MedialVoxelFuzz
