// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionDetails.h"

namespace medialvoxel
{

const std::vector<OptionDetails> &
ListOptionDetails()
{
  static const std::vector<OptionDetails> rows{
    { "",
      "--slices",
      "Counted from 0 in the order of the slices; of a pattern with %d the numbers in the names. Both belong to the "
      "volume." },
    { "",
      "--spacing",
      "Default: that of the file, or 1. From 1e-12 to 1e12; the largest at most 1000 times the smallest." },
    { "", "--level", "Needs an OME-Zarr image with so many levels. Each has about half the size of the one before." },
    { "",
      "--resample",
      "The input is brought to this spacing while it is read. Values between voxels are linear with a threshold; "
      "without one, or with one value for both, the nearest voxel counts. Default: auto for sheets and thickness where "
      "the largest spacing is more than 4 times the smallest, otherwise off." },
    { "", "--thickness", "In units of the spacing; greater than 0. A number gives all cells the same threshold." },
    { "", "--minimum-thickness", "In units of the spacing. Needs the thickness auto." },
    { "", "--maximum-thickness", "In units of the spacing. Needs the thickness auto. Time and memory grow with it." },
    { "",
      "--max-pore-size",
      "In voxels, from 0 to 1000000. Cavities and grains of up to this size are taken for noise; 0 keeps all." },
    { "",
      "--smooth",
      "on: smooth the values when one threshold is given, otherwise the mask; edges and thin walls stay in place. "
      "auto: "
      "when 0.75 % or more of the border voxels stand alone, which reads the volume once more. Default: auto with the "
      "thickness auto, otherwise off." },
    { "", "--voxel-units", "Coordinates and thickness of meshes stay in units of the spacing." },
    { "",
      "--lower",
      "Values of at least L are object. Whole numbers of 64 bits are exact. otsu measures L on the values, which "
      "reads "
      "the volume once more, or twice for more than 16 bits." },
    { "", "--upper", "Values of at most U are object." },
    { "", "--label", "From -2^63 to 2^64 - 1. Not with --lower and --upper." },
    { "",
      "--labels",
      "Objects that touch are kept apart, and each has a row in the report. all: every value but 0, at most 65535, and "
      "at most 128 side by side. "
      "L1: a value, or the name of a segment. "
      "Labels of cells are those of runs with one --label at a time, put together." },
    { "",
      "--segments",
      "A color table of 3D Slicer (.ctbl, .txt, .csv, .tsv) or a segmentation (.nrrd, .nhdr). Default: names of the "
      "input, where it is a segmentation." },
    { "",
      "--objects",
      "Of the type of the input, on the grid of the labels. A cell that is medial for several objects has the smallest "
      "label. Named .seg.nrrd, 3D Slicer loads it as a segmentation with the names and colors." },
    { "",
      "--vectors",
      "32-bit real components x, y, z at object voxels, 0 elsewhere; in units of the spacing, along the axes of "
      "space." },
    { "", "--vector-boundary", "object: border voxels of the object. background: background voxels beside it." },
    { "", "--boundary", "object: border voxels of the object, as ITK's SignedMaurer. background: voxels beside it." },
    { "", "--maximum-distance", "In units of the spacing; greater than 0. Default: none." },
    { "",
      "--thickness-map",
      "32-bit real, on the grid of the labels: positive at medial cells, negative at rims, 0 elsewhere." },
    { "",
      "--uncertainty-map",
      "32-bit real, on the grid of the labels: NaN at medial cells where it is not known. Needs one threshold, walls "
      "of "
      "5 voxels and an input that streams." },
    { "",
      "--local-thickness",
      "32-bit real, on the grid of the input: the thickness of the wall or the ball that covers the center of the "
      "voxel, 0 outside the object. Not with --labels." },
    { "",
      "--local-thickness-method",
      "wall: thickness, as in --thickness-map, of the wall whose ball is the largest that covers the voxel; NaN in "
      "edges "
      "and corners that no wall covers. sphere: diameter of the largest ball inside the object that does, for "
      "comparison with other programs." },
    { "",
      "--largest-ball",
      "In units of the spacing; at most 256 voxels. Larger balls are cut to it. Time and memory grow with it." },
    { "",
      "--sub-voxel",
      "Fits blurred walls to the values where the scan has walls of 5 voxels; otherwise finds where values cross the "
      "threshold. Masks and label maps are measured on the object. Labels stay the same. Default: on where one threshold "
      "cuts the values." },
    { "", "--levels", "Default: those of the scan. Needs one threshold, which is between them; M is in the object." },
    { "", "--thickness-csv", "A line for each bin: thickness, cells, area of the sheet." },
    { "",
      "--thin-below",
      "T or T,G in units of the spacing; greater than 0. A place is connected medial cells with walls thinner than G, "
      "one of them "
      "thinner than T; default of G: 1.125 T. Measured as --thickness-map. Walls thinner than 3 voxels may have holes. "
      "Not with --labels." },
    { "",
      "--thick-above",
      "T or T,G in units of the spacing; default of G: 0.875 T. Walls thicker than --maximum-thickness have no medial "
      "cells." },
    { "", "--smallest-place", "In squared units of the spacing; default: that of ten faces of voxels. 0 keeps all." },
    { "",
      "--places",
      "The 10000 largest of each kind, the largest first: area, cells, thickness; position and index of the thinnest "
      "(thickest) cell, its two opposite boundary voxels, first and last index." },
    { "",
      "--fail-if-thin",
      "6: there are no thin places, but too little was measured to know. All outputs are written. Needs "
      "--thin-below." },
    { "",
      "--mesh",
      "The medial surface, as medialvoxel mesh writes it. With --labels: that of each object, told apart." },
    { "surface",
      "--largest-ball",
      "In units of the spacing; at most 256 voxels. Larger balls are cut to it, and longer rays have no answer. Time "
      "and memory grow with it." },
    { "surface",
      "--local-thickness-method",
      "wall: thickness of the wall whose ball is the largest that covers the object voxel beside the vertex; NaN in "
      "edges and corners that no wall covers. sphere: diameter of the largest ball inside the object that does." },
    { "surface",
      "--max-pore-size",
      "In voxels, from 0 to 1000000. Pores and grains of up to this size stay in the surface; 0 measures beside "
      "them." },
    { "surface",
      "--sub-voxel",
      "Vertices are where linear values cross the threshold, and walls are fitted to values where these allow it; "
      "in masks and label maps, vertices are in the middle between voxels. Default: on where one threshold cuts the "
      "values." },
    { "surface", "--open", "Otherwise it is closed half a voxel beyond the last voxels." },
    { "surface",
      "--ray",
      "A second number of each vertex, ray_thickness: the way through the part along the smoothed gradient to the "
      "opposite surface. NaN where the way leaves the volume or is longer than --largest-ball." },
    { "",
      "--thickness-at",
      "sections (default): elements of nearly the same thickness share a section, as every solver reads. nodes: .inp "
      "has "
      "it at nodes, .bdf and .k at the corners of elements. Needs a mesh in .inp, .bdf or .k." },
    { "",
      "--section-width",
      "In units of the spacing; default: a quarter of the smallest spacing. Needs a mesh in .inp, .bdf or .k with "
      "sections." },
    { "",
      "--element-size",
      "In units of the spacing; elements are as long as the wall is thick at least at junctions and bends. auto "
      "(default of .inp, .bdf and .k): as long as the wall is thick, at least two voxels. voxel (default of other "
      "meshes): one face a voxel. Needs a mesh." },
    { "",
      "--extend-rims",
      "The sheet ends half the thickness of its wall before each free edge of the part. It is carried on in its plane "
      "to "
      "the surface, at most for the thickness; with --labels for half the thickness. Needs an element size." },
    { "", "--triangles", "Along the shorter diagonal." },
    { "", "--smallest-component", "Default 0, which keeps all. Holds the whole surface in memory." },
    { "",
      "--min-branch-length",
      "In units of the spacing; default 0, which keeps all. Holds the whole surface in memory." },
    { "", "--preview", "With --thickness-map a second picture has the colors of the thickness." },
    { "", "--html", "One file that opens offline, with the sheet in 3-D." },
    { "", "--report", "With - it takes the place of the table." },
    { "",
      "--memory",
      "A hard limit on the peak of the process. It changes the speed, never the results. K, M, G and T are powers of "
      "1024." },
    { "",
      "--scratch",
      "Compressed input that does not fit the memory, and vertices and faces of meshes, wait there in files "
      "without a "
      "name." },
    { "", "--threads", "Results do not depend on it." },
    { "", "--divisions", "Results do not depend on it." },
    { "plan", "--divisions", "Number of clusters. Results do not depend on it." },
    { "", "--dry-run", "Writes nothing." },
    { "", "--sparse", "Not in jobs of several processes." },
    { "",
      "--overwrite",
      "Without it the run is refused with status 3. Old files stay until the new ones are complete." },
    { "", "--quiet", "Warnings are left out too." },
    { "", "--log-file", "Several processes may share it. Lines that are there stay." },
    { "", "--log-level", "Lines that are less urgent are left out." },
    { "",
      "--compress",
      "zlib for .mha, gzip for .nrrd. Packed files do not stream. Not in jobs of several processes." },
    { "",
      "--zarr-compression",
      "Needs a .zarr output. blosc-zstd makes smaller files than gzip, and makes them sooner." },
    { "", "--resume", "The job folder is OUTPUT.job until the run is complete. The same command continues." },
    { "", "--raw-size", "2 or 3 numbers, x first. The file must have exactly this size." },
    { "", "--values", "Reads the volume once, or twice for values of more than 16 bits." },
    { "", "--clusters", "Counted from 0." },
    { "", "--slurm", "Prints the commands that submit it, too. on and off are no file names, but ./on is one." },
    { "", "--slurm-clusters", "Default: so many that there are up to 64 tasks." },
    { "", "--no-verify", "For file systems that have checksums of their own." },
  };
  return rows;
}

std::string
GetOptionDetails(const std::string & command, const std::string & option)
{
  std::string text;
  for (const OptionDetails & row : ListOptionDetails())
  {
    const bool isOfCommand = command == row.command;
    if (option == row.option && (isOfCommand || (*row.command == '\0' && text.empty())))
    {
      text = row.text;
    }
  }
  return text;
}

} // end namespace medialvoxel
