# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Threads, aborts, exceptions of observers and Ctrl-C leave an interpreter that works."""

import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest

import itk
import numpy as np

from support import blobs, image_of


def long_job():
    """A filter that would take about ten seconds."""
    mask = np.ones((320, 320, 320), "uint8")
    mask[0] = 0
    return itk.MedialVoxelImageFilter.New(image_of(mask), thickness=3.0)


class Interruption(unittest.TestCase):
    def tearDown(self):
        self.assertTrue(itk.medial_voxel_image_filter(blobs(), thickness=3.0).any())

    def test_abort_from_another_thread(self):
        medial = long_job()
        ended = []

        def run():
            try:
                medial.Update()
            except RuntimeError as error:
                ended.append((time.monotonic(), str(error)))

        worker = threading.Thread(target=run)
        worker.start()
        time.sleep(0.5)
        self.assertTrue(worker.is_alive(), "the job was too short, or held the interpreter")
        aborted = time.monotonic()
        medial.AbortGenerateDataOn()
        worker.join(timeout=60)
        self.assertEqual(len(ended), 1, "the update did not end with an exception")
        self.assertLess(ended[0][0] - aborted, 1.0)
        self.assertIn("abort", ended[0][1].lower())

    def test_abort_by_an_observer(self):
        medial = long_job()
        medial.AddObserver(itk.ProgressEvent(), medial.AbortGenerateDataOn)
        with self.assertRaises(RuntimeError):
            medial.Update()

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
        script = "\n".join(
            [
                "import sys, threading",
                f"sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})",
                "from test_interruption import long_job",
                "import itk",
                "from support import blobs",
                "medial = long_job()",
                "worker = threading.Thread(target=lambda: medial.Update())",
                "threading.excepthook = lambda arguments: print('worker', arguments.exc_value is not None)",
                "worker.start()",
                "print('started', flush=True)",
                "try:",
                "    while worker.is_alive(): worker.join(0.1)",
                "    print('ended by itself')",
                "except KeyboardInterrupt:",
                "    medial.AbortGenerateDataOn()",
                "    worker.join()",
                "    print('interrupted', itk.medial_voxel_image_filter(blobs(), thickness=3.0).any(), flush=True)",
            ]
        )
        child = subprocess.Popen([sys.executable, "-B", "-c", script], stdout=subprocess.PIPE, text=True)
        self.assertEqual(child.stdout.readline().strip(), "started")
        time.sleep(0.5)
        child.send_signal(signal.SIGINT)
        output, _ = child.communicate(timeout=120)
        self.assertIn("interrupted True", output)
        self.assertEqual(child.returncode, 0)


if __name__ == "__main__":
    unittest.main()
