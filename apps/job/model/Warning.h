// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWarning_h
#define medialvoxelWarning_h

#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** What a user must know before a result is used. The job itself goes on; without evidence there is no verdict on
 * walls. */
struct Warning
{
  std::string                                 code;    ///< for scripts: small letters, words joined by underscores
  std::string                                 message; ///< for readers: one line without a period at its end
  std::vector<std::pair<std::string, double>> values;  ///< the numbers of the message by their names, all finite
  bool                                        isOfEvidence{ false }; ///< too little was measured for a verdict on walls
};

} // end namespace medialvoxel

#endif
