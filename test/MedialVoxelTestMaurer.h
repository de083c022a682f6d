// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestMaurer_h
#define MedialVoxelTestMaurer_h

// Distances of ITK's own filter, and the vector filter compared with them.

#include "MedialVoxelTestRuns.h"

#include "itkSignedMaurerDistanceMapImageFilter.h"

namespace MedialVoxelTest
{
/** Signed distances of ITK's filter, computed in double. */
template <unsigned int D>
std::vector<double>
MaurerDistances(const Volume & volume, bool insideIsPositive = false, bool squared = false, bool useSpacing = true)
{
  auto maurer = itk::SignedMaurerDistanceMapImageFilter<MaskImage<D>, itk::Image<double, D>>::New();
  maurer->SetInput(MakeImage<MaskImage<D>>(volume));
  maurer->SetInsideIsPositive(insideIsPositive);
  maurer->SetSquaredDistance(squared);
  maurer->SetUseImageSpacing(useSpacing);
  maurer->Update();
  return PixelsOf(maurer->GetOutput());
}

/** Relative difference that rounding explains: our vectors have float components (2^-24 each), their filter
 * multiplies and divides squared spacings in double. */
constexpr double MaurerTolerance = 2e-7;

/** The largest relative difference between the norms of vectors and the magnitudes of distances. */
template <typename TVector>
double
LargestRelativeDifference(const std::vector<TVector> & vectors, const std::vector<double> & distances)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < vectors.size(); ++i)
  {
    const double expected = std::abs(distances[i]);
    const double difference = std::abs(NormOf(vectors[i]) - expected);
    largest = difference <= largest * expected ? largest : difference / std::max(expected, 1e-30);
    if (std::isnan(difference))
    {
      return std::numeric_limits<double>::infinity();
    }
  }
  return largest;
}

/** Vectors to the object border equal SignedMaurer of the mask on both sides. */
template <unsigned int D>
void
ExpectObjectBorderIsMaurer(const Volume & volume)
{
  auto filter = VectorFilter<D>::New();
  filter->SetInput(MakeImage<MaskImage<D>>(volume));
  filter->Update();
  EXPECT_LT(LargestRelativeDifference(PixelsOf(filter->GetOutput()), MaurerDistances<D>(volume)), MaurerTolerance);
}

/** Vectors to the background border equal SignedMaurer of the complement on both sides. */
template <unsigned int D>
void
ExpectBackgroundBorderIsMaurerOfTheComplement(const Volume & volume)
{
  auto filter = VectorFilter<D>::New();
  filter->SetInput(MakeImage<MaskImage<D>>(volume));
  filter->SetBoundary(itk::MedialVoxelBoundary::Background);
  filter->Update();
  EXPECT_LT(LargestRelativeDifference(PixelsOf(filter->GetOutput()), MaurerDistances<D>(Complement(volume))),
            MaurerTolerance);
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestMaurer_h
