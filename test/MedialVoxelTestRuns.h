// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestRuns_h
#define MedialVoxelTestRuns_h

// The filters run on volumes of the oracles.

#include "MedialVoxelTestSupport.h"

#include "itkMedialVoxelImageFilter.h"
#include "itkVectorDistanceMapImageFilter.h"

namespace MedialVoxelTest
{
template <unsigned int D>
using MaskImage = itk::Image<unsigned char, D>;
template <unsigned int D>
using MedialFilter = itk::MedialVoxelImageFilter<MaskImage<D>>;
template <unsigned int D>
using VectorFilter = itk::VectorDistanceMapImageFilter<MaskImage<D>>;

inline itk::MedialVoxelPseudoGeodesicBound
FilterBound(Bound bound)
{
  switch (bound)
  {
    case Bound::FreeSpace:
      return itk::MedialVoxelPseudoGeodesicBound::FreeSpace;
    case Bound::Paper:
      return itk::MedialVoxelPseudoGeodesicBound::Paper;
    default:
      return itk::MedialVoxelPseudoGeodesicBound::Off;
  }
}

/** A medial filter on the image of a volume, not yet run. */
template <unsigned int D>
typename MedialFilter<D>::Pointer
MakeMedialFilter(const Volume & volume, double thickness, Bound bound = Bound::FreeSpace)
{
  auto filter = MedialFilter<D>::New();
  filter->SetInput(MakeImage<MaskImage<D>>(volume));
  filter->SetThickness(thickness);
  filter->SetPseudoGeodesicBound(FilterBound(bound));
  // The oracles take the object as it is.
  filter->SetSmoothing(itk::MedialVoxelSmoothing::Off);
  return filter;
}

/** Labels and counts of a whole volume. */
template <unsigned int D>
Classification
RunMedialFilter(const Volume & volume, double thickness, Bound bound = Bound::FreeSpace)
{
  auto filter = MakeMedialFilter<D>(volume, thickness, bound);
  filter->UpdateLargestPossibleRegion();
  return { PixelsOf(filter->GetOutput()), CountsOf(filter.GetPointer()) };
}

/** Index units instead of the spacing of the image. */
inline Volume
InVoxelUnits(Volume volume)
{
  volume.spacing = UnitSpacing;
  return volume;
}

/** The voxel that a vector at v points to; far outside the volume for a vector that is not finite. */
template <typename TVector>
Index3
PointedTo(const Volume & volume, const Index3 & v, const TVector & vector)
{
  Index3 target = v;
  for (unsigned int axis = 0; axis < TVector::Dimension; ++axis)
  {
    const double steps = vector[axis] / volume.spacing[axis];
    target[axis] += std::isfinite(steps) ? static_cast<int>(std::lround(steps)) : 1000000;
  }
  return target;
}

/** The length of a vector, in double. */
template <typename TVector>
double
NormOf(const TVector & vector)
{
  double sum = 0.0;
  for (unsigned int axis = 0; axis < TVector::Dimension; ++axis)
  {
    sum += static_cast<double>(vector[axis]) * vector[axis];
  }
  return std::sqrt(sum);
}

/** The displacements of definition 4 as floats: N(v) - v at the voxels of `region`, zero elsewhere. */
template <unsigned int D>
std::vector<itk::Vector<float, D>>
ExpectedVectors(const Volume & volume, const std::vector<Index3> & sites, const std::vector<unsigned char> & region)
{
  std::vector<itk::Vector<float, D>> vectors(volume.object.size(), itk::Vector<float, D>(0.0f));
  const auto                         nearest = NearestSites(volume, sites, region);
  for (std::size_t i = 0; i < vectors.size(); ++i)
  {
    for (unsigned int axis = 0; region[i] && axis < D; ++axis)
    {
      vectors[i][axis] =
        nearest[i] < 0 ? std::numeric_limits<float>::quiet_NaN()
                       : static_cast<float>((sites[nearest[i]][axis] - volume.IndexAt(i)[axis]) * volume.spacing[axis]);
    }
  }
  return vectors;
}

/** How many vectors differ, NaN being equal to NaN; the first one is named. */
template <typename TVector>
::testing::AssertionResult
VectorsAreEqual(const std::vector<TVector> & actual, const std::vector<TVector> & expected)
{
  if (actual.size() != expected.size())
  {
    return ::testing::AssertionFailure() << actual.size() << " vectors instead of " << expected.size();
  }
  std::size_t differences = 0;
  std::size_t first = 0;
  for (std::size_t i = actual.size(); i-- > 0;)
  {
    for (unsigned int axis = 0; axis < TVector::Dimension; ++axis)
    {
      const bool bothNan = std::isnan(actual[i][axis]) && std::isnan(expected[i][axis]);
      if (!bothNan && actual[i][axis] != expected[i][axis])
      {
        ++differences;
        first = i;
        break;
      }
    }
  }
  return differences == 0
           ? ::testing::AssertionSuccess()
           : (::testing::AssertionFailure() << differences << " of " << actual.size() << " vectors differ, first at "
                                            << first << ": " << actual[first] << " instead of " << expected[first]);
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestRuns_h
