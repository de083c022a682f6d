# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Code of the documents passes the strict type checks of its readers, by each checker that is installed."""

import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import unittest

import medialvoxel

from support import Folder

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = pathlib.Path(medialvoxel.__file__).parents[1]
BLOCK = re.compile(r"^( *)```python\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)

# A checker that accepts this looks at nothing.
WRONG = "import medialvoxel\n\nmedialvoxel.extract([[1]], spacings=3)\n"


def blocks():
    """Blocks that use the package, but not helpers beside it and libraries without types."""
    for path in [ROOT / "README.md", ROOT / "python/README.md", *sorted((ROOT / "doc").rglob("*.md"))]:
        for number, (_, text) in enumerate(BLOCK.findall(path.read_text(encoding="utf-8"))):
            modules = set(re.findall(r"^(?:import|from) (\w+)", text, re.MULTILINE))
            if "medialvoxel" in modules and modules <= {"medialvoxel", "numpy", *sys.stdlib_module_names}:
                yield f"{path.relative_to(ROOT).as_posix().replace('/', '_').replace('-', '_').replace('.', '_')}_{number}.py", text


class Typing(Folder):
    def check(self, checker, configure, *options):
        """configure(files) writes the settings of the checker."""
        if importlib.util.find_spec(checker) is None:
            self.skipTest(f"skipped: no {checker}")
        if not (ROOT / "doc").exists():
            self.skipTest("skipped: no documents beside the tests")
        names = [name for name, text in blocks() if (self.folder / name).write_text(text)]
        self.assertGreater(len(names), 8)
        (self.folder / "wrong.py").write_text(WRONG)
        for files, is_right in ((["wrong.py"], False), (names, True)):
            configure(files)
            done = subprocess.run([sys.executable, "-m", checker, *options], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode == 0, is_right, done.stdout + done.stderr)

    def test_mypy(self):
        settings = "[mypy]\nstrict = True\nfollow_imports = silent\n"
        if "site-packages" not in PACKAGES.parts:  # which mypy knows, and refuses as a path
            settings += f"mypy_path = {PACKAGES}\n"
        self.check("mypy", lambda files: (self.folder / "mypy.ini").write_text(f"{settings}files = {', '.join(files)}\n"))

    def test_pyright(self):
        settings = {"typeCheckingMode": "strict", "extraPaths": [str(PACKAGES)]}
        config = self.folder / "pyrightconfig.json"
        configure = lambda files: config.write_text(json.dumps(settings | {"include": files}))  # noqa: E731
        self.check("pyright", configure, "--pythonpath", sys.executable)


if __name__ == "__main__":
    unittest.main()
