# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A shell mesh that `medialvoxel mesh` wrote as .inp, with supports and loads, solved by CalculiX (the program ccx)."""

import math
import os
import pathlib
import subprocess

PLACEHOLDER = "REPLACE_THIS_MATERIAL"


class ShellModel:
    """Nodes by number, and the blocks of the file."""

    freedoms = 6  # of a node: it moves and turns

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

    def elements(self):
        """Numbers of the nodes of each element."""
        return (nodes for _, nodes in self.numbered_elements())

    def numbered_elements(self):
        """The same with the number of each element."""
        for keyword, lines in self.blocks:
            if keyword.startswith("*ELEMENT,"):
                for line in lines:
                    number, *nodes = map(int, line.split(","))
                    yield number, nodes

    def number_of_elements(self):
        return sum(1 for _ in self.elements())

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


def find_loose(model, held):
    """Nodes that no elements join to those that are held: a solver lets them fly away."""
    neighbors = {node: set() for node in model.nodes}
    for nodes in model.elements():
        for node in nodes:
            neighbors[node].update(nodes)
    reached, ahead = set(held), list(held)
    while ahead:
        new = neighbors[ahead.pop()] - reached
        reached |= new
        ahead += new
    return [node for node in model.nodes if node not in reached]


def solve(model, material, held, forces, folder):
    """Displacements (x, y, z) of the loaded nodes under static loads.

    material: modulus and Poisson's ratio; held: numbers of nodes that neither move nor turn; forces: (x, y, z) by
    number of the node. The files of the solver stay in the folder."""
    return solve_for(model, material, held, forces, ["*NODE PRINT, NSET=LOADED", "U"], folder)[0]


def solve_all(model, material, held, forces, folder):
    """The same of all nodes, and the largest von Mises stress at the integration points of each element, by its number."""
    sets = [keyword.split("ELSET=")[1] for keyword, _ in model.blocks if keyword.startswith("*ELEMENT,")]
    prints = ["*NODE PRINT, NSET=ALL_NODES", "U", *(line for name in sets for line in (f"*EL PRINT, ELSET={name}", "S"))]
    return solve_for(model, material, held, forces, prints, folder)


def solve_for(model, material, held, forces, prints, folder):
    """Displacements and stresses of what is printed."""
    lines = ["*NSET, NSET=LOADED", *(f"{node}," for node in forces)]
    lines += ["*STEP", "*STATIC", "*CLOAD"]
    for node, force in forces.items():
        # ccx reads 20 characters of a number.
        lines += [f"{node}, {axis + 1}, {value:.10g}" for axis, value in enumerate(force) if value != 0]
    moved, stresses = {}, {}
    for row in run(model, material, held, [*lines, *prints, "*END STEP"], folder):
        if len(row) == 4 and row[0].isdigit():
            moved[int(row[0])] = tuple(map(float, row[1:]))
        elif len(row) == 9 and row[0].isdigit():
            stress = von_mises(*map(float, row[2:8]))
            stresses[int(row[0])] = max(stress, stresses.get(int(row[0]), 0.0))
    return moved, stresses


def von_mises(xx, yy, zz, xy, xz, yz):
    """Of a stress."""
    return math.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * (xy**2 + xz**2 + yz**2))


def find_frequencies(model, material, held, count, folder):
    """The lowest ones of free oscillation, in hertz when lengths are in mm, forces in N and densities in t/mm^3."""
    rows = run(model, material, held, ["*STEP", "*FREQUENCY", f"{count}", "*NODE FILE", "U", "*END STEP"], folder)
    # Mode, eigenvalue, frequency as radians and as cycles in a unit of time, and its imaginary part.
    found = {int(row[0]): float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()}
    return [found[mode + 1] for mode in range(count)]


def run(model, material, held, lines, folder):
    """The lines of the table that the solver prints, as words; lines: of the steps."""
    folder = pathlib.Path(folder)
    nodes = ["*NSET, NSET=HELD", *(f"{node}," for node in held), "*BOUNDARY", f"HELD, 1, {model.freedoms}"]
    (folder / "job.inp").write_text(model.mesh_text(*material) + "\n".join(nodes + lines) + "\n", encoding="ascii")
    result = subprocess.run(
        ["ccx", "job"], cwd=folder, env=os.environ | {"LC_ALL": "C"}, capture_output=True, text=True, check=False
    )
    table = folder / "job.dat"
    # ccx reports errors on its output and may still leave with status 0.
    if result.returncode != 0 or "*ERROR" in result.stdout or not table.exists():
        raise RuntimeError(f"ccx failed\n{result.stdout[-2000:]}{result.stderr}")
    return [line.split() for line in table.read_text(encoding="ascii").splitlines()]
