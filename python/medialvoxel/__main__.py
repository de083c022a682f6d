# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The program, and the check of meshes of others: python -m medialvoxel --help, python -m medialvoxel check --help."""

import sys

from . import _check, _program

if sys.argv[1:2] == ["check"]:
    _check.main(sys.argv[2:])
_program.main()
