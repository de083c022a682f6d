# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The program: python -m medialvoxel --help."""

from ._program import main

main()
