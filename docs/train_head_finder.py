"""Learn the head-and-shoulders templates anew: ``MUJOCO_GL=egl python docs/train_head_finder.py SET [SET …]``.

Each SET is a folder that ``nao-sim film`` made. The clips do not say where the head is, but the same seed stages the
same shot, and there the head can be projected. The shipped templates were learned with ``--persons 40 --every 1`` on
``nao-sim film --out SET --persons 40 --takes 2 --irrelevant 400 --seed 7``, 1,439 clips (who walks is left out); these
persons take no part in the database or in its figures.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import mujoco
import numpy as np
import pyarrow.parquet as pq

from nao_sim.people.dataset import Job
from nao_sim.people.persons import body_scales
from nao_sim.people.stage import Stage
from recognizer.finder_training import KnownHead, train

# Crown and chin in the frame of the head's body, which begins at the base of the skull (m, for a person of 1.75 m).
CROWN, CHIN = np.array([0.02, 0.0, 0.215]), np.array([0.02, 0.0, -0.02])


def known_heads(stage: Stage, folder: Path, persons: int) -> list[KnownHead]:
    """Stage every clip of the first persons again and project crown and chin of its first frame."""
    command = json.loads((folder / "card.json").read_text(encoding="utf-8"))["command"]
    heads = []
    for row in pq.read_table(folder / "manifest.parquet").to_pylist():
        person = int(row["person"][1:])
        if person >= persons or row["label"].startswith("walk"):
            continue  # who walks may not be in view yet
        shot = Job(command["seed"], row["label"], person, command["persons"], row["take"]).shot()
        stage.cast(shot.person, shot.outfit)
        stage.aim(shot.camera)
        stage.data.qpos[:] = shot.performance.angles(np.zeros(1))[0]
        mujoco.mj_kinematics(stage.model, stage.data)
        mujoco.mj_camlight(stage.model, stage.data)
        aspect = shot.width / shot.height
        scale = body_scales(shot.person)["head"]
        crown, chin = (project(stage, point * scale, aspect) for point in (CROWN, CHIN))
        middle, tall = (crown + chin) / 2, float(np.linalg.norm(crown - chin))
        if 0 < middle[0] < aspect and 0 < middle[1] < 1:
            heads.append(KnownHead(folder / row["file"], f"{folder}/{row['person']}", *middle.tolist(), tall))
    return heads


def project(stage: Stage, point: np.ndarray, aspect: float) -> np.ndarray:
    """Image place of a point in the head's frame: x and y in image heights from the top left corner."""
    model, data = stage.model, stage.data
    camera, head = model.camera("film").id, data.body("head")
    seen = data.cam_xmat[camera].reshape(3, 3).T @ (head.xpos + head.xmat.reshape(3, 3) @ point - data.cam_xpos[camera])
    focal = 0.5 / np.tan(np.radians(model.cam_fovy[camera]) / 2)
    return np.array([aspect / 2 + focal * seen[0] / -seen[2], 0.5 - focal * seen[1] / -seen[2]])


def main() -> None:
    """Stage the sets again and train."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sets", nargs="+", type=Path)
    parser.add_argument("--persons", type=int, default=12, help="use the first so many of each set")
    parser.add_argument("--every", type=int, default=2, help="use one clip of so many")
    parser.add_argument("--out", type=Path, default=Path("recognizer/head_shoulders.npz"))
    asked = parser.parse_args()
    with Stage() as stage:
        heads = [head for folder in asked.sets for head in known_heads(stage, folder, asked.persons)[:: asked.every]]
    print(f"{len(heads)} clips with known heads")
    train(heads, asked.out)


if __name__ == "__main__":
    main()
