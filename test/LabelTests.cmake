# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# CTest reads this after the lists of the GoogleTests, and runs those with the highest COST first.

# Against brute force, for many divisions, on real volumes, or of stops, at length; the others take less than a minute
# together.
set(_identity
    "Identity|AnyDivision|AnyCut|SameBytes|BruteForce|Oracle|PlainDijkstra|Damaged|FindsTheNearestVoxels|InMemoryReference"
    "|ThreadsDoNotChange|MedialVoxelAbortCheck|MedialVoxelRealData|MedialVoxelObjectMaps|MedialVoxelSurfaceManifold"
    "|MedialVoxelSurfaceGray|MedialVoxelSurfaceCells|MedialVoxelRemeshedSheet|MedialVoxelSheetPart|MedialVoxelBoundaryGraph"
    "|MedialVoxelAutomaticQuality|MedialVoxelGrayThickness|MedialVoxelThickness\\.Tilted|MedialVoxelSurfaceQuality"
    "|TilesAreTheDefinitions|NothingStaysOfTheTilesBefore|MedialVoxelAbort")
string(CONCAT _identity ${_identity})

foreach(_test IN LISTS MedialVoxelGTestDriver_TESTS MedialVoxelShellGTestDriver_TESTS MedialVoxelJobGTestDriver_TESTS)
  if(_test MATCHES "${_identity}")
    set_tests_properties("${_test}" PROPERTIES LABELS "MedialVoxel;identity" COST 20)
  else()
    set_tests_properties("${_test}" PROPERTIES LABELS "MedialVoxel;unit")
  endif()
endforeach()
