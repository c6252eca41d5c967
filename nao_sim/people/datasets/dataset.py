"""Data sets of clips: what is to be filmed, filming it on several processes, and its manifest and card."""

from __future__ import annotations

import functools
import hashlib
import json
import multiprocessing
import os
import platform
import tomllib
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from nao_sim.people.actors.persons import Person
from nao_sim.people.datasets.manifest import read_manifest, replace_file, write_manifest
from nao_sim.people.errors import FilmError
from nao_sim.people.filming.film import one_core, write_clip
from nao_sim.people.filming.photos import DETAIL as PHOTO_DETAIL
from nao_sim.people.filming.photos import Photo, draw_photo, postures, write_photo
from nao_sim.people.filming.shots import Shot, draw_cast, draw_shot
from nao_sim.people.filming.stage import Stage
from nao_sim.people.performance.motions import IRRELEVANT, motions
from nao_sim.resources import resource

CHILDREN = 1 / 3


@dataclass(frozen=True)
class Job:
    """One clip of a data set: enough to draw its shot and to name its file.

    Attributes:
        restless: share of clips in which people cannot keep still; as in the motion file when None.
    """

    seed: int
    label: str
    person: int
    persons: int
    take: int
    restless: float | None = None

    @property
    def file(self) -> str:
        """Path below the data set's folder."""
        return f"{self.label}/p{self.person:03d}_{self.take:02d}.{'jpg' if self.is_photo else 'avi'}"

    @property
    def is_photo(self) -> bool:
        """Whether the label is a static posture."""
        return self.label in postures()

    def shot(self) -> Shot:
        """Draw the shot of a clip."""
        return draw_shot(self.seed, self.label, self._performer(), self.take, restless=self.restless)

    def photo(self) -> Photo:
        """Draw the photo of a static posture."""
        return draw_photo(self.seed, self.label, self._performer(), self.take)

    def _performer(self) -> Person:
        return draw_cast(self.seed, self.persons, CHILDREN)[self.person]


