// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProgress_h
#define medialvoxelProgress_h

#include "LogRecord.h"

#include <memory>
#include <string>

namespace medialvoxel
{

/** \class ProgressSink
 * \brief Hears how far a job is, and may stop it.
 *
 * The job calls Start() once, Report() with fractions that never fall, and Finish() once when all outputs are
 * complete. */
class ProgressSink
{
public:
  virtual ~ProgressSink() = default;
  virtual void
  Start(const std::string & name, const std::string & comment);
  virtual void
  Report(double fraction);
  virtual void
  Finish(double seconds);

  /** Shows the last fraction again when due, while no new one comes. */
  virtual void
  Heartbeat();

  /** Takes one line about a step of the job, for example that it unpacked a volume. */
  virtual void
  Note(const std::string & text);

  /** Takes a warning that a user must know before the results are used. By default a note. \param code one word for
   * scripts */
  virtual void
  Warn(const std::string & code, const std::string & message);

  /** Hears of each step; only a log shows it. */
  virtual void
  Record(const LogRecord & record);

  /** Asked several times a second. By default true once the process got SIGINT, SIGTERM or SIGHUP. */
  virtual bool
  IsStopRequested() const;
};

/** \throw StoppedBySignal when the sink asks to stop. */
void
ThrowIfStopRequested(const ProgressSink & sink);

/** Ways to show progress. Auto is Bar when the error stream is a terminal, else Plain. */
enum class ProgressStyle
{
  Auto,
  Bar,       ///< a line on the error stream that redraws itself, with the time left
  Plain,     ///< a line on the error stream every 30 s
  Slicer,    ///< the tags of 3D Slicer's command line modules on the output stream
  JsonLines, ///< an object per line on the error stream
  None,      ///< notes only
  Quiet      ///< nothing at all
};

std::unique_ptr<ProgressSink>
MakeProgressSink(ProgressStyle style);

} // end namespace medialvoxel

#endif
