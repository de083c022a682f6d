# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs that are killed leave nothing where the file system has files without a name, and otherwise what the next run
removes; runs that write the same output at the same time leave the files of one."""

import os
import pathlib
import random
import re
import signal
import subprocess
import time
import unittest

import volumes
import zarr_folder
from processes import state_of, wait_until
from program import DONE, PROGRAM, REFUSED, ProgramTestCase, has_begun, wait_for_begin
from system_calls import command_with, kill_at_each, needs_strace, run_with
from test_identity import rough_shell

MODULE = pathlib.Path(os.environ["MEDIALVOXEL_MODULE"])
# All kinds of outputs that are files, by the option; the one without an option appears last.
PROGRAM_OUTPUTS = {
    "--vectors": "v.nrrd", "--distance": "d.mhd", "--thickness-map": "t.nhdr", "--mesh": "m.vtp",
    "--preview": "p.png", "--html": "h.html", "--report": "r.json", "": "out.mhd",
}  # fmt: skip
MODULE_OUTPUTS = {
    "--vectorVolume": "v.mha", "--distanceVolume": "d.nhdr", "--thicknessMap": "t.mhd", "--meshModel": "m.ply",
    "--reportFile": "r.json", "--previewFile": "p.png", "--returnparameterfile": "r.txt", "": "out.mha",
}  # fmt: skip
DISTANCE_OUTPUTS = {"--distance": "d.mhd", "--report": "r.json", "": "v.nhdr"}
KILLS = 12
NAME = r"[0-9a-f]{12}-[0-9]+-[0-9]+-[0-9]+\.partial"


def arguments_of(outputs):
    return [text for option, name in outputs.items() if option for text in (option, name)]


COMMANDS = {
    "extract": ([PROGRAM, "extract", "in.mha", "out.mhd", *arguments_of(PROGRAM_OUTPUTS)], PROGRAM_OUTPUTS),
    "distance": ([PROGRAM, "distance", "in.mha", "v.nhdr", *arguments_of(DISTANCE_OUTPUTS)], DISTANCE_OUTPUTS),
    "mesh": ([PROGRAM, "mesh", "in.mha", "m.stl", "--report", "r.json"], {"--report": "r.json", "": "m.stl"}),
    "surface": ([PROGRAM, "surface", "in.mha", "s.glb", "--ray", "--report", "r.json"], {"--report": "r.json", "": "s.glb"}),
    "module": ([MODULE, *arguments_of(MODULE_OUTPUTS), "in.mha", "out.mha"], MODULE_OUTPUTS),
}


class LeftoverCase(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.addCleanup(self.end_processes)
        self.processes = []

    def end_processes(self):
        for process in self.processes:
            process.kill()
            process.wait()

    def start(self, command, stderr=subprocess.DEVNULL):
        process = subprocess.Popen(
            list(map(str, command)), cwd=self.folder, stdout=subprocess.DEVNULL, stderr=stderr, text=True
        )
        self.processes.append(process)
        return process

    def names(self):
        return {path.name for path in self.folder.iterdir()}

    def data_file(self, header):
        """The file of voxels that a header names; None for a file that is no header."""
        content = (self.folder / header).read_bytes()
        found = re.search(rb"\A(?:ObjectType|NRRD)(?:.*\n)*?(?:ElementDataFile = |data file: )(.*)\n", content)
        return found and found[1].decode()

    def with_voxels(self, names):
        """These files, and the voxels that their headers name."""
        headers = [name for name in names if re.search(r"\.(mhd|nhdr)(\.|$)", name)]
        return {*names, *filter(None, map(self.data_file, headers))}

    def assert_only(self, names, label=""):
        """The folder has these files, the voxels that their headers name, and the input."""
        self.assertEqual(self.names(), {"in.mha", *self.with_voxels(names)}, label)

    def assert_only_and_one_between_two_names(self, names, label):
        """An output that replaces a file has a temporary name for a moment, a header and its voxels one each; the next run
        removes them."""
        passing = {name for name in self.names() if name.endswith(".partial")}
        outputs = {re.sub(rf"\.{NAME}\Z", "", name) for name in passing}
        self.assertLessEqual(len(outputs), 1, label)
        self.assertLessEqual(len(passing), 2, label)
        # The voxels of a header that was replaced go before it.
        surely = {"in.mha", *self.with_voxels(names), *passing}
        self.assertLessEqual(surely, self.names(), label)
        self.assertLessEqual(self.names(), surely | self.with_voxels(passing), label)

    def remove_outputs(self):
        for path in self.folder.iterdir():
            if path.name != "in.mha":
                path.unlink()


class KilledRunTest(LeftoverCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate(size=(96, 96, 64)))

    def check(self, command, outputs, overwrites):
        """Kills a run again and again, and whatever the moment, there are whole outputs and nothing else."""
        seed = random.randrange(1 << 32)
        generator = random.Random(seed)
        start = time.monotonic()
        self.assertEqual(self.start(command).wait(), DONE)
        seconds = time.monotonic() - start
        self.assert_only(outputs.values())
        at_work = 0
        for kill in range(KILLS):
            if not overwrites:
                self.remove_outputs()
            process = self.start(command + ["--overwrite"] if overwrites and PROGRAM in command else command)
            # Moments all over the run; the first one is sure to be in the work.
            if kill:
                time.sleep(seconds * (kill + generator.random()) / KILLS)
            else:
                wait_for_begin(process, self.folder)
            at_work += has_begun(process, self.folder)
            process.kill()
            process.wait()
            found = [name for name in outputs.values() if (self.folder / name).exists()]
            check = self.assert_only_and_one_between_two_names if overwrites else self.assert_only
            check(found, f"seed {seed}, kill {kill}")
            if overwrites or outputs[""] in found:
                self.assertEqual(found, list(outputs.values()), f"seed {seed}, kill {kill}")
        self.assertGreater(at_work, 0, "no kill hit the work")
        if overwrites:
            self.assertEqual(self.start(command + ["--overwrite"] if PROGRAM in command else command).wait(), DONE)
            self.assert_only(outputs.values(), f"seed {seed}, after the last kill")

    def test_new_outputs(self):
        for name, (command, outputs) in COMMANDS.items():
            with self.subTest(name):
                self.remove_outputs()
                self.check(command, outputs, False)

    def test_outputs_that_are_replaced(self):
        for name, (command, outputs) in COMMANDS.items():
            with self.subTest(name):
                self.remove_outputs()
                self.check(command, outputs, True)


@needs_strace
class EachCallTest(LeftoverCase):
    """Killed at any call that changes names: the next run makes all well."""

    PLACE = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    CALLS = "linkat link unlink renameat2 rename fsync".split()
    # Without /proc, a file without a name would never get one.
    NAMED = "access:error=ENOENT"
    OUTPUTS = {"--distance": "d.nhdr", "--preview": "p.png", "": "out.mhd"}

    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", rough_shell())
        self.command = ["extract", "in.mha", "out.mhd", "--thickness", 2, *arguments_of(self.OUTPUTS), "--threads", 1]

    def read_all(self):
        """Contents of the outputs, of a header those of its voxels."""
        return {
            name: (self.folder / (self.data_file(name) if name.endswith((".mhd", ".nhdr")) else name)).read_bytes()
            for name in self.OUTPUTS.values()
        }

    def check(self, overwrites, always=""):
        command = [*self.command, "--overwrite"] if overwrites else self.command
        self.run_program(*self.command)
        expected = self.read_all()

        def prepare():
            self.remove_outputs()
            if overwrites:
                self.run_program(*self.command)

        def check(label):
            if overwrites:
                self.assertEqual(self.read_all(), expected, label)
            self.run_program(*self.command, "--overwrite")
            self.assert_only(self.OUTPUTS.values(), label)
            self.assertEqual(self.read_all(), expected, label)

        return sum(kill_at_each(call, command, prepare, check, self.folder, always) for call in self.CALLS)

    def test_new_outputs(self):
        self.assertGreater(self.check(False), 15)

    def test_outputs_that_are_replaced(self):
        self.assertGreater(self.check(True), 20)

    def test_mesh_appears_after_its_report(self):
        command = ["mesh", "in.mha", "m.stl", "--thickness", 2, "--report", "r.json", "--threads", 1]

        def check(label):
            self.assertFalse("m.stl" in self.names() and "r.json" not in self.names(), label)

        self.assertEqual(kill_at_each("linkat", command, self.remove_outputs, check, self.folder), 2)

    def test_without_names_for_files_without_one(self):
        """As in a sandbox: the bytes are copied."""
        self.run_program(*self.command)
        expected = self.read_all()
        for more in ([], ["--sparse"]):
            self.remove_outputs()
            result = run_with("linkat:error=EPERM", [*self.command, *more], self.folder)
            self.assertEqual(result.returncode, DONE, result.stderr)
            self.assert_only(self.OUTPUTS.values())
            self.assertEqual(self.read_all(), expected)

    def test_with_named_files(self):
        """As on a disk of a network: what a killed run leaves is seen, and the next run removes it."""
        self.assertGreater(self.check(False, self.NAMED), 15)
        self.remove_outputs()
        self.assertGreater(self.check(True, self.NAMED), 20)

    def test_with_named_files_without_exchange(self):
        """As with many file systems of FUSE."""
        self.CALLS = "link unlink rename".split()
        self.assertGreater(self.check(True, f"{self.NAMED} renameat2:error=EINVAL"), 8)

    def test_with_named_files_without_second_names(self):
        """As on a disk of a camera."""
        self.run_program(*self.command)
        expected = self.read_all()
        for more in ([], ["--overwrite"]):
            if not more:
                self.remove_outputs()
            result = run_with(f"{self.NAMED} link:error=EPERM renameat2:error=EINVAL", [*self.command, *more], self.folder)
            self.assertEqual(result.returncode, DONE, result.stderr)
            self.assert_only(self.OUTPUTS.values())
            self.assertEqual(self.read_all(), expected)


class SweepTest(LeftoverCase):
    """Folders have names while they are written."""

    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate(size=(96, 96, 64)))

    def leftovers(self):
        return {name for name in self.names() if name.endswith(".partial")}

    def begin(self, name):
        """A run that waits after its folder is there."""
        process = self.start([PROGRAM, "extract", "in.mha", name, "--thickness", 3, "--divisions", 40])
        wait_until(lambda: process.poll() is not None or list(self.folder.glob(name + ".*")), "its folder")
        process.send_signal(signal.SIGSTOP)
        (left,) = self.folder.glob(name + ".*")
        self.assertRegex(left.name, rf"\A{re.escape(name)}\.{NAME}\Z")
        return process

    def run_other(self):
        self.run_program("distance", "in.mha", "other.mha", "--overwrite")

    def test_of_a_killed_run_is_removed_and_of_a_running_one_stays(self):
        first, second = self.begin("a.zarr"), self.begin("b.zarr")
        self.run_other()
        self.assertEqual(len(self.leftovers()), 2)
        second.kill()  # and not waited for: the system still knows the process
        wait_until(lambda: state_of(second.pid) == "Z", "the end of the process")
        self.run_other()
        (left,) = self.leftovers()
        self.assertTrue(left.startswith("a.zarr."), left)
        first.send_signal(signal.SIGCONT)
        self.assertEqual(first.wait(), DONE)
        self.assertEqual(self.names(), {"in.mha", "other.mha", "a.zarr"})
        self.run_program("extract", "in.mha", "whole.mha", "--thickness", 3)
        self.assertEqual(
            zarr_folder.read_data(self.folder / "a.zarr"), volumes.read_data(self.folder / "whole.mha")
        )

    def test_of_the_module_too(self):
        self.begin("a.zarr").kill()
        self.processes[0].wait()
        subprocess.run([MODULE, "in.mha", "out.mha"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(self.names(), {"in.mha", "out.mha"})

    def test_not_by_a_run_that_is_refused_or_dry(self):
        self.begin("a.zarr").kill()
        self.processes[0].wait()
        before = self.snapshot()
        self.run_program("distance", "in.mha", "in.mha", status=2)
        self.run_program("distance", "in.mha", "other.mha", "--dry-run")
        self.assertEqual(self.snapshot(), before)

    def test_not_of_others(self):
        self.begin("a.zarr").kill()
        self.processes[0].wait()
        (left,) = self.leftovers()
        host, number, begun, attempt = re.search(NAME, left)[0].removesuffix(".partial").split("-")
        elsewhere = ("0" if host[0] != "0" else "1") + host[1:]
        alive = pathlib.Path(f"/proc/{os.getpid()}/stat").read_text().rsplit(")", 1)[1].split()[19]
        foreign = {
            f"b.mha.{elsewhere}-{number}-{begun}-{attempt}.partial",
            f"b.mha.{host}-{os.getpid()}-{alive}-{attempt}.partial",
            f"b.mha.{number}-0.partial",
            f"{left}.old",
            "notes.partial",
        }
        for name in foreign:
            (self.folder / name).write_text("precious")
        (self.folder / f"c.mha.{host}-{number}-{begun}-{attempt}.partial").write_text("of the dead process")
        self.run_other()
        self.assertEqual(self.names(), {"in.mha", "other.mha", *foreign})


class AtOnceTest(LeftoverCase):
    ROUNDS = 12

    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())

    def check(self, name, overwrites, injections=""):
        arguments = ["extract", "in.mha", name, "--thickness", 3, *overwrites]
        command = command_with(injections, arguments) if injections else [PROGRAM, *arguments]
        contents = set()
        for attempt in range(self.ROUNDS):
            if not overwrites:
                self.remove_outputs()
            runs = [self.start(command, subprocess.PIPE) for _ in range(4)]
            messages = "".join(run.communicate()[1] for run in runs)
            statuses = sorted(run.returncode for run in runs)
            if overwrites:
                self.assertEqual(statuses, [DONE] * 4, messages)
            else:
                self.assertEqual(statuses, [DONE] + [REFUSED] * 3, messages)
            self.assert_only([name], attempt)
            contents.add((self.folder / self.data_file(name)).read_bytes())
        self.assertEqual(len(contents), 1)

    def test_new_output(self):
        for name in ("out.mhd", "out.nhdr"):
            self.remove_outputs()
            self.check(name, [])

    @needs_strace
    def test_file_system_without_exchange_of_names(self):
        for overwrites in ([], ["--overwrite"]):
            self.remove_outputs()
            self.check("out.mhd", overwrites, "access:error=ENOENT renameat2:error=EINVAL")

    def test_output_that_is_replaced(self):
        for name in ("out.mhd", "out.nhdr"):
            self.remove_outputs()
            self.check(name, ["--overwrite"])


if __name__ == "__main__":
    unittest.main()
