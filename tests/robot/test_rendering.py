"""Which OpenGL is chosen, and that what cannot work is said in one line and holds up nothing that needs no pictures."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading

import numpy as np
import pytest

from nao_sim.robot import Nao, RenderError, UnknownNameError

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere MuJoCo needs no choice")

BROKEN = {
    "a stale display": ({"MUJOCO_GL": "glfw", "DISPLAY": ":77"}, "MUJOCO_GL=glfw needs a display, and none answers"),
    "no display": ({"MUJOCO_GL": "glfw"}, "MUJOCO_GL=glfw needs a display"),
    "no such value": ({"MUJOCO_GL": "foo"}, "MUJOCO_GL=foo is nothing that MuJoCo knows"),
    "switched off": ({"MUJOCO_GL": "off"}, "MUJOCO_GL=off turns them off"),
    "two wills": ({"MUJOCO_GL": "egl", "PYOPENGL_PLATFORM": "glx"}, "PYOPENGL_PLATFORM=glx contradicts MUJOCO_GL=egl"),
    "no such device": ({"MUJOCO_GL": "egl", "MUJOCO_EGL_DEVICE_ID": "99"}, "MUJOCO_EGL_DEVICE_ID"),
}

PROGRAM = """
import json
from nao_sim import Nao
nao = Nao()
nao.step()
try:
    nao.camera()
    said = ""
except Exception as error:
    said = f"{type(error).__name__}: {error}"
print(json.dumps(said))
"""


def _run(program: list[str], **changed: str) -> subprocess.CompletedProcess[str]:
    kept = {key: value for key, value in os.environ.items() if "GL" not in key and "DISPLAY" not in key}
    return subprocess.run([sys.executable, *program], capture_output=True, text=True, env=kept | changed, check=False)


@pytest.mark.parametrize("case", BROKEN)
def test_what_cannot_render_is_one_line_and_the_robot_moves_all_the_same(case: str) -> None:
    changed, said = BROKEN[case]
    done = _run(["-c", PROGRAM], **changed)
    assert done.returncode == 0, done.stderr
    error = json.loads(done.stdout)
    assert error.startswith("RenderError: no pictures")
    assert said in error


def test_check_says_so_too_and_the_main_job_is_sound() -> None:
    changed, said = BROKEN["a stale display"]
    done = _run(["-m", "nao_sim", "check", "--json"], **changed)
    assert done.returncode == 0, done.stderr
    found = {row["what"]: row for row in json.loads(done.stdout)}
    assert found["rendering (optional)"]["ok"] is False
    assert said in found["rendering (optional)"]["detail"]
    assert found["mujoco + dm_control"]["ok"]


def test_a_display_that_does_not_answer_is_no_reason(gl: None) -> None:
    done = _run(["-c", PROGRAM], DISPLAY=":77")
    assert json.loads(done.stdout) == ""


def test_any_thread_gets_the_same_picture(gl: None) -> None:
    with Nao() as nao:
        here, there = nao.camera("outside", 160, 120), []
        for _ in range(2):
            thread = threading.Thread(target=lambda: there.append(nao.camera("outside", 160, 120)))
            thread.start()
            thread.join()
        assert all(np.array_equal(here, picture) for picture in there)
        assert len(there) == 2
        assert np.array_equal(here, nao.camera("outside", 160, 120))


@pytest.mark.parametrize("size", [(0, 480), (640, -1), (1.5, 3), (100_000, 10), (float("nan"), 3)])
def test_an_impossible_size_is_told_as_one(size: tuple[float, float], standing: Nao) -> None:
    with pytest.raises(RenderError, match="whole numbers from 1 to 8192") as caught:
        standing.camera("CameraTop", *size)  # type: ignore[arg-type]
    assert "MUJOCO_GL" not in str(caught.value)


def test_a_camera_that_is_not_there_is_told_with_those_that_are(standing: Nao) -> None:
    with pytest.raises(UnknownNameError, match="CameraTop"):
        standing.camera("CameraTpo")
