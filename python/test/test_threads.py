# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Other threads run while the engine works; progress, Ctrl-C and exceptions of the progress stop it soon."""

import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import medialvoxel
import numpy as np

from interrupts import interrupt, processor_seconds
from support import blob, scene, slow_noise, slow_options
from processes import PATIENCE, wait_until

# Works until it is killed.
SLOW = """
import sys
sys.path.insert(0, {tests!r})
import medialvoxel, support
values = support.slow_noise()
print("begin", flush=True)
medialvoxel.extract(values, threads=1, **support.slow_options)
"""


def hindered_seconds():
    """For how long this thread could have gone on, and others had the processors."""
    return int(pathlib.Path("/proc/thread-self/schedstat").read_text().split()[1]) / 1e9


def measure_speed(seconds):
    """Rounds of a loop that this thread does in a second in which it is not hindered."""
    rounds = 0
    hindered = hindered_seconds()
    begin = time.perf_counter()
    while time.perf_counter() < begin + seconds:
        rounds += 1
    return rounds / (time.perf_counter() - begin - (hindered_seconds() - hindered))


def pause_after(calls):
    """A progress that raises at a call."""
    seen = []

    def progress(done):
        seen.append(done)
        if len(seen) == calls:
            raise KeyError("enough")

    return progress


class Threads(unittest.TestCase):
    def test_another_thread_keeps_its_speed(self):
        seconds = 2.0
        values = slow_noise()
        stop = threading.Event()

        def work():
            try:
                medialvoxel.extract(values, threads=1, progress=lambda _: self.end_when(stop), **slow_options)
            except KeyError:
                pass

        # Beside the same work in another process, which takes processors but no lock. The best of a few: others disturb.
        source = SLOW.format(tests=str(pathlib.Path(__file__).parent))
        shares = []
        while len(shares) < 5 and max(shares, default=0.0) < 0.8:
            with subprocess.Popen([sys.executable, "-c", source], stdout=subprocess.PIPE, text=True) as other:
                other.stdout.readline()
                begin = processor_seconds(other.pid)
                wait_until(lambda: processor_seconds(other.pid) >= begin + 0.5, "work beside")  # noqa: B023
                beside_process = measure_speed(seconds)
                other.kill()
            stop.clear()
            worker = threading.Thread(target=work)
            begin = time.process_time()
            worker.start()
            wait_until(lambda: time.process_time() >= begin + 0.5, "work in a thread")  # noqa: B023
            beside_thread = measure_speed(seconds)
            stop.set()
            worker.join()
            shares.append(beside_thread / beside_process)
        print(f"another thread keeps {100 * max(shares):.0f} % of its speed")
        self.assertGreaterEqual(max(shares), 0.8)

    @staticmethod
    def end_when(event):
        if event.is_set():
            raise KeyError("enough")

    def assert_interrupted(self, call, values="support.slow_noise()"):
        self.assertLess(interrupt(call, values), 1 * PATIENCE)

    def test_interrupted_extraction(self):
        self.assert_interrupted("extract(values, thickness=154.0)")

    def test_interrupted_mesh(self):
        self.assert_interrupted("mesh(values, thickness=154.0)")

    def test_interrupted_distance(self):
        self.assert_interrupted("distance(values)", "support.blob(500)")

    def test_interrupted_local_thickness(self):
        self.assert_interrupted("local_thickness(values, largest_ball=200)", "support.blob(400)")

    def test_progress(self):
        for call in (medialvoxel.extract, medialvoxel.mesh, medialvoxel.distance, medialvoxel.local_thickness):
            seen = []
            call(scene(), lower=40, progress=seen.append)
            self.assertEqual(seen, sorted(seen))
            self.assertEqual(seen[-1], 1.0)

    def test_progress_of_long_work(self):
        seen = []
        medialvoxel.extract(blob(), thickness=3.0, progress=seen.append, threads=1)
        self.assertGreater(len(set(seen)), 3)

    def test_threads_are_those_that_the_process_may_use(self):
        """In a process of its own, whose affinity is one processor; beside the work there is the thread that watches it."""
        source = (
            "import os, sys; sys.path.insert(0, {tests!r}); os.sched_setaffinity(0, list(os.sched_getaffinity(0))[:1])\n"
            "import medialvoxel, support\n"
            "begin, most = len(os.listdir('/proc/self/task')), []\n"
            "medialvoxel.extract(support.blob(), threads={threads}, progress=lambda _: most.append(len(os.listdir('/proc/self/task'))))\n"
            "print(max(most) - begin)\n"
        )
        for threads, expected in ((None, 1), (3, 3)):
            text = source.format(tests=str(pathlib.Path(__file__).parent), threads=threads)
            done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True)
            self.assertEqual((done.stdout, done.returncode), (f"{expected}\n", 0), done.stderr)

    def test_a_quota_of_processors(self):
        every = len(os.sched_getaffinity(0))
        with tempfile.TemporaryDirectory() as folder:
            quota = pathlib.Path(folder, "cpu.max")
            for text, expected in (("max 100000", every), ("50000 100000", 1), ("100001 100000", min(2, every)), ("900000 1000", every)):
                quota.write_text(text + "\n")
                self.assertEqual(medialvoxel._threads.count_processors(quota), expected, text)
            self.assertEqual(medialvoxel._threads.count_processors(pathlib.Path(folder, "none")), every)

    def test_an_exception_of_the_progress(self):
        begin = time.monotonic()
        with self.assertRaisesRegex(KeyError, "enough"):
            medialvoxel.extract(slow_noise(), progress=pause_after(1), **slow_options)
        self.assertLess(time.monotonic() - begin, 3.0 * PATIENCE)
        self.assertEqual(medialvoxel.extract(scene(), lower=40).labels.shape, scene().shape)

    def test_several_calls_at_once(self):
        expected = medialvoxel.extract(scene(), lower=40, vectors=True)
        found = [None] * 6

        def work(i):
            found[i] = medialvoxel.extract(scene(), lower=40, vectors=True)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(len(found))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for one in found:
            np.testing.assert_array_equal(one.labels, expected.labels)
            np.testing.assert_array_equal(one.vectors, expected.vectors)

    def test_a_bar_of_tqdm(self):
        try:
            import tqdm  # noqa: F401
        except ImportError:
            self.skipTest("skipped: no tqdm")
        medialvoxel.extract(scene(), lower=40, progress=True)


if __name__ == "__main__":
    unittest.main()
