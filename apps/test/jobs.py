# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What tests of job folders share."""

import json
import re
import shutil
import subprocess
import zlib

from program import DONE, PROGRAM, ProgramTestCase

# What a report tells about the run and not about the volume.
RUN_KEYS = (
    "seconds",
    "peak_memory_bytes",
    "planned_peak_bytes",
    "memory_limit_bytes",
    "bytes_read",
    "recomputed_voxels",
    "threads",
    "divisions",
    "thread_efficiency",
)

ALL_OUTPUTS = (
    "--vectors v.nhdr --distance d.mhd --thickness-map t.nrrd --places c.csv --thin-below 2 "
    "--preview p.png --html p.html --report r.json"
).split()


def seal(content):
    """The text of a JSON file whose last member is the checksum of the others."""
    content = {name: value for name, value in content.items() if name != "checksum"}
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False)
    content["checksum"] = zlib.crc32(text.encode())
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def results(folder):
    """Names and contents of the outputs in a folder, without what depends on the run."""
    files = [path for path in folder.rglob("*") if path.is_file()]
    outputs = (path for path in files if path.parent == folder or any(parent.suffix == ".zarr" for parent in path.parents))
    found = {str(path.relative_to(folder)): path.read_bytes() for path in outputs}
    for name in found:
        if name.endswith(".json"):
            report = json.loads(found[name])
            found[name] = {key: value for key, value in report.items() if key not in RUN_KEYS}
        elif name.endswith(".html"):
            found[name] = re.sub(rb'<section id="run">.*?</section>', b"", found[name], flags=re.DOTALL)
    return found


class JobTestCase(ProgramTestCase):
    """Outputs of jobs are in self.target, their folder is self.target/job."""

    def setUp(self):
        super().setUp()
        self.target = self.folder / "target"
        self.target.mkdir()
        self.job = self.target / "job"

    def in_target(self, *arguments, status=DONE):
        """Runs the program in the folder of the outputs."""
        command = [PROGRAM, *map(str, arguments)]
        result = subprocess.run(command, capture_output=True, text=True, cwd=self.target, check=False)
        self.assertEqual(result.returncode, status, f"{arguments}\n{result.stdout}{result.stderr}")
        if status != DONE:
            self.assertEqual(result.stdout, "", arguments)
            self.assertTrue(result.stderr.startswith("medialvoxel: "), result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        return result

    def expect(self, *arguments):
        """What the program makes in a folder of its own, beside that of the outputs."""
        target, self.target = self.target, self.folder / "expected"
        self.target.mkdir()
        self.in_target(*arguments)
        found, self.target = results(self.target), target
        return found

    def clear_target(self):
        for path in self.target.iterdir():
            shutil.rmtree(path) if path.is_dir() else path.unlink()

    def start(self, *arguments):
        """Begins to run the program in the folder of the outputs."""
        process = subprocess.Popen(
            [PROGRAM, *map(str, arguments)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.target,
        )  # fmt: skip
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
        process.communicate()

    def status(self):
        return json.loads(self.in_target("status", "job", "--json").stdout)

    def markers(self):
        """Names of the markers, and when they were written."""
        return {path.name: path.stat().st_mtime_ns for path in (self.job / "clusters").glob("*.json")}

    def assert_nothing_published(self):
        names = {path.name for path in self.target.iterdir() if path != self.job}
        self.assertFalse({name for name in names if not name.endswith(".partial")})
