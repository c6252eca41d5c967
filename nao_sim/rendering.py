"""Which OpenGL MuJoCo renders with when there is no screen, and whether it really does.

MuJoCo reads the environment variable ``MUJOCO_GL`` once, when it is first imported; without a display its default (a
window) cannot render, and with a value that this machine cannot serve it cannot even be imported. So the choice is
made when ``nao_sim`` is imported: the user's where it works, else a library without a screen that is installed, else
none, with the reason kept for whoever asks for a picture. What needs no pictures always runs.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import socket
import subprocess
import sys

# EGL first: dm_control leaves an error message behind when it exits under OSMesa.
_HEADLESS = (("egl", "libEGL.so.1"), ("osmesa", "libOSMesa.so.8"), ("osmesa", "libOSMesa.so.6"))
_NO_PICTURES = "disable"
_OFF = frozenset({"disable", "disabled", "off", "false", "0"})
_DEFAULT = frozenset({"", "enable", "enabled", "on", "true", "1"})

REASON = "NAO_SIM_NO_GL"
"""Environment variable that tells child processes why their parent renders nothing."""

HOW_TO_GET_GL = "on Debian or Ubuntu: apt-get install libegl1 libgl1-mesa-dri"
_UNSET = "unset MUJOCO_GL, and what is installed is chosen"
_TRIAL_S = 120.0


def choose_headless_gl() -> str | None:
    """Set ``MUJOCO_GL`` to what can render here, as far as can be told without trying; return what is set.

    The user's own choice is kept where this machine can serve it, and so is a display that answers.
    """
    chosen = os.environ.get("MUJOCO_GL", "").strip().lower()
    if not sys.platform.startswith("linux") or "mujoco" in sys.modules:
        return chosen or None
    if chosen in _OFF:
        return chosen
    reason = None if chosen in _DEFAULT else _why_not(chosen)
    if chosen in _DEFAULT and not _display_answers():
        found = next((name for name, library in _HEADLESS if _loads(library)), None)
        if found is None:
            return chosen or None
        os.environ["MUJOCO_GL"] = chosen = found
    platform = os.environ.get("PYOPENGL_PLATFORM", "").lower()
    if reason is None and chosen in ("egl", "osmesa") and platform not in ("", chosen):
        reason = f"PYOPENGL_PLATFORM={platform} contradicts MUJOCO_GL={chosen}; unset PYOPENGL_PLATFORM"
    if reason is not None:
        os.environ["MUJOCO_GL"], os.environ[REASON] = _NO_PICTURES, reason
    return os.environ.get("MUJOCO_GL")


def _why_not(chosen: str) -> str | None:
    """Return why MuJoCo cannot render with a user's choice, and the mend; None: nothing is known against it."""
    libraries = [library for name, library in _HEADLESS if name == chosen]
    if libraries:
        there = any(map(_loads, libraries))
        return None if there else f"MUJOCO_GL={chosen} needs {libraries[0]}, which is not installed; {_UNSET}"
    if chosen in ("glfw", "glx"):
        return None if _display_answers() else f"MUJOCO_GL={chosen} needs a display, and none answers; {_UNSET}"
    return f"MUJOCO_GL={chosen} is nothing that MuJoCo knows; it knows egl, osmesa and glfw; {_UNSET}"


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _display_answers() -> bool:
    """Whether the display that the environment names takes connections; a session that has ended leaves the name."""
    if os.environ.get("WAYLAND_DISPLAY"):
        path = os.path.join(os.environ.get("XDG_RUNTIME_DIR", ""), os.environ["WAYLAND_DISPLAY"])
        if _connects(socket.AF_UNIX, path):
            return True
    host, colon, rest = os.environ.get("DISPLAY", "").rpartition(":")
    number = rest.partition(".")[0]
    if not colon or not number.isdecimal():
        return False
    if host in ("", "unix"):
        path = f"/tmp/.X11-unix/X{number}"
        return _connects(socket.AF_UNIX, path) or _connects(socket.AF_UNIX, f"\0{path}")
    return _connects(socket.AF_INET, (host, 6000 + int(number)))


def _connects(family: int, address: object) -> bool:
    try:
        with socket.socket(family, socket.SOCK_STREAM) as line:
            line.settimeout(2.0)
            line.connect(address)  # type: ignore[arg-type]
    except (OSError, ValueError):
        return False
    return True


def gl_problem() -> str | None:
    """Return why nothing can be rendered here, in one line with the mend; None if a picture was really rendered."""
    if os.environ.get("MUJOCO_GL", "").lower() in _OFF:
        reason = os.environ.get(REASON) or f"MUJOCO_GL={os.environ['MUJOCO_GL']} turns them off; {_UNSET}"
        return f"no pictures: {reason}"
    import mujoco

    try:
        model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><geom size="1"/></worldbody></mujoco>')
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        with mujoco.Renderer(model, 16, 16) as renderer:
            renderer.update_scene(data)
            if not renderer.render().any():
                return f"no pictures (they come out black); {HOW_TO_GET_GL}"
    except Exception as error:  # each GL library fails in its own way
        reason = " ".join(str(error).split()) or type(error).__name__
        return f"no pictures ({reason}); {HOW_TO_GET_GL}"
    return None


def gl_problem_elsewhere() -> str | None:
    """Return :func:`gl_problem` of another process, which a broken driver may end without harm to this one."""
    program = "from nao_sim.rendering import gl_problem; print(gl_problem() or '')"
    try:
        done = subprocess.run(
            [sys.executable, "-c", program], capture_output=True, text=True, timeout=_TRIAL_S, check=False
        )
    except subprocess.TimeoutExpired:
        return f"no pictures (a trial did not end within {_TRIAL_S:.0f} s); {HOW_TO_GET_GL}"
    if done.returncode:
        last = (done.stderr.strip().splitlines() or ["no reason given"])[-1]
        return f"no pictures (a trial ended with {done.returncode}: {last}); {HOW_TO_GET_GL}"
    return (done.stdout.strip().splitlines() or [""])[-1] or None
