// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "AccuracyTables.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <string>

namespace
{
struct Table
{
  const char * name;
  void (*print)();
  const char * text;
};

constexpr Table Tables[] = {
  { "thickness", PrintThicknessTable, "plates of voxels in several tilts" },
  { "gray-thickness", PrintGrayThicknessTable, "the same, blurred, on gray values" },
  { "surface", PrintSurfaceTable, "the mesh of binary objects" },
  { "automatic", PrintAutomaticTable, "the sheet of all parts" },
  { "automatic-walls", PrintAutomaticWallsTable, "the sheet of single walls" },
  { "automatic-pores", PrintAutomaticPoresTable, "the sheet beside pores" },
  { "automatic-rims", PrintAutomaticRimsTable, "the sheet at rims" },
};

int
Print(const Table & table)
{
  table.print();
  // What the measures of the tests expect holds for the tables too.
  return testing::UnitTest::GetInstance()->Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
} // namespace

int
main(int argc, char * argv[])
{
  const std::string name = argc == 2 ? argv[1] : "";
  try
  {
    for (const Table & table : Tables)
    {
      if (name == table.name)
      {
        return Print(table);
      }
    }
  }
  catch (const std::exception & error)
  {
    std::cerr << "medialvoxel-accuracy: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  std::cerr << "usage: medialvoxel-accuracy TABLE\n";
  for (const Table & table : Tables)
  {
    std::cerr << "  " << std::left << std::setw(17) << table.name << table.text << '\n';
  }
  return 2;
}
