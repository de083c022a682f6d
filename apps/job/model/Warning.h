// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWarning_h
#define medialvoxelWarning_h

#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** What a user must know before a result is used. The job itself goes on, and its exit status does not change. */
struct Warning
{
  std::string                                 code;    ///< for scripts: small letters, words joined by underscores
  std::string                                 message; ///< for readers: one line without a period at its end
  std::vector<std::pair<std::string, double>> values;  ///< the numbers of the message by their names, all finite
};

} // end namespace medialvoxel

#endif