def plan(
    persons: int,
    takes: int,
    seed: int,
    labels: Sequence[str] | None = None,
    irrelevant: int = 0,
    restless: float | None = None,
) -> list[Job]:
    """List the clips of a data set: every person performs every label ``takes`` times, plus irrelevant motions.

    Without ``labels`` these are the dynamic classes; ``restless`` is as in :class:`Job`.

    Raises:
        FilmError: an unknown label, or a number that is not positive.
    """
    dynamic = [label for label in motions() if label != IRRELEVANT]
    known = [*dynamic, *postures()]
    if persons < 1 or takes < 1 or irrelevant < 0:
        raise FilmError("a data set needs at least one person and one take, and no fewer than 0 irrelevant clips")
    if restless is not None and not 0 <= restless <= 1:
        raise FilmError(f"a share of {restless:g} of the clips cannot be restless; give 0 to 1")
    wanted = list(dynamic if labels is None else labels)
    unknown = [label for label in wanted if label not in known]
    if unknown:
        raise FilmError(f"class '{unknown[0]}' cannot be filmed; known: {', '.join(known)}")
    people, turns = range(persons), range(takes)
    jobs = [Job(seed, label, p, persons, take, restless) for p in people for label in wanted for take in turns]
    jobs += [Job(seed, IRRELEVANT, k % persons, persons, k // persons, restless) for k in range(irrelevant)]
    return jobs


def film(jobs: Sequence[Job], out: Path, processes: int, done: Callable[[int], None] = lambda frames: None) -> None:
    """Render the clips that ``out`` does not have yet, then write the manifest and the card.

    Args:
        jobs: from :func:`plan`.
        out: the data set's folder; clips that stand there are kept, so an interrupted film goes on where it was.
        processes: how many render at once.
        done: called with the number of frames of each clip as it is finished.

    Raises:
        FilmError: ``out`` is a file or holds a film of another seed, or a process died.
    """
    if out.exists() and not out.is_dir():
        raise FilmError(f"{out} is a file; give a folder for the data set")
    out.mkdir(parents=True, exist_ok=True)
    _claim(out, {(job.seed, job.restless) for job in jobs})
    for part in out.glob("*/.*.part.*"):
        part.unlink(missing_ok=True)
    todo = [job for job in jobs if not (out / job.file).exists()]
    for job in jobs:
        if (out / job.file).exists():
            done(0)
    if processes == 1:
        try:
            for job in todo:
                done(_film_one(job, out))
        finally:
            _open.close()
    else:
        _film_many(todo, out, processes, done)
    write_manifest(out, [row(job) for job in jobs])


def _claim(out: Path, wanted: set[tuple[int, float | None]]) -> None:
    """Refuse a folder whose clips were drawn otherwise; they would be taken for those of this data set."""
    try:
        rows = read_manifest(out)
    except FilmError:
        return
    if not all(row.get("tables") == tables_digest() for row in rows):
        raise FilmError(f"{out} holds a film by a former version, whose motions differ; choose another folder")
    standing = {(row.get("seed"), row.get("restless")) for row in rows}
    if standing != wanted:
        seed, restless = sorted(standing, key=str)[0]
        drawn = f"seed {seed}" if restless is None else f"seed {seed}, restless {restless:g}"
        raise FilmError(f"{out} holds another data set ({drawn}); choose another folder")


class _OpenStages:
    """The stages of this process, one for each detail that was asked for."""

    def __init__(self) -> None:
        self._stages: dict[float, Stage] = {}

    def at(self, detail: float) -> Stage:
        if detail not in self._stages:
            self._stages[detail] = Stage(detail)
        return self._stages[detail]

    def close(self) -> None:
        while self._stages:
            self._stages.popitem()[1].close()


_open = _OpenStages()


def _film_one(job: Job, out: Path) -> int:
    """Render one clip or photo; returns its number of frames."""
    with one_core():
        if job.is_photo:
            write_photo(_open.at(PHOTO_DETAIL), job.photo(), out / job.file)
            return 1
        shot = job.shot()
        write_clip(_open.at(shot.detail), shot, out / job.file)
        return shot.frames


def _film_many(jobs: Sequence[Job], out: Path, processes: int, done: Callable[[int], None]) -> None:
    # An OpenGL context does not survive a fork.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(processes, mp_context=context) as pool:
        try:
            for future in as_completed([pool.submit(_film_one, job, out) for job in jobs]):
                done(future.result())
        except BrokenProcessPool as error:
            raise FilmError(
                "a filming process died, perhaps of too little memory; run the same command again"
            ) from error
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def row(job: Job) -> dict[str, Any]:
    """The manifest row of a clip; everything in it follows from the job, so it need not be stored while filming."""
    made = photo_row(job.file, job.photo()) if job.is_photo else shot_row(job.file, job.shot())
    return made | {"seed": job.seed, "restless": job.restless, "tables": tables_digest()}


@functools.cache
def tables_digest() -> str:
    """Twelve digits that change with what the tables of ``assets/people`` say, from which all clips are drawn."""
    tables = [path for path in sorted(resource("assets", "people").glob("*.toml")) if path.stem != "samples"]
    said = [tomllib.loads(path.read_text(encoding="utf-8")) for path in tables]
    return hashlib.sha256(json.dumps(said, sort_keys=True).encode()).hexdigest()[:12]


def photo_row(file: str, photo: Photo) -> dict[str, Any]:
    """The manifest row of ``photo`` stored at ``file``: a clip of one frame."""
    return {
        "file": file,
        "label": photo.label,
        "person": photo.person.name,
        "take": photo.take,
        "action": photo.label,
        "fps": 0.0,
        "frames": 1,
        "width": photo.width,
        "height": photo.height,
        "start": 0,
        "end": 0,
        "child": photo.person.is_child,
        "stature": round(photo.person.stature, 3),
        "framing": "hand" if photo.close else "person",
        "sleeves": photo.outfit.sleeves,
        "tempo": 0.0,
        "size": 0.0,
        "cycles": 0,
        "underway": False,
    }


def shot_row(file: str, shot: Shot) -> dict[str, Any]:
    """The manifest row of ``shot`` stored at ``file``."""
    person, performance = shot.person, shot.performance
    return {
        "file": file,
        "label": shot.label,
        "person": person.name,
        "take": shot.take,
        "action": performance.action,
        "fps": shot.fps,
        "frames": shot.frames,
        "width": shot.width,
        "height": shot.height,
        "start": 0,
        "end": shot.frames - 1,
        "child": person.is_child,
        "stature": round(person.stature, 3),
        "framing": shot.framing,
        "sleeves": shot.outfit.sleeves,
        "tempo": round(performance.tempo, 3),
        "size": round(performance.size, 3),
        "cycles": performance.cycles,
        "underway": performance.underway,
    }


def write_card(out: Path, command: dict[str, Any], jobs: Sequence[Job]) -> None:
    """Write ``card.json``: what is in the data set and how it was made."""
    labels = [job.label for job in jobs]
    card = {
        "made_by": "nao-sim film",
        "command": command,
        "clips": {label: labels.count(label) for label in dict.fromkeys(labels)},
        "persons": len({job.person for job in jobs}),
        "versions": {name: version(name) for name in ("nao-sim", "mujoco", "numpy", "opencv-python-headless")},
        "python": platform.python_version(),
        "renderer": os.environ.get("MUJOCO_GL", "default"),
        "left_right": "the performer's own; the camera faces the performer and is not mirrored",
    }
    replace_file(out / "card.json", lambda part: part.write_text(json.dumps(card, indent=2) + "\n", encoding="utf-8"))
