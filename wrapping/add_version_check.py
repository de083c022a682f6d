#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Has the Python module that SWIG made refuse an ITK of another version, whose classes have another layout in memory.

pip keeps the versions together, unless it is told not to.

Usage: add_version_check.py VERSION PYTHON-FILE     VERSION: of ITK, such as 5.4
The file is rewritten; a second run changes nothing.
"""

import pathlib
import sys

CHECK = '''import itkConfig as _itk_config

if _itk_config.ITK_GLOBAL_VERSION_STRING.split(".")[:2] != "{version}".split("."):
    raise ImportError(
        "itk-medialvoxel is built for ITK {version} and cannot work with ITK "
        f"{{_itk_config.ITK_GLOBAL_VERSION_STRING}}; install both together: pip install 'itk=={version}.*' itk-medialvoxel"
    )

'''


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    check, python = CHECK.format(version=sys.argv[1]), pathlib.Path(sys.argv[2])
    code = python.read_text(encoding="utf-8")
    if not code.startswith(check):
        python.write_text(check + code, encoding="utf-8")


if __name__ == "__main__":
    main()
