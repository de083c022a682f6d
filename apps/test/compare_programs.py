# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares the outputs of a program with those of MEDIALVOXEL_PROGRAM, on the real volumes.

Usage: compare_programs.py FOLDER WORD... -- COMMAND...
  FOLDER: of the volumes
  WORD: do only the runs whose names begin with one of these
  COMMAND: the other program, e.g. qemu-aarch64-static build/cross/medialvoxel
"""

import base64
import hashlib
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import zlib

from jobs import results
from program import PROGRAM

SCANS = {
    "engine": ("engine.mha", "72"),
    "shell": ("shell.nrrd", "65"),
    "cranium": ("cranium.mha", "200"),
    # The threshold of the program.
    "otsu": ("cranium.mha", "otsu"),
}

MAPS = "--thickness-map t.mha --vectors v.mha --distance d.mha --local-thickness o.mha"
PLACES = "--thin-below 2.5 --thick-above 6 --places p.csv --report r.json --html p.html --preview p.png"

# Of each run: scan, command, first output, options.
RUNS = (
    ("engine", "extract", "l.mha", f"--uncertainty-map u.mha {MAPS} {PLACES}"),
    ("shell", "extract", "l.mha", f"--uncertainty-map u.mha {MAPS} {PLACES}"),
    ("cranium", "extract", "l.mha", f"{MAPS} {PLACES}"),
    ("otsu", "extract", "l.nrrd", "--thickness-map t.nii --report r.json"),
    ("engine", "extract", "l.nhdr", "--smooth on --sub-voxel=off --thickness-map t.nrrd"),
    ("shell", "extract", "l.zarr", "--compress none --local-thickness o.mhd --local-thickness-method sphere"),
    ("cranium", "extract", "l.mha", "--resample auto --thickness 4.5 --thickness-map t.mha --mesh m.ply"),
    ("engine", "distance", "v.nrrd", "--distance d.nrrd --region inside --boundary background --report r.json"),
    ("cranium", "distance", "v.mha", "--distance d.mha --max-distance 7 --report r.json"),
    ("engine", "surface", "s.ply", "--ray --report r.json"),
    ("shell", "surface", "s.glb", "--local-thickness-method sphere --report r.json"),
    ("cranium", "surface", "s.vtp", "--sub-voxel=off --open --report r.json"),
    ("shell", "mesh", "m.vtp", "--triangles"),
    ("shell", "mesh", "m.vtu", ""),
    ("shell", "mesh", "m.vtk", ""),
    ("cranium", "mesh", "m.ply", "--min-branch-length 3 --report r.json"),
    ("shell", "mesh", "m.stl", ""),
    ("shell", "mesh", "m.obj", ""),
    ("engine", "mesh", "m.inp", "--element-size auto --report r.json"),
    ("shell", "mesh", "m.bdf", "--element-size auto"),
    ("cranium", "mesh", "m.k", "--element-size 3"),
    ("engine", "mesh", "m.glb", ""),
    ("engine", "info", "", "--values"),
    ("shell", "info", "", "--values"),
    ("cranium", "info", "", "--values"),
)


def unpack_picture(picture):
    """Without how zlib packed its pixels, which its versions do differently."""
    chunks, position = [], 8
    while position < len(picture):
        end = position + 12 + int.from_bytes(picture[position : position + 4], "big")
        chunks.append((picture[position + 4 : position + 8], picture[position + 8 : end - 4]))
        position = end
    pixels = zlib.decompress(b"".join(content for name, content in chunks if name == b"IDAT"))
    return repr([chunk for chunk in chunks if chunk[0] != b"IDAT"]).encode() + pixels


def unpack(content):
    """A picture, or a page with its pictures and packed numbers, without the version of ITK."""
    if content.startswith(b"\x89PNG"):
        return unpack_picture(content)

    def unpack_part(match):
        part = base64.b64decode(match[0])
        if part.startswith(b"\x89PNG"):
            return unpack_picture(part)
        return zlib.decompress(part, wbits=31) if part.startswith(b"\x1f\x8b") else match[0]

    if not content.startswith(b"<!DOCTYPE html>"):
        return content
    return re.sub(rb"[A-Za-z0-9+/]{60,}={0,2}", unpack_part, re.sub(rb">ITK</th>.*", b"", content))


def run(command, arguments, folder):
    """The digest of each output, and the seconds; a folder is one output."""
    folder.mkdir()
    begin = time.monotonic()
    finished = subprocess.run([*command, *arguments], cwd=folder, capture_output=True, text=True, check=False)
    seconds = time.monotonic() - begin
    if finished.returncode != 0:
        print(f"{command[0]}: status {finished.returncode}: {finished.stderr}", flush=True)
    contents = results(folder) if arguments[0] != "info" else {"text": finished.stdout}
    digests = {}
    for name, content in sorted(contents.items()):
        if isinstance(content, dict):
            content.pop("itk_version", None)
        data = unpack(content) if isinstance(content, bytes) else json.dumps([name, content]).encode()
        digests.setdefault(pathlib.Path(name).parts[0], hashlib.sha256()).update(data)
    return {name: data.hexdigest() for name, data in digests.items()} if finished.returncode == 0 else {}, seconds


def main():
    end = sys.argv.index("--")
    folder, *words = sys.argv[1:end]
    data, other = pathlib.Path(folder).resolve(), sys.argv[end + 1 :]
    outputs, equal = 0, 0
    for scan, command, target, options in RUNS:
        name = f"{scan} {command} {target}".rstrip()
        if words and not any(name.startswith(word) for word in words):
            continue
        file, lower = SCANS[scan]
        arguments = [command, f"../{file}", *([target, "--lower", lower] if target else []), *options.split()]
        with tempfile.TemporaryDirectory() as work:
            # Outputs tell the name of the input.
            (pathlib.Path(work) / file).symlink_to(data / file)
            expected, seconds = run([PROGRAM], arguments, pathlib.Path(work) / "expected")
            found, other_seconds = run(other, arguments, pathlib.Path(work) / "found")
        print(f"{name}: {seconds:.1f} s, {other_seconds:.1f} s", flush=True)
        for output in sorted({*expected, *found}) or ["nothing"]:
            same = output in expected and expected[output] == found.get(output)
            outputs, equal = outputs + 1, equal + same
            print(f"  {'equal' if same else 'DIFFERS'} {expected.get(output, 'not there')} {output}", flush=True)
    print(f"{equal} of {outputs} outputs equal")
    sys.exit(equal != outputs or outputs == 0)


if __name__ == "__main__":
    main()
