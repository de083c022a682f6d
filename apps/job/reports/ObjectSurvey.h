// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectSurvey_h
#define medialvoxelObjectSurvey_h

#include "Json.h"
#include "LengthHistogram.h"
#include "Survey.h"

#include "itkMedialVoxelObjectRegion.h"

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** \class ObjectSurvey
 * \brief The sums of a survey for each object of a label map. */
class ObjectSurvey : public itk::MedialVoxelTileObserver
{
public:
  using ObjectNumber = itk::MedialVoxelObjectNumber;

  /** Bytes of an object with walls of up to 16 voxels. */
  static constexpr std::uint64_t MemoryPerObject = std::uint64_t{ 1 } << 15;

  /** \param survey sees the same tiles, and says which cells are measured
   * \param piece the objects of the cells that are at hand; both must outlive it */
  ObjectSurvey(const Survey & survey, const itk::MedialVoxelObjectRegion & piece);

  /** The pass that the tiles from now on belong to. */
  void
  SetPass(unsigned int pass)
  {
    m_Pass = pass;
  }

  std::uint64_t
  GetBytesPerVoxel() const override
  {
    return 0;
  }

  void
  Begin() override;

  void
  Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace) override;

  void
  Commit() override;

  /** All objects of a map by label, with those without a cell. The numbers equal those of a run with the label alone.
   */
  Json
  Summarize(const itk::MedialVoxelObjectMap & map) const;

private:
  struct Sums
  {
    explicit Sums(double binWidth)
      : thickness(binWidth)
    {}
    std::uint64_t candidateCells{ 0 };
    std::uint64_t medialCells{ 0 };
    ThicknessSums thickness;
  };
  using SumsByObject = std::map<ObjectNumber, Sums>;

  /** A cell or wall in a filled pore, whose object is looked for when all tiles are done. */
  struct Unknown
  {
    itk::MedialVoxelIndex               cell;
    bool                                isMedial;
    std::optional<itk::MedialVoxelWall> wall; ///< alone, when it is set
  };

  Sums &
  GetSums(SumsByObject & sums, ObjectNumber object) const;

  double
  GetBinWidth() const;

  static void
  AddCell(Sums & sums, bool isMedial);

  const Survey &                       m_Survey;
  const itk::MedialVoxelObjectRegion & m_Piece;
  unsigned int                         m_Pass{ 0 };
  std::mutex                           m_Mutex; // of the members below
  SumsByObject                         m_Pending;
  std::vector<Unknown>                 m_Unknown;
  SumsByObject                         m_Total;
};

} // end namespace medialvoxel

#endif
