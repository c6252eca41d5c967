"""What the robot sees."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from nao_sim.robot import Nao, UnknownNameError, model_spec

pytestmark = pytest.mark.usefixtures("gl")


@pytest.fixture(scope="module")
def watcher() -> Nao:
    """A robot before a red box, 1 m ahead of its cameras."""
    spec = model_spec(base="fixed", fingers=False)
    spec.worldbody.add_geom(
        name="target", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.01, 0.05, 0.05], pos=[1.0587, 0, 0.69], rgba=[1, 0, 0, 1]
    )
    return Nao(model=spec.compile(), posture="StandZero")


def _red(picture: np.ndarray) -> np.ndarray:
    """Return the pixels (row, column) that are clearly red."""
    r, g, b = (picture[..., k].astype(int) for k in range(3))
    return np.argwhere((r > 90) & (g < r // 2) & (b < r // 2))


def test_pictures_have_the_documented_size(watcher: Nao) -> None:
    for name in ("CameraTop", "CameraBottom"):
        picture = watcher.camera(name)
        assert picture.shape == (480, 640, 3)
        assert picture.dtype == np.uint8
        assert picture.std() > 5


def test_a_box_ahead_is_where_a_pinhole_puts_it(watcher: Nao) -> None:
    watcher.reset("StandZero")
    rows, columns = _red(watcher.camera("CameraTop")).T
    focal = 240 / np.tan(np.radians(47.6 / 2))
    # The front face is 0.99 m ahead, half a metre's tenth wide; the camera is pitched 1.2 degrees down.
    assert columns.max() - columns.min() + 1 == pytest.approx(0.1 * focal / 0.99, abs=3)
    assert columns.mean() == pytest.approx(319.5, abs=1.5)
    assert rows.mean() == pytest.approx(239.5 - focal * np.tan(np.radians(1.2)), abs=3)


def test_turning_the_head_left_moves_the_picture_right(watcher: Nao) -> None:
    watcher.reset("StandZero")
    watcher.set_angles("HeadYaw", 0.2)
    watcher.step(30)
    columns = _red(watcher.camera("CameraTop"))[:, 1]
    focal = 240 / np.tan(np.radians(47.6 / 2))
    assert columns.mean() > 319.5 + 0.9 * focal * np.tan(0.2)


def test_the_lower_camera_looks_at_the_floor(watcher: Nao) -> None:
    watcher.reset("StandZero")
    assert _red(watcher.camera("CameraBottom")).size == 0


def test_other_cameras_sizes_and_quality(watcher: Nao) -> None:
    beside = mujoco.MjvCamera()
    beside.distance, beside.azimuth, beside.elevation = 1.5, 150, -15
    plain = watcher.camera(beside, 160, 120)
    fine = watcher.camera(beside, 160, 120, fine=True)
    assert plain.shape == fine.shape == (120, 160, 3)
    assert (plain != fine).any()


def test_unknown_camera(watcher: Nao) -> None:
    with pytest.raises(UnknownNameError, match="did you mean 'CameraTop'"):
        watcher.camera("CameraTopp")


def test_close_and_look_again(watcher: Nao) -> None:
    first = watcher.camera("CameraTop", 80, 60)
    watcher.close()
    assert (watcher.camera("CameraTop", 80, 60) == first).all()
