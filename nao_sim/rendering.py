"""Which OpenGL MuJoCo renders with when there is no screen.

MuJoCo reads the environment variable ``MUJOCO_GL`` once, when it is first imported, and without a display its
default (a window) cannot render. So the choice is made when ``nao_sim`` is imported, unless the user has made it.
"""

from __future__ import annotations

import ctypes
import os
import sys

# EGL first: dm_control leaves an error message behind when it exits under OSMesa.
_HEADLESS = (("egl", "libEGL.so.1"), ("osmesa", "libOSMesa.so.8"), ("osmesa", "libOSMesa.so.6"))

HOW_TO_GET_GL = "on Debian or Ubuntu: apt-get install libegl1 libgl1-mesa-dri"


def choose_headless_gl() -> str | None:
    """Set ``MUJOCO_GL`` to an off-screen library that is installed; return what is set, None if nothing is.

    Leaves the variable alone where the user has set it, where there is a display, and on systems that need none.
    """
    chosen = os.environ.get("MUJOCO_GL")
    if chosen or not sys.platform.startswith("linux") or os.environ.get("DISPLAY"):
        return chosen
    for name, library in _HEADLESS:
        try:
            ctypes.CDLL(library)
        except OSError:
            continue
        os.environ["MUJOCO_GL"] = name
        return name
    return None


def gl_problem() -> str | None:
    """Return why nothing can be rendered here, in one line with the mend; None if rendering works."""
    import mujoco

    try:
        context = mujoco.GLContext(16, 16)
        context.make_current()
        context.free()
    except Exception as error:  # each GL library fails in its own way
        reason = " ".join(str(error).split()) or type(error).__name__
        return f"no off-screen OpenGL ({reason}); {HOW_TO_GET_GL}"
    return None
