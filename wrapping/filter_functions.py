# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The functions of the filters, itk.medial_voxel_image_filter and others: their docstrings and types."""

import textwrap

from header_comments import ENUMERATIONS, FILTERS, enumerators_of, read_comments, read_parameters, read_setters, to_snake

WIDTH = 116

# What the function returns, and an example of it.
FUNCTIONS = {
    "MedialVoxelImageFilter": (
        "the labels, of unsigned char: an image for an\nimage, an array for an array. The filter object, "
        "itk.MedialVoxelImageFilter.New(image, ...), has the other outputs and\nthe numbers of voxels and cells",
        """
        >>> import itk
        >>> import numpy as np
        >>> plate = np.zeros((12, 30, 30), np.uint8)
        >>> plate[4:8, 3:27, 3:27] = 1  # axes z, y, x
        >>> automatic = itk.MedialVoxelEnums.ThicknessMode_Automatic
        >>> labels = itk.medial_voxel_image_filter(plate, thickness_mode=automatic)
        >>> np.unique(np.nonzero(labels >= 2)[0]).tolist()
        [5]
        >>> medial = itk.MedialVoxelImageFilter.New(itk.image_from_array(plate), generate_thickness=True)
        >>> medial.Update()
        >>> float(itk.array_from_image(medial.GetThicknessOutput())[5, 15, 15])
        4.0
        """,
    ),
    "MedialVoxelObjectsImageFilter": (
        "the labels of the cells, of unsigned char: an\nimage for an image, an array for an array. The filter object, "
        "itk.MedialVoxelObjectsImageFilter.New(image, ...), has\nthe object of each cell and the numbers of each object",
        """
        >>> import itk
        >>> import numpy as np
        >>> cells = np.zeros((12, 30, 30), np.uint8)
        >>> cells[4:8, 3:15, 3:27] = 1  # axes z, y, x
        >>> cells[4:8, 15:27, 3:27] = 7  # touches the first
        >>> labels = itk.medial_voxel_objects_image_filter(cells, object_labels=[7])
        >>> bool((labels >= 2)[:, :14].any())
        False
        """,
    ),
    "VectorDistanceMapImageFilter": (
        "the vectors, x first, of float: an image for\nan image, an array for an array. The filter object, "
        "itk.VectorDistanceMapImageFilter.New(image, ...), has the signed\ndistances too",
        """
        >>> import itk
        >>> import numpy as np
        >>> bar = np.zeros((7, 7), np.uint8)
        >>> bar[2:5, :] = 1  # axes y, x
        >>> itk.vector_distance_map_image_filter(bar)[0, 3].tolist()  # x first
        [0.0, 2.0]
        """,
    ),
    "LocalThicknessImageFilter": (
        "the diameters, of float: an image for an image, an array\nfor an array. The filter object, "
        "itk.LocalThicknessImageFilter.New(image, ...), has the numbers of voxels too",
        """
        >>> import itk
        >>> import numpy as np
        >>> plate = np.zeros((12, 30, 30), np.uint8)
        >>> plate[4:8, :, :] = 1  # axes z, y, x
        >>> thickness = itk.local_thickness_image_filter(plate, largest_ball=10)
        >>> np.unique(thickness).tolist()
        [0.0, 4.0]
        """,
    ),
    "MedialSurfaceMeshFilter": (
        "the itk.Mesh",
        """
        >>> import itk
        >>> import numpy as np
        >>> plate = np.zeros((12, 30, 30), np.uint8)
        >>> plate[4:8, 3:27, 3:27] = 1  # axes z, y, x
        >>> mesh = itk.medial_surface_mesh_filter(plate)
        >>> round(mesh.GetPoint(0)[2], 3)  # x first
        5.5
        >>> float(np.median([mesh.GetPointData().GetElement(i) for i in range(mesh.GetNumberOfPoints())]))
        4.0
        """,
    ),
}

INPUT = """image: itk.Image, or an array in the order of NumPy (z, y, x), of uint8, int16, uint16 or float32."""

ERRORS = """Raises RuntimeError, with the message of the filter, for values that cannot be; TypeError for arguments of other types;
OverflowError for integers out of the range of their type; AttributeError for parameters that there are not; KeyError or
itk.TemplateTypeError for pixels of other types. Numbers may be those of NumPy."""


def describe_parameters(name):
    """A paragraph for each parameter of a filter."""
    setters = read_setters(name)
    for setter, text in read_parameters(name).items():
        values = ", ".join(f"itk.{ENUMERATIONS}.{value}" for value in enumerators_of(setters[setter][0]))
        text = f"{text} One of {values}." if values else text
        yield textwrap.fill(f"{to_snake(setter)}: {text}", WIDTH, subsequent_indent="    ", break_long_words=False)


def describe(name):
    """The docstring of a function, and of the object that offers a filter for all types of images."""
    returned, example = FUNCTIONS[name]
    parts = [
        read_comments(name)[0],
        f"itk.{to_snake(name)}(image, ...) returns {returned}.",
        "Parameters:",
        "\n".join([INPUT, *describe_parameters(name)]),
        ERRORS,
        textwrap.indent(textwrap.dedent(example).strip(), "    "),
    ]
    if set(FUNCTIONS) != set(FILTERS):
        raise ValueError("FUNCTIONS must have each of FILTERS")
    return "\n\n".join(parts)
