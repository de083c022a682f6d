// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelArrayEngine_h
#define medialvoxelArrayEngine_h

#include "ArrayRun.h"
#include "ArraySource.h"
#include "Options.h"

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelInput.h"
#include "itkMedialVoxelProgress.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace medialvoxel
{

/** Gray values that walls are measured on; unset: the object. */
using GrayRange = itk::MedialVoxelSheetExtraction::GrayRange;

/** How walls are measured, and the words of the report for it. */
struct ArrayMeasure
{
  std::optional<GrayRange>   range{};
  itk::MedialVoxelScanResult found{};

  nlohmann::json
  Describe() const;
};

/** \class ArrayEngine
 * \brief Runs tasks of the library over all of an array; its caller can stop it. */
class ArrayEngine
  : private itk::MedialVoxelEngineClient
  , private itk::MedialVoxelProgress
{
public:
  /** Stores the results of a tile. Called by several threads at a time. */
  using TileTaker = std::function<void(const itk::MedialVoxelTileResult & tile)>;

  /** \param call stays as long as this */
  ArrayEngine(const ArrayCall & call, const JobOptions & options);

  /** The object of the options, smoothed or not, before it is prepared. */
  itk::MedialVoxelObjectInput
  MakeObject(Smoothing smoothing);

  /** Reads it once for what must be known before a run: noise, and thick walls, for which the maximum thickness of the
   * options rises. */
  void
  Prepare(itk::MedialVoxelObjectInput & object, ExtractOptions & options);

  ArraySource &
  GetSource()
  {
    return m_Source;
  }

  const itk::MedialVoxelGrid &
  GetGrid() const
  {
    return m_Grid;
  }

  /** Call function(observer), which reads the array before the engine does. */
  template <typename TFunction>
  auto
  ReadBeforeRun(TFunction && function)
  {
    const itk::MedialVoxelProgressScope scope(*this);
    return function([this](double) {
      // Work with a progress of its own hears this one, too.
      const itk::MedialVoxelProgressScope asked(*this);
      itk::MedialVoxelCheckAbort();
    });
  }

  /** How the walls of a prepared object are measured.
   * \param mayUseValues false: on the object
   * \param whyOnObject  the reason for that */
  ArrayMeasure
  FindMeasure(itk::MedialVoxelObjectInput &                     object,
              bool                                              mayUseValues,
              const std::string &                               whyOnObject,
              const std::optional<itk::MedialVoxelScanLevels> & levels);

  /** \param run, numberOfRuns of runs over the array one after the other */
  itk::MedialVoxelSums
  Run(itk::MedialVoxelInput &            input,
      const itk::MedialVoxelEngineTask & task,
      TileTaker                          taker,
      unsigned int                       run = 0,
      unsigned int                       numberOfRuns = 1);

  unsigned int
  GetNumberOfThreads() const;

  /** Where a tile begins in an array of results, and its strides there. */
  template <typename TValue>
  TValue *
  PlaceOf(TValue * results, const itk::MedialVoxelBox & box) const
  {
    return results + box.lower[0] + m_Strides[1] * box.lower[1] + m_Strides[2] * box.lower[2];
  }

  const itk::MedialVoxelStrides &
  GetStrides() const
  {
    return m_Strides;
  }

  /** Writes vectors (z, y, x) of a tile in the units of the options. */
  void
  WriteVectors(const itk::MedialVoxelTileResult & tile, float * vectors) const;

private:
  void
  RunWorkers(unsigned int numberOfWorkers, const std::function<void()> & work) override;

  void
  TakeTile(const itk::MedialVoxelTileResult & tile) override;

  void
  UpdateProgress(float fraction) override;

  /** For both bases. */
  bool
  IsAborted() const override;

  void
  Advance(std::uint64_t voxels) override;

  const ArrayCall &       m_Call;
  JobOptions              m_Options;
  ArraySource             m_Source;
  itk::MedialVoxelGrid    m_Grid;
  itk::MedialVoxelStrides m_Strides;
  TileTaker               m_Taker;
  unsigned int            m_Run{ 0 };
  unsigned int            m_NumberOfRuns{ 1 };
};

} // end namespace medialvoxel

#endif
