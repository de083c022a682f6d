#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Shell meshes of parts with known shapes and of real parts, solved by CalculiX: errors, and elements that it refuses.

Plates are held at one rim, loaded at the other one, and compared with beams (Poisson's ratio 0). Profiles, an arch and
frequencies are compared with solid elements. Joints and bends are checked. Needs numpy, scipy, and CalculiX (Debian package
calculix-ccx). Prints tables; writes all numbers as JSON.
"""

import argparse
import itertools
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import numpy

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.append(str(FOLDER.parent / "examples/fem"))

from shell_model import ShellModel, find_loose, solve  # noqa: E402
from shell_parts import TILTS, Bend, HoledPlate, Joint, Plate  # noqa: E402
from shell_tables import print_tables  # noqa: E402
from solve_profiles import END, STUDIES, References, solve_profile  # noqa: E402

MODULUS = 210000.0
PARTS = {"engine.mha": 72, "shell.nrrd": 65, "cranium.mha": 200}
PROFILE_THICKNESS = 4
PROFILE_TILTS = ("axis", "15 degrees")
JOINTS = {
    "2 on 4": lambda tilt: Joint(4, 2, tilt),
    "4 on 2": lambda tilt: Joint(2, 4, tilt),
    "8 on 4": lambda tilt: Joint(4, 8, tilt),
    "4 on 8": lambda tilt: Joint(8, 4, tilt),
    "bend of 4, radius 0": lambda tilt: Bend(4, 0, tilt),
    "bend of 4, radius 6": lambda tilt: Bend(4, 6, tilt),
    "plate of 4, holes": lambda tilt: HoledPlate(4, tilt),
}


class Mesher:
    """The program, with the options that all meshes share, and a folder for its files."""

    def __init__(self, program, options, folder):
        self.program, self.options, self.folder = program, options, folder

    def mesh(self, source, lower, *options):
        """As a model, and the seconds that it took."""
        start = time.monotonic()
        target = self.folder / "part.inp"
        command = [self.program, "mesh", source, target, "--lower", str(lower), "--element-size", "auto"]
        command += ["--report", self.folder / "report.json"]
        subprocess.run([*command, "--overwrite", "--quiet", *self.options, *options], check=True)
        return ShellModel(target), time.monotonic() - start

    def mesh_part(self, part, is_gray):
        part.write(self.folder / "part.mha", is_gray)
        return self.mesh(self.folder / "part.mha", 128)[0]

    def quality(self):
        """Of the mesh that was made last."""
        return json.loads((self.folder / "report.json").read_text("utf-8"))["mesh"]["quality"]


def errors_or_refused(find):
    """The errors that a function finds, or what the solver refuses."""
    try:
        return {"refused": 0, **find()}
    except RuntimeError as error:
        elements = set(re.findall(r"determinant in element\s+(\d+)", str(error)))
        return {"refused": len(elements) or str(error)[-200:]}


def beam_deflection(force_at, seen_at, rigidity):
    """Of a beam that is held at 0, at one place by a unit force at another."""
    near, far = sorted((force_at, seen_at))
    return near**2 * (3 * far - near) / (6 * rigidity)


def area_of(model):
    """Of all elements."""
    area = 0.0
    for nodes in model.elements():
        first, *others = (numpy.array(model.nodes[node]) for node in nodes)
        area += sum(numpy.linalg.norm(numpy.cross(b - first, c - first)) / 2 for b, c in zip(others, others[1:]))
    return area


def bend(model, plate, folder):
    """Errors of the deflection of the loaded rim against beams: of the plate, of the size of the sheet, and of its voxels."""
    numbers = list(model.nodes)
    x = plate.to_part(numpy.array([model.nodes[number] for number in numbers]))[:, 0]
    near = END * plate.thickness
    held = [number for number, value in zip(numbers, x) if value < x.min() + near]
    loaded = [(number, value) for number, value in zip(numbers, x) if value > x.max() - near]
    begin = numpy.mean(x[x < x.min() + near])
    force = tuple(map(float, plate.axes[2] / len(loaded)))
    moved = solve(model, (MODULUS, 0.0), held, {number: force for number, _ in loaded}, folder)
    deflection = numpy.mean([numpy.dot(moved[number], plate.axes[2]) for number, _ in loaded])
    lengths = [value - begin for _, value in loaded]
    rigidity = MODULUS * plate.thickness**3 / 12
    of_sheet = sum(beam_deflection(a, b, rigidity) for a in lengths for b in lengths) / len(loaded) ** 2
    of_sheet *= numpy.ptp(x) / area_of(model)
    of_plate = beam_deflection(plate.LENGTH, plate.LENGTH, rigidity) / plate.WIDTH
    of_voxels = of_sheet * (plate.thickness / plate.thickness_of_voxels()) ** 3
    names = ("error_percent", "error_of_sheet_percent", "error_of_voxels_percent")
    return {name: round(100 * (deflection / by - 1), 2) for name, by in zip(names, (of_plate, of_sheet, of_voxels))}


def solve_plate(mesher, thickness, tilt, is_gray):
    plate = Plate(thickness, tilt)
    model = mesher.mesh_part(plate, is_gray)
    row = {"plate": tilt, "thickness": thickness, "values": "gray" if is_gray else "binary"}
    row["elements"] = model.number_of_elements()
    row |= errors_or_refused(lambda: bend(model, plate, mesher.folder))
    if is_gray:
        row.pop("error_of_voxels_percent", None)
    return row


def solve_profiles(mesher, report):
    references = References(mesher.folder)
    for tilt, name, is_gray in itertools.product(PROFILE_TILTS, STUDIES, (False, True)):
        model = mesher.mesh_part(STUDIES[name](PROFILE_THICKNESS, tilt).part, is_gray)
        row = {"profile": name, "tilt": tilt, "values": "gray" if is_gray else "binary"}
        row["elements"] = model.number_of_elements()
        errors = errors_or_refused(
            lambda: solve_profile(name, PROFILE_THICKNESS, tilt, model, references, mesher.folder)
        )
        report(row | errors)


def check_joint(mesher, name, tilt, is_gray):
    """Shapes of the elements, and whether the solver takes them."""
    part = JOINTS[name](tilt)
    model = mesher.mesh_part(part, is_gray)
    quality = mesher.quality()
    row = {"joint": name, "tilt": tilt, "values": "gray" if is_gray else "binary", "elements": model.number_of_elements()}
    row["failed_limits"] = [limit["name"] for limit in quality["limits"] if not limit["holds"]]
    row |= {name: quality[name] for name in ("walls", "junction_sides")}
    row |= {"least_jacobian": round(quality["least_scaled_jacobian"], 3)}
    values = {limit["name"]: limit["value"] for limit in quality["limits"]}
    row |= {"jacobian_of_99": round(values["scaled Jacobian of 99 %"], 3), "aspect_of_99": round(values["aspect ratio of 99 %"], 3)}
    places = part.to_part(numpy.array(list(model.nodes.values())))
    held = [number for number, x in zip(model.nodes, places[:, 0]) if x < places[:, 0].min() + 1]
    loaded = list(model.nodes)[int(places[:, 0].argmax())]
    force = {loaded: tuple(part.axes[2].tolist())}

    def pull():
        moved = solve(model, (MODULUS, 0.3), held, force, mesher.folder)
        return {"is_finite": bool(numpy.isfinite(moved[loaded]).all())}

    return row | errors_or_refused(pull)


def solve_part(mesher, source, threshold):
    """Held at its lowest nodes, pulled at its highest one; pieces that are not held stay where they are."""
    model, seconds = mesher.mesh(source, threshold)
    row = {"part": source.name, "elements": model.number_of_elements(), "mesh_seconds": round(seconds, 1)}
    heights = {number: point[2] for number, point in model.nodes.items()}
    low = min(heights.values())
    held = [number for number, height in heights.items() if height < low + 5]
    loose = set(find_loose(model, held))
    row["loose_nodes"] = len(loose)
    top = max((number for number in heights if number not in loose), key=heights.get)

    def pull():
        moved = solve(model, (70000.0, 0.33), [*held, *loose], {top: (0.0, 0.0, 1.0)}, mesher.folder)
        return {"moved_mm_by_newton": float(f"{numpy.linalg.norm(moved[top]):.3g}")}

    start = time.monotonic()
    row |= errors_or_refused(pull)
    return row | {"solver_seconds": round(time.monotonic() - start, 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="medialvoxel", help="the program medialvoxel")
    parser.add_argument("--data", type=pathlib.Path, help="folder of the real parts; none: these are left out")
    parser.add_argument("--thickness", default="3,4,6,8", help="of the plates in voxels (%(default)s)")
    parser.add_argument("--only", default="plates,profiles,joints,parts", help="of %(default)s; the file keeps the others")
    parser.add_argument("--extend-rims", action="store_true", help="passed on to the program")
    parser.add_argument("--output", type=pathlib.Path, default=FOLDER / "results/shells.json", help="(%(default)s)")
    arguments = parser.parse_args()
    wanted = arguments.only.split(",")
    version = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout.strip()
    known = json.loads(arguments.output.read_text("utf-8")) if arguments.output.exists() else {}
    results = {**known, "solver": "CalculiX " + version.split()[-1], "extend_rims": arguments.extend_rims}

    with tempfile.TemporaryDirectory() as temporary:
        mesher = Mesher(arguments.program, ["--extend-rims" if arguments.extend_rims else "--extend-rims=off"], pathlib.Path(temporary))

        def add(name, row):
            results[name].append(row)
            print(json.dumps(row), flush=True)

        if "plates" in wanted:
            results["plates"] = []
            for thickness, tilt, is_gray in itertools.product(arguments.thickness.split(","), TILTS, (False, True)):
                add("plates", solve_plate(mesher, int(thickness), tilt, is_gray))
        if "profiles" in wanted:
            results["profiles"] = []
            solve_profiles(mesher, lambda row: add("profiles", row))
        if "joints" in wanted:
            results["joints"] = []
            for name, tilt, is_gray in itertools.product(JOINTS, ("axis", "15 degrees"), (False, True)):
                add("joints", check_joint(mesher, name, tilt, is_gray))
        if "parts" in wanted and arguments.data:
            results["parts"] = []
            for name, threshold in PARTS.items():
                add("parts", solve_part(mesher, arguments.data / name, threshold))
    print_tables(results)
    arguments.output.write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
