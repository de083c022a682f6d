# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Reads mesh files with a library and writes what they hold as JSON by file: read_surface.py READER JSON-FILE FILE...

Keys: points; faces, as lists of places in points; if the format has them: thickness, ray_thickness, colors and
object_of_points of the points; area, rim, junction, object, cap, group and section_thickness of the faces; sets, the
places of the elements by name."""

import json
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
    names = {"area": "Area", "rim": "RimEdges", "junction": "JunctionEdges", "object": "Object", "cap": "Cap"}
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
        key = {"Area": "area", "RimEdges": "rim", "JunctionEdges": "junction", "Object": "object", "obj:group_ids": "group"}.get(name)
        if key:
            content[key] = [value.item() for block in blocks for value in block]
    first = [sum(len(block.data) for block in mesh.cells[:index]) for index in range(len(mesh.cells))]
    content["sets"] = {
        name: [int(place) + start for start, block in zip(first, blocks) for place in (block if block is not None else [])]
        for name, blocks in mesh.cell_sets.items()
    }
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

    (mesh,) = trimesh.load(path, process=False).geometry.values()
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
    return {
        "points": [model.nodes[number].xyz.tolist() for number in numbers],
        "faces": [[place[corner] for corner in element.nodes] for element in elements],
        "section_thickness": [model.properties[element.pid].t for element in elements],
    }


READERS = {
    "pyvista": read_with_pyvista,
    "meshio": read_with_meshio,
    "gmsh": read_with_gmsh,
    "pyNastran": read_with_pynastran,
    "trimesh": read_with_trimesh,
}


def main():
    reader, result, *paths = sys.argv[1:]
    with open(result, "w", encoding="ascii") as file:
        json.dump({path: READERS[reader](path) for path in paths}, file)


if __name__ == "__main__":
    main()
