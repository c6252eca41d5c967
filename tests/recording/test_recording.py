"""Recordings are read back and compared with what was put in."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import mujoco
import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rerun.chunk import RrdReader

from nao_sim.gestures.formats import Said, load_motion
from nao_sim.recording.joints import in_display_units, log_balance, log_joints
from nao_sim.recording.layout import layout
from nao_sim.recording.narrative import log_decision, log_phases
from nao_sim.recording.properties import send_properties
from nao_sim.recording.robot import log_body_poses, log_shells
from nao_sim.recording.stream import RecordingError, recording
from nao_sim.recording.video import (
    LONGEST_SIDE_PX,
    log_boxes,
    log_centroid_path,
    log_ellipses,
    log_frames,
    log_picture,
)
from nao_sim.robot import ACTUATED, Nao, joint_table, model_spec

RNG = np.random.default_rng(5)
TIME = np.linspace(0.0, 1.0, 51)


@pytest.fixture(scope="module")
def nao() -> Nao:
    return Nao()


@pytest.fixture(scope="module")
def motion(nao: Nao) -> dict[str, np.ndarray]:
    poses = []
    for _ in TIME:
        nao.step()
        poses.append(np.concatenate([nao.data.xpos, nao.data.xquat], axis=1))
    joints = RNG.uniform(-1, 1, (3, len(TIME), len(ACTUATED)))
    return {"pose": np.array(poses), "targets": joints[0], "angles": joints[1], "torques": joints[2]}


@pytest.fixture(scope="module")
def rrd(nao: Nao, motion: dict[str, np.ndarray], tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "motion.rrd"
    with recording(path, "a motion", "motion-1", layout(ACTUATED, ACTUATED[:4])) as stream:
        log_shells(stream, nao.model)
        log_body_poses(stream, nao.model, TIME, motion["pose"])
        joint_range = joint_table().select(ACTUATED).range_rad(nao.limits)
        log_joints(stream, ACTUATED, joint_range, TIME, motion["targets"], motion["angles"], motion["torques"])
        log_balance(stream, TIME, motion["pose"][:, 1], np.ones((len(TIME), 8)))
        log_phases(stream, [(0.0, "watch"), (0.5, "imitate"), (1.0, "end")])
        log_decision(stream, "watching", 0.5, "**bye_right**")
        log_frames(stream, ((i / 70, np.full((240, 320, 3), i, np.uint8)) for i in range(70)))
    return path


def batches(path: Path, entity: str) -> Iterator[pa.RecordBatch]:
    for chunk in RrdReader(path).stream():
        if chunk.entity_path == entity and not chunk.is_static:
            yield chunk.to_record_batch()


def column(path: Path, entity: str, name: str) -> tuple[np.ndarray, pa.Array]:
    """Times [s] and values of one component, in order of time."""
    found = pa.Table.from_batches(list(batches(path, entity))).sort_by("time")
    return found["time"].cast(pa.int64()).to_numpy() * 1e-9, found[name].combine_chunks()


@pytest.mark.parametrize("joint", ["HeadYaw", "RElbowRoll", "LHand"])
def test_angles_come_back_as_they_went_in(rrd: Path, motion: dict[str, np.ndarray], joint: str) -> None:
    time, values = column(rrd, f"/joints/{joint}/angle", "Scalars:scalars")
    np.testing.assert_allclose(time, TIME, atol=1e-9)
    expected = in_display_units(ACTUATED, motion["angles"])[:, ACTUATED.index(joint)]
    np.testing.assert_allclose(pc.list_flatten(values).to_numpy(), expected, rtol=1e-12)


def test_limits_are_those_of_the_thesis_in_degrees(rrd: Path) -> None:
    for bound, expected in (("min", -39.0), ("max", 30.0)):
        _, values = column(rrd, f"/joints/HeadPitch/{bound}", "Scalars:scalars")
        np.testing.assert_allclose(pc.list_flatten(values).to_numpy(), expected, atol=1e-4)


def test_body_poses_are_world_poses_with_rerun_quaternions(nao: Nao, rrd: Path, motion: dict[str, np.ndarray]) -> None:
    body = nao.model.body("r_hand").id
    _, position = column(rrd, "/world/robot/r_hand", "Transform3D:translation")
    _, quaternion = column(rrd, "/world/robot/r_hand", "Transform3D:quaternion")
    position_m = np.array(pc.list_flatten(position).to_pylist())
    xyzw = np.array(pc.list_flatten(quaternion).to_pylist())
    np.testing.assert_allclose(position_m, motion["pose"][:, body, :3], atol=1e-6)
    np.testing.assert_allclose(xyzw, motion["pose"][:, body][:, [4, 5, 6, 3]], atol=1e-6)


def test_every_body_with_a_visible_shell_is_drawn(nao: Nao, rrd: Path) -> None:
    drawn = {c.entity_path.split("/")[3] for c in RrdReader(rrd).stream() if "/shell_" in c.entity_path}
    assert {"torso", "head", "l_hand", "r_foot"} <= drawn
    assert drawn <= {nao.model.body(i).name for i in range(nao.model.nbody)}


def test_phases_frames_and_decision(rrd: Path) -> None:
    time, states = column(rrd, "/phase", "StateChange:state")
    np.testing.assert_allclose(time, [0, 0.5, 1.0])
    assert pc.list_flatten(states).to_pylist() == ["watch", "imitate", "end"]
    time, _ = column(rrd, "/video/frame", "EncodedImage:blob")
    np.testing.assert_allclose(time, np.arange(70) / 70, atol=1e-8)
    _, text = column(rrd, "/decision", "TextDocument:text")
    assert pc.list_flatten(text).to_pylist()[-1] == "**bye_right**"


def test_it_verifies_and_carries_a_blueprint(rrd: Path) -> None:
    assert len(RrdReader(rrd).blueprints()) == 1
    rerun = [sys.executable, "-m", "rerun", "rrd", "verify", str(rrd)]
    done = subprocess.run(rerun, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_large_frames_are_stored_smaller(tmp_path: Path) -> None:
    import cv2

    path = tmp_path / "large.rrd"
    with recording(path, "large", "large-1", layout(ACTUATED, [])) as stream:
        log_frames(stream, [(0.0, np.zeros((2160, 3840, 3), np.uint8))])
    _, blobs = column(path, "/video/frame", "EncodedImage:blob")
    jpeg = np.array(blobs.to_pylist()[0][0], dtype=np.uint8)
    assert max(cv2.imdecode(jpeg, cv2.IMREAD_COLOR).shape) == LONGEST_SIDE_PX


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full to write to")
def test_a_full_disk_is_one_error_and_leaves_nothing(tmp_path: Path) -> None:
    path = tmp_path / "full.rrd"
    path.symlink_to("/dev/full")
    with (
        pytest.raises(RecordingError, match=r"full\.rrd could not be written"),
        recording(path, "x", "x", layout((), ())) as s,
    ):
        log_frames(s, ((i / 25, np.zeros((100, 100, 3), np.uint8)) for i in range(100)))
    assert list(tmp_path.iterdir()) == []


def test_an_error_while_recording_leaves_nothing(tmp_path: Path) -> None:
    def broken() -> Iterator[tuple[float, np.ndarray]]:
        yield 0.0, np.zeros((10, 10, 3), np.uint8)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), recording(tmp_path / "cut.rrd", "x", "x", layout((), ())) as stream:
        log_frames(stream, broken())
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("count", [1, 40, 400])
def test_a_disk_that_fills_up_ends_in_an_error_and_never_waits(tmp_path: Path, count: int) -> None:
    """However much comes after the disk is full: Rerun's own writer dies then, and what follows waits for it."""
    path = tmp_path / "full.rrd"
    path.symlink_to("/dev/full")
    noise = RNG.integers(0, 255, (60, 80, 3), dtype=np.uint8)
    with (
        pytest.raises(RecordingError, match=r"full\.rrd could not be written \(No space left on device\)"),
        recording(path, "x", "x", layout((), ())) as stream,
    ):
        log_frames(stream, ((n / 25, noise) for n in range(count)))
    assert list(tmp_path.iterdir()) == []


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.sampled_from([10.0, 23.976, 24.0, 25.0, 29.97, 30.0, 59.94, 120.0, 1000.0]), st.integers(0, 4000))
def test_a_picture_and_what_is_drawn_on_it_share_their_nanosecond(tmp_path: Path, fps: float, first: int) -> None:
    path = tmp_path / "together.rrd"
    moments = (first + np.arange(64)) / fps
    with recording(path, "x", "x", layout((), ())) as stream:
        log_frames(stream, ((n / fps, np.zeros((8, 8, 3), np.uint8)) for n in range(first % 7 + 64)))
        begun = np.arange(64) / fps
        log_boxes(stream, begun, [np.zeros((1, 4))] * 64)
        log_centroid_path(stream, begun, np.zeros((64, 2)))
        log_joints(stream, ACTUATED[:1], np.array([[-1.0, 1.0]]), moments, *[np.zeros((64, 1))] * 3)
        for at in moments.tolist():
            log_picture(stream, "evidence/difference", at, np.zeros((4, 4), np.uint8))
            log_ellipses(stream, "evidence/difference", at, np.zeros((1, 2)), np.ones((1, 2)))

    def stamps(entity: str) -> list[int]:
        found = pa.Table.from_batches(list(batches(path, entity))).sort_by("time")
        return found["time"].cast(pa.int64()).to_pylist()

    pictures = stamps("/video/frame")[:64]
    assert pictures == stamps("/video/flow") == stamps("/video/centroid") == np.rint(begun * 1e9).astype(int).tolist()
    joints = stamps("/joints/HeadYaw/angle")
    assert joints == stamps("/evidence/difference/picture") == stamps("/evidence/difference/ellipses")
    assert joints == stamps("/joints/HeadYaw/target")


