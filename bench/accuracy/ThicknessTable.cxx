// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "AccuracyTables.h"

#include "MedialVoxelTestTiltedPlates.h"

#include <cstdio>

using namespace MedialVoxelTest;

void
PrintThicknessTable()
{
  std::printf("| direction | 2 | 3 | 4 | 6 | 8 |\n| --- | --- | --- | --- | --- | --- |\n");
  for (const Tilt & tilt : Tilts)
  {
    std::printf("| %s |", tilt.name);
    for (const double thickness : { 2.0, 3.0, 4.0, 6.0, 8.0 })
    {
      const PlateErrors errors = MeasureTiltedPlates(tilt.normal, thickness);
      std::printf(" %+.2f / %.2f / %+.2f to %+.2f |", errors.mean, errors.deviation, errors.smallest, errors.largest);
    }
    std::printf("\n");
  }
}
