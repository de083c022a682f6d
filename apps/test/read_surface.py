# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Reads mesh files with a library and writes what they hold as JSON by file: read_surface.py READER JSON-FILE FILE...

Keys: points; faces, as lists of places in points; if the format has them: thickness, ray_thickness, colors and
object_of_points of the points; area, rim, junction, object, wall, cap, group and section_thickness of the faces; sets, the
places of the elements by name; node_sets, the places of the points by name; corner_thickness of the corners of each
face, where the format has it."""

import json
import re
import sys


def read_with_pyvista(path):
    import pyvista  # pylint: disable=import-outside-toplevel

    mesh = pyvista.read(path)
    if isinstance(mesh, pyvista.MultiBlock):  # of a scene
        mesh = mesh.combine(merge_points=False)
    cells = [mesh.get_cell(index) for index in range(mesh.n_cells)]
    content = {"points": mesh.points.tolist(), "faces": [list(cell.point_ids) for cell in cells]}
    names = {"Thickness": "thickness", "_THICKNESS": "thickness", "_RAY_THICKNESS": "ray_thickness", "COLOR_0": "colors"}
    names |= {"ray_thickness": "ray_thickness"}
    content |= {key: mesh.point_data[name].tolist() for name, key in names.items() if name in mesh.point_data}
    names = {"area": "Area", "rim": "RimEdges", "junction": "JunctionEdges", "object": "Object", "wall": "Wall", "cap": "Cap"}
    return content | {key: mesh.cell_data[name].tolist() for key, name in names.items() if name in mesh.cell_data}


def read_with_meshio(path):
    import meshio  # pylint: disable=import-outside-toplevel

    mesh = meshio.read(path)
    content = {"points": mesh.points.tolist(), "faces": [list(map(int, face)) for block in mesh.cells for face in block.data]}
    for name in ("Thickness", "thickness", "ray_thickness"):
        if name in mesh.point_data:
            content[name.lower()] = mesh.point_data[name].tolist()
    if "object" in mesh.point_data:
        content["object_of_points"] = mesh.point_data["object"].tolist()
    for name, blocks in mesh.cell_data.items():
        keys = {"Area": "area", "RimEdges": "rim", "JunctionEdges": "junction", "Object": "object", "Wall": "wall"}
        key = (keys | {"obj:group_ids": "group"}).get(name)
        if key:
            content[key] = [value.item() for block in blocks for value in block]
    first = [sum(len(block.data) for block in mesh.cells[:index]) for index in range(len(mesh.cells))]
    content["sets"] = {
        name: [int(place) + start for start, block in zip(first, blocks) for place in (block if block is not None else [])]
        for name, blocks in mesh.cell_sets.items()
    }
    content["node_sets"] = {name: list(map(int, places)) for name, places in mesh.point_sets.items()}
    return content


def read_with_gmsh(path):
    import gmsh  # pylint: disable=import-outside-toplevel

    gmsh.initialize(["-v", "1"])
    gmsh.merge(path)
    numbers, coordinates, _ = gmsh.model.mesh.getNodes()
    place = {number: index for index, number in enumerate(numbers.tolist())}
    faces = {}
    for kind, elements, corners in zip(*gmsh.model.mesh.getElements(2)):
        size = gmsh.model.mesh.getElementProperties(kind)[3]
        for index, element in enumerate(elements.tolist()):
            faces[element] = [place[corner] for corner in corners[index * size : (index + 1) * size].tolist()]
    gmsh.finalize()
    return {"points": coordinates.reshape(-1, 3).tolist(), "faces": [faces[number] for number in sorted(faces)]}


def read_with_trimesh(path):
    import trimesh  # pylint: disable=import-outside-toplevel

    mesh = trimesh.load(path, process=False)
    if path.endswith(".ply"):
        return {"faces": mesh.faces.tolist(), "wall": mesh.metadata["_ply_raw"]["face"]["data"]["wall"].ravel().tolist()}
    (mesh,) = mesh.geometry.values()
    content = {"points": mesh.vertices.tolist(), "faces": mesh.faces.tolist()}
    content["colors"] = mesh.visual.vertex_attributes["color"].tolist()
    for key, name in {"thickness": "_THICKNESS", "ray_thickness": "_RAY_THICKNESS"}.items():
        if name in mesh.vertex_attributes:
            content[key] = mesh.vertex_attributes[name].ravel().tolist()
    return content


def read_with_pynastran(path):
    from pyNastran.bdf.bdf import read_bdf  # pylint: disable=import-outside-toplevel

    model = read_bdf(path, debug=None, validate=False, xref=False)
    numbers = sorted(model.nodes)
    place = {number: index for index, number in enumerate(numbers)}
    elements = [model.elements[number] for number in sorted(model.elements)]
    control = model.case_control_deck.subcases[0].params if model.case_control_deck else {}
    sets = {name: control[f"SET {number}"][0] for number, name in ((1, "RIM"), (2, "JUNCTION")) if f"SET {number}" in control}
    walls = {int(key[4:]) - 1000: numbers for key, (numbers, *_) in control.items() if re.fullmatch(r"SET 1\d{3}", key)}
    thicknesses = [[element.T1, element.T2, element.T3, getattr(element, "T4", None)] for element in elements]
    return {
        "node_sets": {name: [place[number] for number in numbers] for name, numbers in sets.items()},
        "sets": {f"WALL_{wall}": [number - 1 for number in members] for wall, members in walls.items()},
        "corner_thickness": [four[: len(element.nodes)] for element, four in zip(elements, thicknesses)],
        "points": [model.nodes[number].xyz.tolist() for number in numbers],
        "faces": [[place[corner] for corner in element.nodes] for element in elements],
        "section_thickness": [model.properties[element.pid].t for element in elements],
    }


def read_with_pydyna(path):
    from ansys.dyna.core import Deck  # pylint: disable=import-outside-toplevel

    deck = Deck()
    deck.import_file(path)
    blocks = {}
    for keyword in deck.keywords:
        blocks.setdefault(type(keyword).__name__, []).append(keyword)
    (nodes,) = (block.nodes for block in blocks["Node"])
    place = {number: index for index, number in enumerate(nodes["nid"].tolist())}
    shells = (blocks.get("ElementShell") or blocks["ElementShellThickness"])[0].elements
    corners = shells[["n1", "n2", "n3", "n4"]].to_numpy().tolist()
    corners = [four[:3] if four[2] == four[3] else four for four in corners]
    sections = {section.secid: section.t1 for section in blocks.get("SectionShell", [])}
    parts = {part.parts["pid"].iloc[0]: sections[part.parts["secid"].iloc[0]] for part in blocks.get("Part", [])}
    content = {
        "points": nodes[["x", "y", "z"]].to_numpy().tolist(),
        "faces": [[place[corner] for corner in face] for face in corners],
        "section_thickness": [parts[part] for part in shells["pid"].tolist()],
        "node_sets": {block.title: [place[node] for node in block.nodes.data] for block in blocks.get("SetNodeList", [])},
        "sets": {block.title: [element - 1 for element in block.shells.data] for block in blocks.get("SetShellList", [])},
        "part_sets": {block.title: list(block.parts.data) for block in blocks.get("SetPartList", [])},
    }
    if "thic1" in shells:
        thicknesses = shells[["thic1", "thic2", "thic3", "thic4"]].to_numpy().tolist()
        content["corner_thickness"] = [four[: len(face)] for face, four in zip(corners, thicknesses)]
    return content


READERS = {
    "pyvista": read_with_pyvista,
    "meshio": read_with_meshio,
    "gmsh": read_with_gmsh,
    "pyNastran": read_with_pynastran,
    "trimesh": read_with_trimesh,
    "pydyna": read_with_pydyna,
}


def main():
    reader, result, *paths = sys.argv[1:]
    with open(result, "w", encoding="ascii") as file:
        json.dump({path: READERS[reader](path) for path in paths}, file)


if __name__ == "__main__":
    main()
