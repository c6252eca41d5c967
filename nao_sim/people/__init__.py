"""People on video: rendered actors, the clips they are filmed in, and data sets of such clips."""

from __future__ import annotations

import os
import sys

# MuJoCo chooses its OpenGL platform when it is first imported; without a display only EGL or OSMesa work.
if sys.platform == "linux" and not os.environ.get("DISPLAY"):
    os.environ.setdefault("MUJOCO_GL", "egl")
