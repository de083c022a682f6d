# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The parts of the module MedialVoxelWalls: settings and walls need no application, display and panel are Slicer's."""
