"""What the robot sees."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from nao_sim.robot import Nao, RobotError, UnknownNameError, Video, model_spec
from nao_sim.robot.view import View, view_of

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


def test_the_quick_picture_shows_what_the_fine_one_shows(watcher: Nao) -> None:
    """Shadows, smoothing and the sky's shades apart: floor, horizon, box and arms are where they are."""
    watcher.reset("StandZero")
    watcher.set_angles("LArm", [-0.2, 0.0, -1.2, -0.6, 0.0, 1.0])
    watcher.step(60)
    plain, fine = (watcher.camera("CameraTop", fine=fine).astype(int) for fine in (False, True))
    assert np.median(np.abs(plain - fine)) < 20
    assert (np.abs(plain - fine).max(axis=2) > 60).mean() < 0.03
    # Light above the horizon, darker below.
    assert plain[20, 320].min() > 200
    assert plain[300, 320].max() < 200
    assert len(_red(plain.astype(np.uint8))) == pytest.approx(len(_red(fine.astype(np.uint8))), rel=0.05)


def test_leaving_out_what_cannot_be_seen_changes_no_pixel(watcher: Nao, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(5)
    groups = watcher.model.geom_group.copy()
    views = []
    for _ in range(4):
        watcher.reset("StandZero")
        watcher.set_angles("Arms", rng.uniform(0, 0.9, 12) * [-1, 1, -1, -1, 1, 1, -1, -1, 1, 1, 1, 1])
        watcher.set_angles("Head", rng.uniform(-0.4, 0.4, 2))
        watcher.step(50)
        quick = watcher.camera("CameraTop"), watcher.camera("CameraBottom")
        with monkeypatch.context() as patch:
            patch.setattr(View, "sees", lambda self, centres, radii: np.ones(len(radii), dtype=bool))
            whole = watcher.camera("CameraTop"), watcher.camera("CameraBottom")
        assert all((a == b).all() for a, b in zip(quick, whole, strict=True))
        views.append(quick[0])
    assert (views[0] != views[1]).any()
    assert (watcher.model.geom_group == groups).all()


def test_a_view_sees_spheres_that_reach_into_it(watcher: Nao) -> None:
    watcher.reset("StandZero")
    scene = mujoco.MjvScene(watcher.model, maxgeom=10)
    camera = mujoco.MjvCamera()
    camera.type, camera.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, watcher.model.camera("CameraTop").id
    mujoco.mjv_updateCamera(watcher.model, watcher.data, camera, scene)
    view = view_of(scene, 4 / 3)
    assert view.slopes[1] == pytest.approx(np.tan(np.radians(47.6 / 2)), rel=1e-5)
    assert view.position == pytest.approx(watcher.data.camera("CameraTop").xpos, abs=1e-6)
    right, up, back = view.axes.T
    edge = view.position - 2 * back + 2 * view.slopes[0] * right
    lean = np.hypot(1, view.slopes[0])
    centres = np.array([view.position + back, edge + 0.1 * lean * right, edge + 0.1 * lean * right, edge + 9 * up])
    assert view.sees(centres, np.array([0.9, 0.09, 0.11, 0.0])).tolist() == [False, False, True, True]


def test_a_video_has_thirty_pictures_a_second_and_starts_anew_after_a_reset(watcher: Nao) -> None:
    watcher.reset("StandZero")
    video = watcher.video("CameraTop", 64, 48)
    assert isinstance(video, Video)
    first = video.read()
    assert first is not None
    assert first.shape == (48, 64, 3)
    assert video.read() is None
    times = []
    for _ in range(100):
        watcher.step()
        if video.read() is not None:
            times.append(video.time)
    # Two seconds; a picture comes with the control period in which it falls due.
    assert times == pytest.approx([np.ceil(k / 30 / 0.02 - 1e-6) * 0.02 for k in range(1, 61)])
    watcher.reset("StandZero")
    assert (video.read() == first).all()
    watcher.reset("Sit")
    assert video.read() is not None
    assert video.time == 0


def test_a_video_slower_than_documented_and_never_faster(watcher: Nao) -> None:
    watcher.reset("StandZero")
    video = watcher.video("CameraBottom", 32, 24, rate_hz=5)
    taken = 0
    for _ in range(50):
        watcher.step()
        taken += video.read() is not None
    assert taken == 6
    assert video.image is not None
    for rate in (0, -1, 31, float("nan")):
        with pytest.raises(RobotError, match="at most 30"):
            watcher.video(rate_hz=rate)
    with pytest.raises(UnknownNameError, match="did you mean 'CameraTop'"):
        watcher.video("CameraTopp")
