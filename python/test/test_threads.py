# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Other threads run while the engine works; progress, Ctrl-C and exceptions of the progress stop it soon."""

import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest

import medialvoxel
import numpy as np

from support import PATIENCE, blob, scene, slow_noise, slow_options

# Waits until the engine works, is interrupted, and tells the seconds that it took from there.
# A shell that runs the tests in the background leaves the signal ignored.
INTERRUPTED = """
import signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.path.insert(0, {tests!r})
import medialvoxel, support
values = {values}
print("begin", flush=True)
try:
    medialvoxel.{call}
except KeyboardInterrupt:
    print("interrupted", time.time(), flush=True)
print(medialvoxel.extract(support.scene(), lower=40).counts["object_voxels"])
"""


# Works until it is killed.
SLOW = """
import sys
sys.path.insert(0, {tests!r})
import medialvoxel, support
values = support.slow_noise()
print("begin", flush=True)
medialvoxel.extract(values, threads=1, **support.slow_options)
"""


def count_for(seconds):
    """Rounds of a loop that this thread does in so many seconds."""
    rounds = 0
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        rounds += 1
    return rounds


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
                time.sleep(0.5)
                beside_process = count_for(seconds)
                other.kill()
            stop.clear()
            worker = threading.Thread(target=work)
            worker.start()
            time.sleep(0.5)
            beside_thread = count_for(seconds)
            stop.set()
            worker.join()
            shares.append(beside_thread / beside_process)
        print(f"another thread keeps {100 * max(shares):.0f} % of its speed")
        self.assertGreaterEqual(max(shares), 0.8)

    @staticmethod
    def end_when(event):
        if event.is_set():
            raise KeyError("enough")

    def interrupt(self, call, values="support.slow_noise()"):
        source = INTERRUPTED.format(tests=str(pathlib.Path(__file__).parent), call=call, values=values)
        process = subprocess.Popen([sys.executable, "-c", source], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual(process.stdout.readline(), "begin\n", "" if process.poll() is None else process.stderr.read())
        time.sleep(1.5)
        sent = time.time()
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, errors)
        word, when = output.splitlines()[0].split()
        self.assertEqual(word, "interrupted", output)
        print(f"Ctrl-C stops {call.split('(')[0]} after {float(when) - sent:.2f} s")
        self.assertLess(float(when) - sent, 1.0 * PATIENCE)

    def test_interrupted_extraction(self):
        self.interrupt("extract(values, thickness=154.0)")

    def test_interrupted_mesh(self):
        self.interrupt("mesh(values, thickness=154.0)")

    def test_interrupted_distance(self):
        self.interrupt("distance(values)", "support.blob(500)")

    def test_interrupted_local_thickness(self):
        self.interrupt("local_thickness(values, maximum=200)", "support.blob(400)")

    def test_progress(self):
        for call in (medialvoxel.extract, medialvoxel.mesh, medialvoxel.distance, medialvoxel.local_thickness):
            seen = []
            call(scene(), lower=40, progress=seen.append)
            self.assertEqual(seen, sorted(seen))
            self.assertEqual(seen[-1], 1.0)

    def test_progress_of_long_work(self):
        seen = []
        medialvoxel.extract(blob(), 3.0, progress=seen.append, threads=1)
        self.assertGreater(len(set(seen)), 3)

    def test_an_exception_of_the_progress(self):
        begin = time.monotonic()
        with self.assertRaisesRegex(KeyError, "enough"):
            medialvoxel.extract(slow_noise(), progress=pause_after(1), **slow_options)
        self.assertLess(time.monotonic() - begin, 3.0 * PATIENCE)
        self.assertEqual(medialvoxel.extract(scene(), lower=40).labels.shape, scene().shape)

    def test_several_calls_at_once(self):
        expected = medialvoxel.extract(scene(), lower=40)
        found = [None] * 6

        def work(i):
            found[i] = medialvoxel.extract(scene(), lower=40)

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
