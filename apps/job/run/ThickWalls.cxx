// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ThickWalls.h"

#include "ExtractRun.h"
#include "InputVolume.h"
#include "JobClock.h"
#include "PieceLoop.h"
#include "Resampling.h"
#include "StopListener.h"
#include "Survey.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

/** Voxels of the coarse look, and how coarse it may get for them. */
constexpr std::uint64_t CoarseVoxels = std::uint64_t{ 1 } << 22;
constexpr double        LeastStep = 4.0; // windows as planned hold the thickest walls then
constexpr double        MostStep = 8.0;

/** Walls of the coarse look have at least so many of its voxels. */
constexpr double LeastCoarseThickness = 2.0;

/** In voxels. Time and memory grow with it: to four times the default, a part takes about five times as long. */
constexpr double MostThickness = 64.0;

constexpr double EnoughVolume = 0.2;
constexpr double NearlyAll = 99.0;

/** Of each axis, a power of two. */
double
GetStep(const VolumeGeometry & geometry)
{
  double step = LeastStep;
  while (step<MostStep && static_cast<double>(geometry.GetNumberOfVoxels()) / std::pow(step, geometry.GetDimension())>
           CoarseVoxels)
  {
    step *= 2.0;
  }
  return step;
}

double
GetSmallestSpacing(const VolumeGeometry & geometry)
{
  return *std::min_element(geometry.spacing.begin(), geometry.spacing.end());
}

/** \class QuietSink
 * \brief Shows no progress, and stops with another sink. */
class QuietSink : public ProgressSink
{
public:
  explicit QuietSink(const ProgressSink & sink)
    : m_Sink(sink)
  {}

  bool
  IsStopRequested() const override
  {
    return m_Sink.IsStopRequested();
  }

private:
  const ProgressSink & m_Sink;
};

/** What a coarse look at the object finds. */
struct CoarseLook
{
  Survey        survey;
  std::uint64_t objectVoxels{ 0 };
};

void
Look(const ExtractOptions & options,
     const VolumeHeader &   header,
     const JobPlan &        plan,
     const ProgressSink &   stop,
     CoarseLook &           look)
{
  QuietSink sink(stop);
  JobPlan   coarsePlan = plan;
  coarsePlan.numberOfSlices = header.geometry.size.back();
  coarsePlan.divisions = 1;
  coarsePlan.rowsAtOnce = 0;
  coarsePlan.writesBehind = false;
  const auto  input = OpenInputVolume(header, options, coarsePlan.bytesToKeep);
  PieceLoop   loop(coarsePlan, header, 1, sink);
  PieceEngine engine(*input, header, options, coarsePlan, MakeExtraction(options, header), loop.GetObserver());
  engine.AddObserver(look.survey);
  WriteBehind writer(false);
  loop.Prepare(*input);
  look.objectVoxels = loop.Run(engine, { 0, coarsePlan.numberOfSlices }, {}, writer).counts.objectVoxels;
}

} // namespace

void
RaiseMaximumThickness(ExtractOptions &     options,
                      const VolumeHeader & header,
                      const JobPlan &      plan,
                      const ProgressSink & sink)
{
  if (options.thickness || options.maximumThickness || options.labels || options.voxelUnits)
  {
    return;
  }
  const double       edge = GetSmallestSpacing(header.geometry);
  const double       step = GetStep(header.geometry);
  const VolumeHeader coarse = ResampleHeader(header.GetStored(), step * edge);
  ExtractOptions     coarseOptions;
  static_cast<JobOptions &>(coarseOptions) = options;
  coarseOptions.minimumThickness = LeastCoarseThickness * step * edge;
  coarseOptions.maximumThickness = MostThickness * edge;
  coarseOptions.maximumPoreSize = 0;
  coarseOptions.smoothing = Smoothing::Off;
  coarseOptions.subVoxel = false;
  CoarseLook look{ Survey(coarse.geometry, GetGrid(options, coarse), {}) };
  Look(coarseOptions, coarse, plan, sink, look);

  const LengthHistogram & areas = look.survey.GetSums().GetAreas();
  const double            maximum = GetLimitsOfWalls(options, GetGrid(options, header)).maximum;
  double                  thickVolume = 0.0;
  // A coarse voxel more, as a wall of the maximum may read.
  for (std::size_t bin = areas.GetBin(maximum + step * edge) + 1; bin < areas.GetNumbers().size(); ++bin)
  {
    thickVolume += static_cast<double>(areas.GetNumbers()[bin]) * static_cast<double>(bin);
  }
  thickVolume *= look.survey.GetAreaUnit() * areas.GetBinWidth();
  double voxel = 1.0;
  for (const double spacing : coarse.geometry.spacing)
  {
    voxel *= spacing;
  }
  if (thickVolume < EnoughVolume * static_cast<double>(look.objectVoxels) * voxel || look.objectVoxels == 0)
  {
    return;
  }
  const double needed = std::ceil(areas.GetPercentile(NearlyAll) / edge) * edge;
  options.maximumThickness = std::min(std::max(needed, maximum), MostThickness * edge);
  options.defaultMaximumThickness = maximum;
}

} // end namespace medialvoxel
