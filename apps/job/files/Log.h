// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLog_h
#define medialvoxelLog_h

#include "Progress.h"
#include "SystemFile.h"

#include <filesystem>
#include <memory>
#include <string>

namespace medialvoxel
{

/** \class Log
 * \brief A text file that gets a line for each step of a job.
 *
 * A line has the time (UTC), the level, the number of the process, the event and its values as name=value. It is
 * written by one call of the system to the end of the file, so that several processes can share one. */
class Log
{
public:
  /** Opens a file, or makes it.
   * \throw JobError Refused when the file cannot be written, or has something that is not a log. */
  explicit Log(const std::filesystem::path & fileName);

  /** A line that cannot be written is left out. */
  void
  Write(const LogRecord & record);

private:
  SystemFile m_File;
};

/** A sink that writes its reports to a log, which must outlive it, and hands them on to \a next. */
std::unique_ptr<ProgressSink>
MakeLogSink(Log & log, std::unique_ptr<ProgressSink> next);

} // end namespace medialvoxel

#endif
