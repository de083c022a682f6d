# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# Checks the direction of dependency among the ITK-free units: cmake -D SOURCE=<project folder> -P CheckLayers.cmake
# A unit includes only units that stand before it in this table, and no header of ITK.
set(L0 Enums Text Grid Limits Parameters Progress Bits RankedBits Gray Features HoleFinder FileRegion SequentialReader Histogram
    Limit)
# The header formats that are parsed by the module itself.
set(Formats HeaderText NrrdHeader NrrdDataFiles NrrdGeometry NrrdText)
set(L1
    Boundary
    NearestSite
    SiteKey
    RowPass
    DualCell
    PlaneLayout
    BitFlood
    BoundaryGraph
    BoundaryDistances
    GeodesicLandmarks
    BoundedGeodesic
    BoxComponents
    SmallComponents
    PathSearch
    PairSeparation
    BallSieve
    InscribedBalls
    PairChoice
    PairDecision
    Thickness
    GrayBoundary
    GrayThickness
    SurfaceTopology
    SurfaceFit
    SurfacePieces
    SurfaceBranches)
set(L2 FeatureTransform FeatureTransformColumns FeatureTransformSlices CellPairs TileLabels LocalThreshold JointClassifier
    Classifier TileWalls TileObserver SurfaceCrossings SurfaceCells)
set(L3 MemoryError ObjectSource MovingWindow TileSchedule SlabWalker Sums EngineSettings TileResult EngineClient TileTask DistanceTask
    ExtractionTask Execution Engine SurfaceConsumer SurfaceBuilder SurfaceTrimmer SurfaceObserver SurfaceStore Surface)
# What the filters need for pixels of any type.
set(L4 ObjectPredicate DisplacementWriter)
set(units ${L0} ${Formats} ${L1} ${L2} ${L3} ${L4})

file(GLOB files "${SOURCE}/include/itkMedialVoxel*.h" "${SOURCE}/src/*/itkMedialVoxel*.h" "${SOURCE}/src/*/itkMedialVoxel*.cxx")
list(FILTER files EXCLUDE REGEX "/itkMedialVoxelImageFilter[A-Za-z]*\\.h$")
if(NOT files)
  message(FATAL_ERROR "No source of MedialVoxel in '${SOURCE}'")
endif()

set(violations "")
foreach(file IN LISTS files)
  get_filename_component(name "${file}" NAME)
  string(REGEX REPLACE "^itkMedialVoxel|(Private)?\\.[a-z]+$" "" unit "${name}")
  list(FIND units "${unit}" rank)
  if(rank EQUAL -1)
    list(APPEND violations "${name}: not in the table of ITK-free units")
  endif()
  file(STRINGS "${file}" includes REGEX "^[ \t]*#[ \t]*include[ \t]*[\"<](itk|vnl|vcl)")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^[^\"<]*[\"<]([^\">]*).*" "\\1" header "${line}")
    string(REGEX REPLACE "^itkMedialVoxel|(Private)?\\.h$" "" included "${header}")
    list(FIND units "${included}" included_rank)
    if(included_rank EQUAL -1)
      list(APPEND violations "${name}: ${header} is not ITK-free")
    elseif(included_rank GREATER rank)
      list(APPEND violations "${name}: ${header} stands above it")
    endif()
  endforeach()
endforeach()

if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "Dependencies that point the wrong way:\n  ${text}")
endif()
