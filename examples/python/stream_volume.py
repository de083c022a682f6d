#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Medial cells of a volume that does not fit the memory: reader, threshold, medial filter and writer, piece by piece.

Usage: stream_volume.py VOLUME LABELS --lower L --thickness T [--memory MIB] [--divisions N]
VOLUME: an uncompressed MetaImage or NRRD of type uint8. LABELS: .mha or .nrrd. --memory is a hard cap in MiB on what the
pipeline takes beside the modules of Python that are loaded; the number of pieces follows from it. Needs itk-medialvoxel.
"""

import argparse
import math
import os
import resource

import itk

# The stacks of the threads, and what the filter needs whatever the pieces are.
BASE_MIB = 40
# Bytes of a piece per voxel: what reader, threshold, filter and writer keep of it, and of the slices around it.
BYTES_PER_VOXEL = 6


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volume")
    parser.add_argument("labels")
    parser.add_argument("--lower", type=float, required=True, help="smallest value of the object")
    parser.add_argument("--thickness", type=float, required=True, help="in the units of the spacing")
    parser.add_argument("--memory", type=int, default=256, help="in MiB, more than 40; default 256")
    return parser.parse_args()


def streaming_io(file_name):
    """What reads and writes a file piece by piece; ITK chooses it for MetaImages by itself."""
    return itk.StreamingNrrdImageIO.New() if file_name.endswith((".nrrd", ".nhdr")) else None


def kibibytes(name):
    """A line of what the system knows about the memory of this process: VmData is allocated, VmHWM the peak in use."""
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(name + ":"))


def choose_divisions(image, memory):
    """Pieces small enough for the memory."""
    voxels = math.prod(image.GetLargestPossibleRegion().GetSize())
    return max(1, math.ceil(voxels * BYTES_PER_VOXEL / ((memory - BASE_MIB) << 20)))


def main():
    arguments = parse_arguments()
    reader = itk.ImageFileReader[itk.Image[itk.UC, 3]].New(file_name=arguments.volume)
    if streaming_io(arguments.volume):
        reader.SetImageIO(streaming_io(arguments.volume))
    reader.UpdateOutputInformation()
    threshold = itk.BinaryThresholdImageFilter.New(reader.GetOutput(), lower_threshold=int(arguments.lower), inside_value=1)
    medial = itk.MedialVoxelImageFilter.New(threshold.GetOutput(), thickness=arguments.thickness)
    writer = itk.ImageFileWriter.New(medial.GetOutput(), file_name=arguments.labels)
    if streaming_io(arguments.labels):
        writer.SetImageIO(streaming_io(arguments.labels))
    writer.SetNumberOfStreamDivisions(choose_divisions(reader.GetOutput(), arguments.memory))

    modules = kibibytes("VmRSS")
    cap = (kibibytes("VmData") << 10) + (arguments.memory << 20)
    resource.setrlimit(resource.RLIMIT_DATA, (cap, cap))
    writer.Update()
    counts = medial.GetCounts()
    print(f"medial cells {counts.boundCells + counts.geodesicMedialCells}")
    print(f"volume {os.path.getsize(arguments.volume) >> 20} MiB, pieces {writer.GetNumberOfStreamDivisions()}")
    print(f"memory of the pipeline {(kibibytes('VmHWM') - modules) >> 10} MiB of {arguments.memory} MiB")


if __name__ == "__main__":
    main()
