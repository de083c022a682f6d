# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes the slices of a volume as images, with pydicom, GDCM, tifffile and Pillow.

Usage: write_slices.py KIND SPECIFICATION     kinds: dicom, tifffile, pillow; the specification is JSON
"""

import io
import json
import pathlib
import random
import sys

import numpy

SYNTAXES = {
    "explicit": "1.2.840.10008.1.2.1",
    "implicit": "1.2.840.10008.1.2",
    "big": "1.2.840.10008.1.2.2",
    "rle": "1.2.840.10008.1.2.5",
    "jpeg-ls": "1.2.840.10008.1.2.4.80",
    "jpeg": "1.2.840.10008.1.2.4.70",
    "jpeg-2000": "1.2.840.10008.1.2.4.90",
}


def write_dicom(voxels, spec):
    """Numbers are stored as voxels - intercept; the names of the files are shuffled."""
    import pydicom
    from pydicom.dataset import Dataset, FileMetaDataset

    directions = spec.get("directions", [1, 0, 0, 0, 1, 0])
    normal = numpy.cross(directions[:3], directions[3:])
    spacing, origin = spec.get("spacing", [1, 1, 1]), numpy.array(spec.get("origin", [0, 0, 0]), float)
    syntax = spec.get("syntax", "explicit")
    plain = syntax if syntax in ("implicit", "big") else "explicit"
    names = list(range(len(voxels)))
    random.Random(spec.get("seed", 1)).shuffle(names)
    intercept, slope, bits = spec.get("intercept", 0), spec.get("slope", 1), spec.get("bits", 16)
    places = spec.get("places", [spacing[2] * number for number in range(len(voxels))])
    for number, slice_ in enumerate(voxels):
        data = Dataset()
        data.file_meta = FileMetaDataset()
        data.file_meta.TransferSyntaxUID = SYNTAXES[plain]
        data.SOPClassUID = data.file_meta.MediaStorageSOPClassUID = "1.2.840.10008.5.1.4.1.1.2"
        data.SOPInstanceUID = data.file_meta.MediaStorageSOPInstanceUID = f"{spec['series']}.{number + 1}"
        data.Modality, data.PatientName, data.PatientID = "CT", "Nobody", "0"
        data.StudyInstanceUID, data.SeriesInstanceUID = "1.2.3", spec["series"]
        data.SeriesDescription = spec.get("description", "")
        data.InstanceNumber = spec["numbers"][number] if "numbers" in spec else len(voxels) - number
        if spec.get("has_position", True):
            shear = numpy.array(spec.get("shear", [0, 0, 0])) * number
            data.ImagePositionPatient = [f"{c:.10g}" for c in origin + normal * places[number] + shear]
            data.ImageOrientationPatient = [f"{c:.12g}" for c in directions]
        data.PixelSpacing = [f"{spacing[1]:.10g}", f"{spacing[0]:.10g}"]  # of rows first
        data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
        data.Rows, data.Columns = slice_.shape
        data.BitsAllocated, data.BitsStored, data.HighBit = 16, bits, bits - 1
        data.PixelRepresentation = 1 if spec.get("is_signed") else 0
        own_slope = spec["slopes"][number] if "slopes" in spec else slope
        data.RescaleIntercept, data.RescaleSlope = str(intercept), str(own_slope)
        stored = numpy.rint((slice_.astype(float) - intercept) / own_slope).astype(int) & ((1 << bits) - 1)
        data.PixelData = stored.astype(">u2" if plain == "big" else "<u2").tobytes()
        data["PixelData"].VR = "OW"
        for keyword, value in {**spec.get("all", {}), **spec.get("changes", {}).get(str(number), {})}.items():
            setattr(data, keyword, bytes(value) if keyword == "PixelData" else value)
        for keyword in spec.get("missing", []):
            delattr(data, keyword)
        data.is_little_endian, data.is_implicit_VR = plain != "big", plain == "implicit"
        if syntax == "rle":
            data.compress(pydicom.uid.RLELossless)
        path = pathlib.Path(spec["folder"]) / spec.get("name", "IM{:04}").format(names[number])
        data.save_as(str(path), write_like_original=False)
        if syntax not in (plain, "rle"):
            change_syntax(path, syntax)
        if "spacing_text" in spec:
            old = f"{spacing[1]:.10g}\\{spacing[0]:.10g}".encode().ljust(len(spec["spacing_text"]))
            path.write_bytes(path.read_bytes().replace(old, spec["spacing_text"].encode()))
        with open(path, "ab") as file:
            file.write(bytes(spec.get("bytes_behind", [])))


def change_syntax(path, syntax):
    import gdcm

    names = {"jpeg-ls": "JPEGLSLossless", "jpeg": "JPEGLosslessProcess14_1", "jpeg-2000": "JPEG2000Lossless"}
    reader = gdcm.ImageReader()
    reader.SetFileName(str(path))
    assert reader.Read()
    change = gdcm.ImageChangeTransferSyntax()
    change.SetTransferSyntax(gdcm.TransferSyntax(getattr(gdcm.TransferSyntax, names[syntax])))
    change.SetInput(reader.GetImage())
    assert change.Change()
    writer = gdcm.ImageWriter()
    writer.SetFileName(str(path))
    writer.SetFile(reader.GetFile())
    writer.SetImage(change.GetOutput())
    assert writer.Write()


def write_tifffile(voxels, spec):
    import tifffile

    for number, slice_ in enumerate(voxels, spec.get("first", 0)):
        path = pathlib.Path(spec["folder"]) / spec["name"].format(number)
        tifffile.imwrite(str(path), slice_, **spec.get("options", {}))


def write_pillow(voxels, spec):
    from PIL import Image

    for number, slice_ in enumerate(voxels, spec.get("first", 0)):
        image = Image.fromarray(slice_)
        if "mode" in spec:
            image = image.convert(spec["mode"])
        content = io.BytesIO()
        path = pathlib.Path(spec["folder"]) / spec["name"].format(number)
        image.save(content, {".jpg": "JPEG"}.get(path.suffix, path.suffix[1:].upper()), **spec.get("options", {}))
        path.write_bytes(content.getvalue())


if __name__ == "__main__":
    specification = json.loads(sys.argv[2])
    size = specification["size"]
    data_ = numpy.fromfile(specification["raw"], specification["type"]).reshape(size[::-1])
    kept = [number for number in range(len(data_)) if number not in specification.get("without", [])]
    if specification.get("without"):
        specification["places"] = [specification["spacing"][2] * number for number in kept]
    {"dicom": write_dicom, "tifffile": write_tifffile, "pillow": write_pillow}[sys.argv[1]](data_[kept], specification)
