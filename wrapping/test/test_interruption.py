# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Threads, aborts, exceptions of observers and Ctrl-C leave an interpreter that works.

An update holds the lock of the interpreter, as all of the official wheels do, but for the calls of observers written
in Python: there, other Python threads run and Ctrl-C is heard. So an update that is to be stopped needs an observer.
"""

import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest

import itk
import numpy as np

from support import blobs, hindrance, image_of


def thick_part():
    """A filter whose update tells its progress many times."""
    mask = np.ones((256, 256, 256), "uint8")
    mask[0] = 0
    return itk.MedialVoxelImageFilter.New(image_of(mask), thickness=3.0)


def hard_part():
    """A filter of which one tile takes minutes: noise, and a thickness that is large in voxels."""
    noise = np.random.default_rng(5).random((160, 160, 160)) < 0.75
    return itk.MedialVoxelImageFilter.New(image_of(noise.astype("uint8")), thickness=154.0)


class Interruption(unittest.TestCase):
    def tearDown(self):
        self.assertTrue(itk.medial_voxel_image_filter(blobs(), thickness=3.0).any())

    def test_abort_from_another_thread(self):
        self.assert_aborts_from_another_thread(thick_part())

    def test_abort_of_a_long_tile_from_another_thread(self):
        self.assert_aborts_from_another_thread(hard_part())

    def assert_aborts_from_another_thread(self, medial):
        is_running = threading.Event()
        is_aborted = threading.Event()
        aborted = []
        hindered = {}

        def abort():
            is_running.wait()
            hindered.update(hindrance())
            medial.AbortGenerateDataOn()
            aborted.append(time.monotonic())
            is_aborted.set()

        def let_others_run():
            is_running.set()
            is_aborted.wait(60)

        medial.AddObserver(itk.ProgressEvent(), let_others_run)
        other = threading.Thread(target=abort)
        other.start()
        with self.assertRaises(RuntimeError) as caught:
            medial.Update()
        ended = time.monotonic()
        lost = max((seconds - hindered.get(thread, 0) for thread, seconds in hindrance().items()), default=0)
        other.join()
        self.assertIn("abort", str(caught.exception).lower())
        # On a machine that is free.
        self.assertLess(ended - aborted[0] - lost, 1.0)

    def test_abort_by_an_observer(self):
        for medial in (thick_part(), hard_part()):
            begin = time.monotonic()
            medial.AddObserver(itk.ProgressEvent(), medial.AbortGenerateDataOn)
            with self.assertRaises(RuntimeError):
                medial.Update()
            self.assertLess(time.monotonic() - begin, 5.0)

    def test_an_observer_raises(self):
        medial = itk.MedialVoxelImageFilter.New(image_of(blobs()), thickness=3.0)

        def fail():
            raise ValueError("not today")

        medial.AddObserver(itk.StartEvent(), fail)
        with self.assertRaises((ValueError, RuntimeError)):
            medial.Update()

    def test_progress_is_told(self):
        heard = []
        medial = itk.MedialVoxelImageFilter.New(image_of(blobs()), thickness=3.0)
        medial.AddObserver(itk.ProgressEvent(), lambda: heard.append(medial.GetProgress()))
        medial.Update()
        self.assertEqual(heard, sorted(heard))
        self.assertEqual(heard[-1], 1.0)

    def test_filters_in_threads(self):
        masks = [blobs(seed=seed) for seed in range(8)]
        expected = [itk.medial_voxel_image_filter(mask, thickness=3.0) for mask in masks]
        results = [None] * len(masks)

        def run(position):
            results[position] = itk.medial_voxel_image_filter(masks[position], thickness=3.0)

        threads = [threading.Thread(target=run, args=(position,)) for position in range(len(masks))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result, labels in zip(results, expected):
            np.testing.assert_array_equal(result, labels)

    def test_interrupt_from_the_keyboard(self):
        """Heard in the observer that waits, and in a long tile by the next call of one that does nothing."""
        self.assert_interrupted("thick_part", "while True: pass")
        self.assert_interrupted("hard_part", "pass")

    def assert_interrupted(self, part, observer):
        script = "\n".join(
            [
                "import signal, sys",
                # A shell that runs the tests in the background leaves the signal ignored.
                "signal.signal(signal.SIGINT, signal.default_int_handler)",
                f"sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})",
                f"from test_interruption import {part}",
                "import itk",
                "from support import blobs",
                f"medial = {part}()",
                "def wait():",
                "    print('progress', flush=True)",
                f"    {observer}",
                "medial.AddObserver(itk.ProgressEvent(), wait)",
                "try:",
                "    medial.Update()",
                "    print('ended by itself')",
                "except (RuntimeError, KeyboardInterrupt):",
                "    print('interrupted', itk.medial_voxel_image_filter(blobs(), thickness=3.0).any(), flush=True)",
            ]
        )
        command = [sys.executable, "-B", "-c", script]
        child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(child.wait)
        self.addCleanup(child.kill)
        while (line := child.stdout.readline()).strip() != "progress":
            self.assertTrue(line, "it has ended")
        sent = time.monotonic()
        child.send_signal(signal.SIGINT)
        output, _ = child.communicate(timeout=120)
        self.assertLess(time.monotonic() - sent, 10.0)
        self.assertIn("interrupted True", output)
        self.assertEqual(child.returncode, 0)


if __name__ == "__main__":
    unittest.main()
