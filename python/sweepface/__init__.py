"""Faces and their expressions as ODE sweeping surfaces (docs/python.md).

    rig = sweepface.load("face.sweep")
    face = sweepface.Face(rig)
    positions = face.evaluate({"jawOpen": 0.7})
"""

from ._core import *  # noqa: F403
from ._core import __version__  # noqa: F401
