// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJobFolder_h
#define medialvoxelJobFolder_h

#include "ClusterMarker.h"
#include "JobLocks.h"
#include "JobResult.h"
#include "Manifest.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace medialvoxel
{

/** Files with the voxels of volumes that have a header of their own, by the role of the volume. */
struct DataNames
{
  std::map<std::string, std::string> chosen;   ///< to be given to the new ones
  std::map<std::string, std::string> replaced; ///< to be removed then
};

/** \class JobFolder
 * \brief The files by which the processes of a job know of each other.
 *
 * manifest.json is their agreement. clusters/NNNNNN.json exists when a cluster is done and its bytes are on the
 * disk; it has a checksum of them. NNNNNN.survey is its part of the statistics. publishing.json exists once outputs
 * may have got their names, finished.json when all have. planned.json is a manifest whose outputs are still being
 * created. Each appears complete, by a rename. The file locks is empty and serves only to be locked. */
class JobFolder
{
public:
  explicit JobFolder(const std::filesystem::path & folder);

  const std::filesystem::path &
  GetPath() const
  {
    return m_Path;
  }

  std::filesystem::path
  GetLocksName() const;

  /** True when there is a manifest. */
  bool
  IsPlanned() const;

  /** True when all outputs of the job have their names. */
  bool
  IsFinished(const Manifest & manifest) const;

  /** With the folder from which names are meant now. \throw JobError Failure when there is none, or as
   * medialvoxel::ReadManifest() */
  Manifest
  ReadManifest() const;

  /** Call before the folder is written to: it may have been removed, or given to another job.
   * \throw JobError Failure when its manifest is of another job */
  void
  CheckStillOf(const Manifest & manifest) const;

  /** \throw JobError Refused when the folder exists and has more than the files of a job without a manifest. */
  void
  CheckFree() const;

  /** Creates the folder unless it is there. \throw JobError Refused, also as CheckFree() */
  void
  Create() const;

  /** The manifest of a plan that ended early, or nothing. */
  std::optional<Manifest>
  ReadUnfinishedPlan() const;

  /** Call before the first output is created, so that outputs are found if this process ends early. */
  void
  WriteUnfinishedPlan(const Manifest & manifest) const;

  /** Makes it the manifest. */
  void
  FinishPlan(const Manifest & manifest) const;

  std::optional<ClusterMarker>
  ReadMarker(const Manifest & manifest, std::uint64_t cluster) const;

  /** Makes a cluster done. \param survey its part of the survey; empty: it has none */
  void
  WriteMarker(const Manifest & manifest, std::uint64_t cluster, ClusterMarker marker, const std::string & survey) const;

  /** Makes a cluster that was done one that is to be done. \throw JobError Failure */
  void
  RemoveMarker(std::uint64_t cluster) const;

  /** Nothing when it is missing or its checksum is not the marker's. */
  std::optional<std::string>
  ReadSurvey(std::uint64_t cluster, const ClusterMarker & marker) const;

  /** Once WriteDataNames() was called. */
  std::optional<DataNames>
  ReadDataNames(const Manifest & manifest) const;
  void
  WriteDataNames(const Manifest & manifest, const DataNames & names) const;

  void
  WriteFinished(const Manifest & manifest, WallVerdict verdict) const;

  /** The result of a finished job. */
  WallVerdict
  GetVerdict(const Manifest & manifest) const;

  /** Removes the files that this class knows, but for the locks. */
  void
  Clear() const;

  /** Removes these files and the locks, and the folder when it is empty then. */
  void
  Remove() const;

  /** The same of a job that is finished, which it stays when this is interrupted. */
  void
  RemoveFinished() const;

private:
  std::filesystem::path
  GetClusterName(std::uint64_t cluster, const char * extension) const;

  std::filesystem::path m_Path; ///< absolute
};

} // end namespace medialvoxel

#endif