def test_properties_keep_their_values_and_types_from_run_to_run(tmp_path: Path) -> None:
    """Whole numbers first, fractions later, none in between: in one process each file holds what was sent."""
    runs = [
        {"distance": 1, "gesture": "yes"},
        {"distance": 0.75, "gesture": None},
        {"distance": np.float32(2), "gesture": "7"},
    ]
    for index, values in enumerate(runs):
        path = tmp_path / f"{index}.rrd"
        with recording(path, "x", f"x{index}", layout((), ())) as stream:
            send_properties(stream, "episode", values)
        found = {}
        for chunk in RrdReader(path).stream():
            batch = chunk.to_record_batch()
            for name in batch.schema.names:
                if chunk.entity_path.endswith("/episode") and not name.startswith("rerun"):
                    found[name] = (batch[name].type.value_type, batch[name].to_pylist()[0])
        assert found.pop("distance") == (pa.float64(), [float(values["distance"])])
        if values["gesture"] is None:
            assert found == {}
        else:
            assert found == {"gesture": (pa.string(), [str(values["gesture"])])}


def test_a_scene_s_bodies_may_be_called_anything(tmp_path: Path) -> None:
    spec = model_spec()
    for name in ("a/b", "two words", "", "ünï"):
        body = spec.worldbody.add_body(name=name, pos=[1, 1, 1])
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.1, 0, 0])
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    pose = np.concatenate([data.xpos, data.xquat], axis=1)[None]
    path = tmp_path / "scene.rrd"
    with recording(path, "x", "x", layout((), ())) as stream:
        log_shells(stream, model)
        log_body_poses(stream, model, np.zeros(1), pose)
    posed = {c.entity_path for c in RrdReader(path).stream() if not c.is_static}
    assert len([entity for entity in posed if entity.startswith("/world/robot/")]) == model.nbody - 1


@pytest.mark.parametrize("measured", [False, True])
def test_the_joints_of_a_recording_are_a_motion(rrd: Path, motion: dict[str, np.ndarray], measured: bool) -> None:
    read = load_motion(rrd, Said(measured=measured))
    wanted = motion["angles" if measured else "targets"]
    for column, name in enumerate(ACTUATED):
        assert np.allclose(read.curves[name].times, TIME, atol=1e-9)
        assert np.allclose(read.curves[name].values, wanted[:, column], atol=1e-9)
