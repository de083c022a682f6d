// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "AccuracyTables.h"

#include "MedialVoxelTestGrayWalls.h"

#include <cstdio>

using namespace MedialVoxelTest;

void
PrintGrayThicknessTable()
{
  std::printf("| direction | blur | 2 | 3 | 4.3 | 7 | 4.3, gap 1 | 4.3, gap 2 |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const double blur : { 0.0, 0.5, 1.0 })
  {
    for (const Tilt & tilt : Tilts)
    {
      std::printf("| %s | %g |", tilt.name, blur);
      for (const double thickness : { 2.0, 3.0, 4.3, 7.0 })
      {
        const PlateErrors errors = MeasureGrayPlates(tilt.normal, thickness, blur);
        std::printf(" %+.3f / %.3f / %+.2f to %+.2f |", errors.mean, errors.deviation, errors.smallest, errors.largest);
      }
      for (const double gap : { 1.0, 2.0 })
      {
        // A blur closes gaps of one voxel in places.
        if (blur > 0.0)
        {
          std::printf(" |");
        }
        else
        {
          std::printf(" %+.2f |", MeasureGrayPlates(tilt.normal, 4.3, blur, gap).mean);
        }
      }
      std::printf("\n");
    }
  }
}
