// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelManifest_h
#define medialvoxelManifest_h

#include "FileIdentity.h"
#include "JobPlan.h"
#include "Options.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** The agreement of the processes of a job: everything that decides a byte of the result, and its destination. */
struct Manifest
{
  std::string           version; ///< of the program
  std::string           jobId;   ///< 16 hexadecimal digits that no other job has
  std::filesystem::path folder;  ///< absolute; relative names of files are meant from here
  std::filesystem::path fromJob; ///< the way to it from the job folder, which holds when both were moved
  ExtractOptions        options; ///< names of files as they were given

  std::vector<FileIdentity> input; ///< all files of the volume

  std::uint64_t numberOfSlices{ 0 };
  std::uint64_t numberOfClusters{ 0 };
  std::uint64_t sliceUnit{ 1 }; ///< clusters, but the last one, have a multiple of it: a layer of chunks
  std::uint64_t perSlice{ 0 };  ///< of all volumes that are written

  SliceRange
  GetCluster(std::uint64_t cluster) const;

  /** As many clusters there can be. */
  std::uint64_t
  GetMostClusters() const
  {
    return this->GetPlan().GetNumberOfUnits();
  }

  /** The suffix of the temporary names of the outputs. */
  std::string
  GetSuffix() const;

private:
  JobPlan
  GetPlan() const;
};

/** \throw JobError Failure, or Usage for names that are not UTF-8 */
void
WriteManifest(const std::filesystem::path & fileName, const Manifest & manifest);

/** Nothing when the file does not exist.
 * \throw JobError Failure when it is damaged or changed, or of another version of the program. */
std::optional<Manifest>
ReadManifest(const std::filesystem::path & fileName);

/** The folder from which the names of the files are meant now. The outputs tell it when the job folder was moved, or
 * has another name on this machine.
 * \param jobFolder in which the manifest is */
std::filesystem::path
FindFolder(const Manifest & manifest, const std::filesystem::path & jobFolder);

/** The options with absolute names of files. \param folder from which the names are meant */
ExtractOptions
WithAbsoluteNames(ExtractOptions options, const std::filesystem::path & folder);

/** The first parameter in which two jobs differ, and its values, as "lower is 72, not 70"; empty: none. Threads,
 * memory and overwriting, which change no byte, may differ; divisions only count when \a wanted has them. */
std::string
FindDifference(const ExtractOptions & wanted, const ExtractOptions & present);

} // end namespace medialvoxel

#endif
