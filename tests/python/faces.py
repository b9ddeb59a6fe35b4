"""What the tests of the package share."""

import os
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np
import sweepface

SAMPLE = os.environ["SWEEPFACE_SAMPLE"]


def sheet():
    """A sheet of 6 x 5 vertices and a target that lifts its middle."""
    x, y = np.meshgrid(np.arange(6.0), np.arange(5.0))
    flat = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    lifted = flat + np.outer(np.exp(-((flat[:, 0] - 2.5) ** 2) - (flat[:, 1] - 2) ** 2), [0, 0, 1])
    faces = [(6 * j + i, 6 * j + i + 1, 6 * j + i + 7, 6 * j + i + 6) for j in range(4) for i in range(5)]
    return sweepface.Meshes(flat, faces, {"lift": lifted})


def interrupted(program, after):
    """What a program prints, on one core, if Ctrl-C comes `after` seconds after its work() began; it catches that."""
    start = (
        "import os, signal\n"
        "if hasattr(os, 'sched_setaffinity'): os.sched_setaffinity(0, list(os.sched_getaffinity(0))[:1])\n"
        "import numpy as np, sweepface, time\n"
        f"rig = sweepface.load({SAMPLE!r})\n"
    )
    run = (
        "\nsignal.signal(signal.SIGALRM, signal.default_int_handler)\n"
        f"signal.setitimer(signal.ITIMER_REAL, {after})\n"
        "began = time.monotonic()\n"
        "try: work(); print('finished')\n"
        "except KeyboardInterrupt: print('interrupted', time.monotonic() - began, left())\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", start + program + run], check=True, timeout=300, capture_output=True, text=True
    )
    return done.stdout.split()


class FaceTest(unittest.TestCase):
    """Has the sample face, and a folder for files."""

    @classmethod
    def setUpClass(cls):
        cls.rig = sweepface.load(SAMPLE)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        warnings.simplefilter("error")
        self.addCleanup(warnings.resetwarnings)

    def path(self, name):
        return os.path.join(self.folder, name)

    def refuses(self, sentence):
        return self.assertRaisesRegex(sweepface.Error, sentence)
