# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A shell mesh that `medialvoxel mesh` wrote as .inp, with supports and loads, solved by CalculiX (the program ccx)."""

import os
import pathlib
import subprocess

PLACEHOLDER = "REPLACE_THIS_MATERIAL"


class ShellModel:
    """Nodes by number, and the blocks of the file."""

    def __init__(self, path):
        self.blocks = read_blocks(path)
        self.nodes = {
            int(number): tuple(map(float, coordinates))
            for keyword, lines in self.blocks
            if keyword.startswith("*NODE,")
            for number, *coordinates in (line.split(",") for line in lines)
        }

    def sections(self):
        """Thickness of each section by the name of its set of elements."""
        heads = [(keyword, lines) for keyword, lines in self.blocks if keyword.startswith("*SHELL SECTION")]
        return {keyword.split("ELSET=")[1].split(",")[0]: float(lines[0]) for keyword, lines in heads}

    def number_of_elements(self):
        return sum(len(lines) for keyword, lines in self.blocks if keyword.startswith("*ELEMENT"))

    def mesh_text(self, modulus, poisson_ratio):
        """The file with a material in place of the placeholder."""
        text = []
        for keyword, lines in self.blocks:
            if keyword.startswith("*ELASTIC"):
                lines = [f"{modulus!r}, {poisson_ratio!r}"]
            text += [keyword.replace(PLACEHOLDER, "METAL"), *lines]
        return "\n".join(text) + "\n"


def read_blocks(path):
    """Keyword lines and the lines of data after each."""
    blocks = []
    for line in pathlib.Path(path).read_text(encoding="ascii").splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            blocks.append((line, []))
        else:
            blocks[-1][1].append(line)
    return blocks


def solve(model, material, held, forces, folder):
    """Displacements (x, y, z) of the loaded nodes under static loads.

    material: modulus and Poisson's ratio; held: numbers of nodes that neither move nor turn; forces: (x, y, z) by
    number of the node. The files of the solver stay in the folder."""
    folder = pathlib.Path(folder)
    lines = ["*NSET, NSET=HELD", *(f"{node}," for node in held)]
    lines += ["*NSET, NSET=LOADED", *(f"{node}," for node in forces)]
    lines += ["*BOUNDARY", "HELD, 1, 6", "*STEP", "*STATIC", "*CLOAD"]
    for node, force in forces.items():
        lines += [f"{node}, {axis + 1}, {value!r}" for axis, value in enumerate(force) if value != 0]
    lines += ["*NODE PRINT, NSET=LOADED", "U", "*NODE FILE, OUTPUT=2D", "U", "*END STEP"]
    (folder / "job.inp").write_text(model.mesh_text(*material) + "\n".join(lines) + "\n", encoding="ascii")
    result = subprocess.run(
        ["ccx", "job"], cwd=folder, env=os.environ | {"LC_ALL": "C"}, capture_output=True, text=True, check=False
    )
    table = folder / "job.dat"
    # ccx reports errors on its output and may still leave with status 0.
    if result.returncode != 0 or "*ERROR" in result.stdout or not table.exists():
        raise RuntimeError(f"ccx failed\n{result.stdout[-2000:]}{result.stderr}")
    rows = [line.split() for line in table.read_text(encoding="ascii").splitlines()]
    return {int(row[0]): tuple(map(float, row[1:])) for row in rows if len(row) == 4 and row[0].isdigit()}
