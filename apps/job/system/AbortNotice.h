// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelAbortNotice_h
#define medialvoxelAbortNotice_h

#include <string>

namespace medialvoxel
{

/** \class AbortNotice
 * \brief While it lives, an abort() in its thread becomes a line on the error stream and an exit status.
 *
 * For libraries that end the process where others throw. Nothing is unwound: files under temporary names stay until the
 * next run, as after a kill. One at a time in each thread. */
class AbortNotice
{
public:
  /** \param text of the line behind the name of the program, without an end of the line */
  AbortNotice(int status, const std::string & text);
  ~AbortNotice();

  AbortNotice(const AbortNotice &) = delete;
  AbortNotice &
  operator=(const AbortNotice &) = delete;

private:
  std::string m_Line;
};

/** The beginning of the lines of abort(); before any notice. */
void
SetNameForAborts(const std::string & programName);

} // end namespace medialvoxel

#endif
