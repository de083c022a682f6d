# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes a volume as one DICOM file with a frame for each slice, with pydicom and GDCM.

Usage: write_frames.py SPECIFICATION     JSON; see main()
"""

import json
import pathlib
import sys

import numpy
import pydicom
from pydicom.dataset import Dataset, FileMetaDataset
from pydicom.sequence import Sequence
from write_slices import change_syntax

SYNTAXES = {
    "explicit": "1.2.840.10008.1.2.1",
    "implicit": "1.2.840.10008.1.2",
    "big": "1.2.840.10008.1.2.2",
    "deflated": "1.2.840.10008.1.2.1.99",
}
ENHANCED_CT, SECONDARY_CAPTURE = "1.2.840.10008.5.1.4.1.1.2.1", "1.2.840.10008.5.1.4.1.1.7.3"


def group(**elements):
    """A sequence with one item."""
    item = Dataset()
    for keyword, value in elements.items():
        setattr(item, keyword, value)
    return Sequence([item])


def text(number):
    return f"{number:.10g}"


def functional_groups(spec, intercepts, slopes):
    """Shared ones and those of each frame: what is equal for all is shared."""
    shared = Dataset()
    spacing = spec["spacing"]
    shared.PixelMeasuresSequence = group(PixelSpacing=[text(spacing[1]), text(spacing[0])])
    shared.PlaneOrientationSequence = group(ImageOrientationPatient=[text(c) for c in spec["directions"]])
    scales = [
        group(RescaleIntercept=text(intercept), RescaleSlope=text(slope), RescaleType="HU")
        for intercept, slope in zip(intercepts, slopes)
    ]
    if spec.get("scale_is_shared", True):
        shared.PixelValueTransformationSequence = scales[0]
    normal = numpy.cross(spec["directions"][:3], spec["directions"][3:])
    frames = []
    for number, place in enumerate(spec["places"]):
        frame = Dataset()
        if not spec.get("scale_is_shared", True):
            frame.PixelValueTransformationSequence = scales[number]
        frame.PlanePositionSequence = group(
            ImagePositionPatient=[text(c) for c in numpy.array(spec["origin"]) + normal * place]
        )
        content = {"StackID": "1", "InStackPositionNumber": number + 1}
        if "times" in spec:
            content["TemporalPositionIndex"] = spec["times"][number]
        frame.FrameContentSequence = group(**content)
        frames.append(frame)
    return Sequence([shared]), Sequence(frames)


def write(voxels, spec):
    """Frames are stored in the order of "order", which "places" lists too."""
    count = len(voxels)
    spec = {
        "directions": [1, 0, 0, 0, 1, 0],
        "origin": [0, 0, 0],
        "order": list(range(count)),
        "intercepts": [-1024] * count,
        "slopes": [1] * count,
        "bits": 16,
        "syntax": "explicit",
        **spec,
    }
    spec.setdefault("places", [spec["spacing"][2] * number for number in spec["order"]])
    voxels = voxels[spec["order"]]
    syntax = spec["syntax"]
    plain = syntax if syntax in SYNTAXES else "explicit"
    data = Dataset()
    data.file_meta = FileMetaDataset()
    data.file_meta.TransferSyntaxUID = SYNTAXES[plain]
    data.SOPClassUID = ENHANCED_CT if spec["groups"] else SECONDARY_CAPTURE
    data.file_meta.MediaStorageSOPClassUID = data.SOPClassUID
    data.SOPInstanceUID = data.file_meta.MediaStorageSOPInstanceUID = "1.2.3.4.5"
    data.Modality, data.PatientName, data.PatientID = "CT", "Nobody", "0"
    data.StudyInstanceUID, data.SeriesInstanceUID = "1.2.3", "1.2.3.4"
    data.InstanceNumber, data.NumberOfFrames = 1, count
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    data.Rows, data.Columns = voxels.shape[1:]
    data.BitsAllocated, data.BitsStored, data.HighBit = 16, spec["bits"], spec["bits"] - 1
    data.PixelRepresentation = 1 if spec.get("is_signed") else 0
    if spec["groups"]:
        data.SharedFunctionalGroupsSequence, data.PerFrameFunctionalGroupsSequence = functional_groups(
            spec, spec["intercepts"], spec["slopes"]
        )
    else:
        data.PixelSpacing = [text(spec["spacing"][1]), text(spec["spacing"][0])]
        data.RescaleIntercept, data.RescaleSlope = text(spec["intercepts"][0]), text(spec["slopes"][0])
    intercepts, slopes = (numpy.reshape(spec[name], (-1, 1, 1)) for name in ("intercepts", "slopes"))
    stored = numpy.rint((voxels.astype(float) - intercepts) / slopes).astype(int) & ((1 << spec["bits"]) - 1)
    data.PixelData = stored.astype(">u2" if plain == "big" else "<u2").tobytes()
    data["PixelData"].VR = "OW"
    for keyword, value in spec.get("all", {}).items():
        setattr(data, keyword, bytes(value) if keyword == "PixelData" else value)
    data.is_little_endian, data.is_implicit_VR = plain != "big", plain == "implicit"
    if syntax == "rle":
        data.compress(pydicom.uid.RLELossless)
    path = pathlib.Path(spec["file"])
    data.save_as(str(path), write_like_original=False)
    if syntax not in SYNTAXES and syntax != "rle":
        pack(data, path, syntax, spec.get("fragments", 1))


def pack(data, path, syntax, fragments):
    """Packs the frames by GDCM, which knows no functional groups, and puts each into so many fragments."""
    from pydicom.encaps import encapsulate, generate_pixel_data_frame

    change_syntax(path, syntax)
    packed = pydicom.dcmread(str(path))
    frames = list(generate_pixel_data_frame(packed.PixelData, data.NumberOfFrames))
    data.file_meta.TransferSyntaxUID = packed.file_meta.TransferSyntaxUID
    data.PixelData = encapsulate(frames, fragments_per_frame=fragments, has_bot=True)
    data["PixelData"].is_undefined_length = True
    data["PixelData"].VR = "OB"
    data.save_as(str(path), write_like_original=False)


def main():
    spec = json.loads(sys.argv[1])
    write(numpy.fromfile(spec["raw"], spec["type"]).reshape(spec["size"][::-1]), spec)


if __name__ == "__main__":
    main()
