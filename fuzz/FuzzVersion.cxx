// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Stands for that of the report, which would bring in all of the job, and stays when the version changes.
#include "Report.h"

std::string
medialvoxel::GetVersion()
{
  return "fuzzed";
}
