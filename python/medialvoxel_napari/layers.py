# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""From a layer to the layers of its walls, without a viewer."""

import dataclasses

import medialvoxel
import numpy as np

LABEL_COLORS = {0: "transparent", 1: (0.4, 0.4, 0.4, 0.25), 2: "white", 3: (1.0, 0.18, 0.14, 1.0), None: "transparent"}


@dataclasses.dataclass(frozen=True)
class Settings:
    """What is looked for.

    lower, upper -- the object has values from lower to upper; None: no such limit. Both None: all values but 0. lower may be "otsu"
    thickness    -- of the walls, in the units of the scale, or "auto"
    """

    lower: float | str | None = None
    upper: float | None = None
    thickness: float | str = "auto"


def volume_of(layer):
    """The values of an image or labels layer, and its spacing (one number for each axis).

    Raises ValueError, with a text for the user, for layers that have no place in the space of their walls.
    """
    if getattr(layer, "rgb", False):
        raise ValueError(f"The layer {layer.name} has colors; choose one with one value per voxel.")
    if layer.ndim not in (2, 3):
        raise ValueError(f"The layer {layer.name} has {layer.ndim} axes; choose one with 2 or 3.")
    identity = np.eye(layer.ndim + 1)
    is_turned = not np.allclose(layer.rotate, identity[:-1, :-1]) or np.any(layer.shear)
    if is_turned or not np.allclose(layer.affine.affine_matrix, identity):
        raise ValueError(f"The layer {layer.name} is rotated or sheared; results could not be laid over it.")
    if np.any(np.asarray(layer.scale) <= 0):
        raise ValueError(f"The layer {layer.name} has the scale {tuple(layer.scale)}; it must be greater than 0.")
    values = layer.data[0] if layer.multiscale else layer.data
    return np.asarray(values), tuple(float(step) for step in layer.scale)


def find_walls(values, spacing, settings, progress=None):
    """The medial cells of a volume and, with 3 axes, its medial surface (else None). progress is called with 0 to 1."""
    share = 0.5 if values.ndim == 3 else 1.0
    options = dataclasses.asdict(settings) | {"spacing": spacing}
    report = progress or (lambda done: None)
    medial = medialvoxel.extract(values, **options, progress=lambda done: report(share * done))
    if values.ndim == 2:
        return medial, None
    options["lower"] = medial.lower  # that of Otsu, which is measured once
    return medial, medialvoxel.mesh(values, **options, progress=lambda done: report(share + share * done))


def thickness_range(thickness):
    """Two different thicknesses between which nearly all walls are; a few outliers would take all colors."""
    known = thickness[thickness > 0]
    if not len(known):
        return 0.0, 1.0
    low, high = map(float, np.percentile(known, (1, 99)))
    return (low, high) if low < high else (low, low + 1.0)


def layers_of(name, translate, medial, surface):
    """The layers as (data, options, type): thickness (hidden), medial cells and, if there is one, the surface."""
    place = {"scale": medial.spacing, "translate": np.add(translate, medial.origin)}
    limits = thickness_range(medial.thickness)
    colors = {"colormap": "viridis", "contrast_limits": limits}
    cells = f"{name} medial cells"
    result = [
        (medial.thickness, {"name": f"{name} thickness", "visible": False, "blending": "additive"} | place | colors, "image"),
        (medial.labels, {"name": cells, "colormap": LABEL_COLORS, "opacity": 0.8} | place, "labels"),
    ]
    if surface is not None and len(surface.faces):
        data = (surface.points, surface.triangles, surface.thickness)
        result.append((data, {"name": f"{name} walls", "translate": translate, "shading": "none"} | colors, "surface"))
    return result


def describe(medial):
    """One line about a result."""
    known = medial.thickness[medial.thickness > 0]
    line = f"{medial.counts['medial_cells']:,} medial cells"
    if not len(known):
        return f"{line}; no wall was measured"
    return f"{line}; walls {known.min():.3g} to {known.max():.3g}, median {np.median(known):.3g}"
