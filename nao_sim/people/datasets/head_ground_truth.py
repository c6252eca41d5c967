"""Where the head is in every frame of a clip: the film does not say so, but the same shot can be staged again."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from nao_sim.people.actors.persons import body_scales
from nao_sim.people.arrays import Array
from nao_sim.people.datasets.dataset import Job, tables_digest
from nao_sim.people.datasets.manifest import read_manifest
from nao_sim.people.errors import FilmError
from nao_sim.people.filming.shots import Shot
from nao_sim.people.filming.stage import Stage

# Crown and chin in the frame of the head's body, which begins at the base of the skull (m, for a person of 1.75 m).
_CROWN, _CHIN = np.array([0.02, 0.0, 0.215]), np.array([0.02, 0.0, -0.02])


def head_track(stage: Stage, shot: Shot) -> Array:
    """Centre and height of the head in each frame, (n, 3): x and y from the top left corner, all in image heights.

    The height is that of the head upright: one that is bowed is no smaller one. Nothing is rendered.
    """
    stage.cast(shot.person, shot.outfit)
    stage.aim(shot.camera)
    model, data = stage.model, stage.data
    scale = body_scales(shot.person)["head"]
    middle, height = (_CROWN + _CHIN) / 2 * scale, float(np.linalg.norm((_CROWN - _CHIN) * scale))
    camera, head = model.camera("film").id, data.body("head")
    focal = 0.5 / np.tan(np.radians(model.cam_fovy[camera]) / 2)
    track = []
    for qpos in shot.performance.angles(np.arange(shot.frames) / shot.fps):
        data.qpos[:] = qpos
        mujoco.mj_kinematics(model, data)
        mujoco.mj_camlight(model, data)
        point = head.xpos + head.xmat.reshape(3, 3) @ middle - data.cam_xpos[camera]
        right, up, behind = data.cam_xmat[camera].reshape(3, 3).T @ point
        near = focal / -behind
        track.append((shot.width / shot.height / 2 + near * right, 0.5 - near * up, near * height))
    return np.array(track)


def heads_of_film(folder: Path) -> Iterator[tuple[dict[str, Any], Array]]:
    """Stage the clips of a data set that ``nao-sim film`` made again: each row of its manifest, and its head's track.

    The film must be one of this version's: what is staged is what the same command would film today.

    Raises:
        FilmError: the folder has no card that says how its clips were drawn, or no manifest.
    """
    try:
        command = json.loads((folder / "card.json").read_text(encoding="utf-8"))["command"]
        persons, seed, restless = command["persons"], command["seed"], command["restless"]
        rows = read_manifest(folder)
        former = [row["file"] for row in rows if row.get("tables") != tables_digest()]
        if former:
            raise KeyError(former[0])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise FilmError(f"{folder} has no card.json of a film by this version; film it again") from error
    with Stage() as stage:
        for row in rows:
            job = Job(seed, row["label"], int(row["person"][1:]), persons, row["take"], restless)
            yield row, head_track(stage, job.shot())
