# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes a volume with the libraries of others, into files that MedialVoxel reads.

Usage: write_volumes.py FOLDER X,Y,Z SPACING,SPACING,SPACING
FOLDER has the voxels, 16-bit integers with sign, in in.raw. Prints a line for each file: its name, its type, and how
it is read, "streams" or "does not stream". A file with "refused" in its name must be refused; in place of how it is read
there is a word of the message.
"""

import pathlib
import sys

import mrcfile
import nibabel
import numpy
import tifffile

MICROMETERS = 1e3
ANGSTROMS = 1e7


def write_mrc(folder, voxels, spacing):
    for kind in ("int8", "int16", "uint16", "float32"):
        for order in ("<", ">"):
            name = f"{kind}{'l' if order == '<' else 'b'}.{'rec' if kind == 'int8' else 'mrc'}"
            with mrcfile.new(folder / name) as file:
                file.set_data(voxels.astype(kind).astype(order + numpy.dtype(kind).str[1:]))
                file.set_volume()
                file.voxel_size = tuple(ANGSTROMS * value for value in spacing)
                file.update_header_stats()
            yield name, kind, "streams"
    with mrcfile.new(folder / "extended.map") as file:
        file.set_data(voxels)
        file.set_volume()
        file.set_extended_header(numpy.zeros(7, "V80"))
        file.voxel_size = tuple(ANGSTROMS * value for value in spacing)
    yield "extended.map", "int16", "streams"
    for name, kind in (("float16", "float16"), ("complex", "complex64")):
        mrcfile.write(folder / f"refused-{name}.mrc", voxels.astype(kind))
        yield f"refused-{name}.mrc", kind, "MODE"
    with mrcfile.new(folder / "refused-stack.mrc") as file:
        file.set_data(voxels[None])
    yield "refused-stack.mrc", "int16", "ISPG"


def write_nifti(folder, voxels, spacing):
    affine = numpy.diag([*spacing, 1.0])
    for image_class, version in ((nibabel.Nifti2Image, 2), (nibabel.Nifti1Image, 1)):
        for order in ("<", ">"):
            header = image_class.header_class(endianness=order)
            header.set_data_dtype("int16")
            header.set_xyzt_units("mm")
            image = image_class(voxels.T, affine, header)
            for extension in (".nii", ".nii.gz"):
                name = f"version{version}{'l' if order == '<' else 'b'}{extension}"
                nibabel.save(image, folder / name)
                yield name, "int16", "does not stream" if extension == ".nii.gz" else "streams"
    for image_class, version in ((nibabel.Nifti2Pair, 2), (nibabel.Nifti1Pair, 1)):
        name = f"pair{version}.hdr"
        image = image_class(voxels.T, affine)
        image.header.set_xyzt_units("mm")
        nibabel.save(image, folder / name)
        yield name, "int16", "streams"
    nibabel.save(nibabel.AnalyzeImage(voxels.T, affine), folder / "refused-analyze.hdr")
    yield "refused-analyze.hdr", "int16", "pair"


def write_tiff(folder, voxels, spacing):
    def save(name, data, **options):
        tifffile.imwrite(folder / name, data, photometric="minisblack", **options)

    dots = {"resolution": (10 / spacing[0], 10 / spacing[1]), "resolutionunit": "CENTIMETER"}
    for big in (False, True):
        for order in ("<", ">"):
            for tile in ((16, 16), (32, 64), (256, 256)):
                for compression in (None, "deflate", "lzw", "zstd"):
                    options = {"bigtiff": big, "byteorder": order, "tile": tile, "metadata": None, **dots}
                    name = f"{'big' if big else 'classic'}{'l' if order == '<' else 'b'}{tile[0]}{compression}.tif"
                    save(name, voxels, compression=compression, predictor=compression is not None, **options)
                    yield name, "int16", "does not stream" if compression else "streams"
    save("strips.tif", voxels, bigtiff=True, compression="zstd", rowsperstrip=7, metadata=None, **dots)
    yield "strips.tif", "int16", "does not stream"
    for kind in ("uint8", "uint16", "int32", "float32", "float64"):
        save(f"{kind}.tif", voxels.astype(kind), bigtiff=True, tile=(64, 32), metadata=None, **dots)
        yield f"{kind}.tif", kind, "streams"
    units = {"unit": "micron", "spacing": MICROMETERS * spacing[2]}
    save(
        "imagej.tif",
        voxels,
        imagej=True,
        resolution=(1 / (MICROMETERS * spacing[0]), 1 / (MICROMETERS * spacing[1])),
        metadata={"axes": "ZYX", **units},
    )
    yield "imagej.tif", "int16", "streams"
    sizes = {f"PhysicalSize{axis}": MICROMETERS * value for axis, value in zip("XYZ", spacing)}
    save("ome.tif", voxels, ome=True, tile=(32, 32), metadata={"axes": "ZYX", **sizes})
    yield "ome.tif", "int16", "streams"
    save("refused-channels.tif", voxels, ome=True, metadata={"axes": "CYX"})
    yield "refused-channels.tif", "int16", "channels"
    save("refused-channels-imagej.tif", voxels, imagej=True, metadata={"axes": "CYX"})
    yield "refused-channels-imagej.tif", "int16", "channels"
    save("refused-depth.tif", voxels, volumetric=True, tile=(16, 16, 16), metadata=None)
    yield "refused-depth.tif", "int16", "one slice"
    for name, other in (("type", voxels[0].astype("uint8")), ("size", voxels[0][1:])):
        with tifffile.TiffWriter(folder / f"refused-{name}.tif", bigtiff=True) as file:
            file.write(voxels, tile=(32, 32), photometric="minisblack", metadata=None)
            file.write(other, tile=(32, 32), photometric="minisblack", metadata=None)
        yield f"refused-{name}.tif", "int16", "differ"


def main():
    folder = pathlib.Path(sys.argv[1])
    size = [int(value) for value in sys.argv[2].split(",")]
    spacing = [float(value) for value in sys.argv[3].split(",")]
    voxels = numpy.fromfile(folder / "in.raw", "<i2").reshape(size[::-1])
    for write in (write_mrc, write_nifti, write_tiff):
        for line in write(folder, voxels, spacing):
            print("\t".join(line))


if __name__ == "__main__":
    main()
