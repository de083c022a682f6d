// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionTable.h"

namespace medialvoxel
{

const std::vector<OptionRow> &
ListOptions()
{
  static const std::vector<OptionRow> table = [] {
    std::vector<OptionRow> rows;
    for (const auto add : { AddInputRows,
                            AddPlaceRows,
                            AddOutputRows,
                            AddWallRows,
                            AddMeshRows,
                            AddVolumeRows,
                            AddSheetRows,
                            AddJobRows,
                            AddRunRows })
    {
      add(rows);
    }
    return rows;
  }();
  return table;
}

} // end namespace medialvoxel
