// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputSet_h
#define medialvoxelOutputSet_h

#include "Options.h"
#include "OutputFile.h"
#include "OutputRequest.h"
#include "VoxelOutput.h"

#include <memory>
#include <string>
#include <vector>

namespace medialvoxel
{

/** \class OutputSet
 * \brief The outputs of a job, which appear together: files before volumes, and of each the one added first last. The
 * last one stands for all. */
class OutputSet
{
public:
  /** \param options must outlive the set
   * \param writesBehind volumes are written in a thread of their own, which may wait for the disk
   * \param suffix end of temporary names, when one process at a time has this set: leftovers of a killed process are
   * removed */
  OutputSet(const JobOptions & options, bool writesBehind, const std::string & suffix = "")
    : m_Options(options)
    , m_WritesBehind(writesBehind)
    , m_Suffix(suffix)
  {}
  virtual ~OutputSet() = default;

  /** Creates a volume. */
  virtual VoxelOutput &
  AddVolume(const VolumeRequest & request);

  /** Creates a volume that the end of a job fills as a whole; null when the job does not end here. */
  virtual VoxelOutput *
  AddVolumeOfEnd(const VolumeRequest & request);

  /** The volume of a role; null when there is none. */
  const VoxelOutput *
  FindVolume(const std::string & role) const;

  /** Creates an empty file of another kind; null when the name is empty. */
  virtual OutputFile *
  AddFile(const std::string & fileName);

  /** Brings all volumes to the disk and compares their sizes. */
  void
  FinishVolumes();

  /** Gives all finished outputs their names. */
  void
  Publish();

protected:
  /** Takes a volume that is there. */
  VoxelOutput &
  TakeVolume(const std::string & role, std::unique_ptr<VoxelOutput> volume, bool isPublished = true);

private:
  struct Volume
  {
    std::string                  role;
    std::unique_ptr<VoxelOutput> output;
    bool                         isPublished;
  };

  const JobOptions &                       m_Options;
  bool                                     m_WritesBehind;
  std::string                              m_Suffix;
  std::vector<Volume>                      m_Volumes;
  std::vector<std::unique_ptr<OutputFile>> m_Files;
};

} // end namespace medialvoxel

#endif
