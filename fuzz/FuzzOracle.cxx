// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FuzzOracle.h"

#include "MedialVoxelTestAutomatic.h"

namespace MedialVoxelFuzz
{

using namespace MedialVoxelTest;

std::optional<Classification>
AnswerByBruteForce(const Question & question)
try
{
  return question.thickness
           ? Classify(question.volume, *question.thickness, question.bound)
           : AutomaticClassifier(question.volume, { question.minimumThickness, question.maximumThickness })
               .Run(question.bound);
}
catch (const std::logic_error &)
{
  return std::nullopt;
}

std::vector<std::array<float, 3>>
VectorsByBruteForce(const Volume & volume, BoundarySide side)
{
  const std::vector<Index3>         sites = BoundarySites(volume, side);
  const std::vector<long>           nearest = NearestSites(volume, sites, volume.object);
  std::vector<std::array<float, 3>> vectors(volume.object.size(), { { 0.0F, 0.0F, 0.0F } });
  for (std::size_t i = 0; i < vectors.size() && !sites.empty(); ++i)
  {
    for (int axis = 0; nearest[i] >= 0 && axis < 3; ++axis)
    {
      vectors[i][axis] = static_cast<float>((sites[nearest[i]][axis] - volume.IndexAt(i)[axis]) * volume.spacing[axis]);
    }
  }
  return sites.empty() ? std::vector<std::array<float, 3>>() : vectors;
}

} // namespace MedialVoxelFuzz
