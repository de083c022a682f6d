# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""MedialVoxel in napari: a widget that finds the sheets of walls, and volumes to try it with."""
