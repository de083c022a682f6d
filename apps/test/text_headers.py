# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Headers of keys and values as programs of scanners write them, beside a .vol file."""

import array
import pathlib

import volumes

VGI_TYPES = {"uint": "unsigned integer", "int": "signed integer", "float": "float"}
PCR_FORMATS = {"uint8": 1, "uint16": 5, "float32": 10}


def vgi(volume, name):
    kind = volume.kind.rstrip("0123456789")
    bits = 8 * array.array(volumes.TYPES[volume.kind][0]).itemsize
    size = volumes.join(volume.size)
    return f"""{{volume1}}
[representation]
size = {size}
mirror = 0 0 0 0
datatype = {VGI_TYPES[kind]}
datarange = 0 -1
bitsperelement = {bits}
[file1]
SkipHeader = 0
RegionOfInterestStart = 0 0 0
RegionOfInterestEnd = {volumes.join(count - 1 for count in volume.size)}
FileFormat = raw
Size = {size}
Name = {name}
Datatype = {VGI_TYPES[kind]}
datarange = 0 -1
BitsPerElement = {bits}
{{volumeprimitive12}}
[geometry]
resolution = {volumes.join(volume.spacing)}
unit = mm
[volume]
volume = volume1
[description]
text = part
"""


def pcr(volume, name):
    sizes = "".join(f"Volume_Size{axis}={count}\n" for axis, count in zip("XYZ", volume.size))
    return f"""[Versions]
Version-datos|x=2.2.1
[VolumeData]
{sizes}Format={PCR_FORMATS.get(volume.kind, 5)}
VoxelSizeRec={volume.spacing[0]}
VOL_File=D:\\scans\\{name}
[ImageData]
PCA_File=part.pca
"""


def pyhst(volume, _):
    sizes = "".join(f"NUM_{axis} =  {count}\n" for axis, count in zip("XYZ", volume.size))
    return f"""! PyHST_SLAVE VOLUME INFO FILE
{sizes}voxelSize =  {1e3 * volume.spacing[0]}
BYTEORDER = LOWBYTEFIRST
DATA_TYPE = {volume.kind}
ValMin =  0.0
ValMax =  1.0
s1 =  0.0
s2 =  1.0
S1 =  0.0
S2 =  1.0
"""


DIALECTS = {".vgi": vgi, ".pcr": pcr, ".info": pyhst}


def write(path, volume, big_endian=False, before=b"", changes=()):
    """Writes the header and the voxels beside it; changes replace the first of two texts by the second."""
    path = pathlib.Path(path)
    voxels = path.with_suffix("") if path.suffix == ".info" else path.with_suffix(".vol")
    text = DIALECTS[path.suffix](volume, voxels.name)
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    path.write_text(text, encoding="latin-1")
    voxels.write_bytes(before + volume.data(big_endian))
    return path
