"""A simulated person who plays: somebody of ``models/person`` in one room, before a camera that stands still."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from nao_sim.game.session.sources import Actor
from nao_sim.gestures import library
from nao_sim.people.filming.film import one_core, roll
from nao_sim.people.filming.shots import COARSE, Shot, draw_cast, draw_shot
from nao_sim.people.filming.stage import Stage
from nao_sim.people.performance.motions import IRRELEVANT, motions
from nao_sim.people.performance.perform import perform

WIDTH, HEIGHT, FPS = 320, 240, 10.0
_CAST = 6
_SCENE = "right_arm_up"
# What somebody does who does something else: motions that are no gesture, shown by the whole person on the spot.
_UNRELATED = ("scratch_head", "fold_arms", "touch_face", "clap", "hands_on_hips", "look_at_watch", "phone")
_STILL = "stand"


@dataclass(frozen=True)
class Deed:
    """What an actor does: a label of the films, an action of it, and what that is in words."""

    label: str
    action: str | None = None


class ActorPlayer:
    """Draws and films what one actor does; everything follows from seed, turn and attempt.

    Args:
        actor: as the session file has it.
        place: place in the circle, so that two actors of one seed differ.
    """

    def __init__(self, actor: Actor, place: int) -> None:
        self.actor, self._place = actor, place

    @cached_property
    def scene(self) -> Shot:
        """The person, their clothes, the room, the camera and the light: the same in all turns."""
        cast = draw_cast(self.actor.seed, _CAST)
        person = next(p for p in cast[self._place % _CAST :] + cast if p.is_child == self.actor.child)
        for take in range(400):
            shot = draw_shot(self.actor.seed, _SCENE, person, take, restless=0.0, underway=0.0)
            shot = replace(shot, width=WIDTH, height=HEIGHT, fps=FPS)
            if _whole_person(shot):
                break
        # A camera on a stand under steady light.
        steady = replace(shot.sensor, drift=np.zeros((0, 3)), flicker=(0.0, 1.0))
        return replace(shot, sensor=steady)

    def answer(self, turn: int, attempt: int, asked: str) -> Deed:
        """Draw whether the actor does what is asked at this attempt, and what else they do if not."""
        rng = self._rng(turn, attempt, 0)
        follows, other, mirrors = rng.random(3)
        if follows < (self.actor.helped if attempt else self.actor.follows):
            twin = library()[asked].mirror if asked in library() else asked
            return filmed(twin if mirrors < self.actor.mirrors else asked)
        if other < self.actor.unrelated:
            return Deed(IRRELEVANT, str(rng.choice(_UNRELATED)))
        return Deed(IRRELEVANT, _STILL)

    def film(
        self, stage: Stage, deed: Deed, turn: int, attempt: int, answering: bool
    ) -> Iterator[tuple[float, np.ndarray]]:
        """Yield time [s] and BGR frame, (240, 320, 3) uint8, of one performance, 10 a second."""
        rng = self._rng(turn, attempt, 1 + answering)
        acted = perform(deed.label, self.scene.person, rng, 1.0, deed.action, restless=0.0, underway=0.0)
        with one_core():
            shot = replace(self.scene, performance=acted, label=deed.label)
            yield from ((number / FPS, frame) for number, frame in enumerate(roll(stage, shot)))

    def _rng(self, *use: int) -> np.random.Generator:
        return np.random.default_rng([self.actor.seed, self._place, *use])


def new_stage() -> Stage:
    """Return a stage that any actor can be filmed on."""
    return Stage(COARSE)


def filmed(gesture: str) -> Deed:
    """Return how a gesture is filmed: some of the other side of the body are no class of their own."""
    if gesture in motions():
        return Deed(gesture)
    return Deed(IRRELEVANT, gesture)


def _whole_person(shot: Shot) -> bool:
    """Whether raised and outstretched hands stay in the picture, and the person fills half of its height."""
    tall = shot.person.stature
    reach = np.array([[0, 0, 1.28], [0, 0.56, 0.85], [0, -0.56, 0.85], [0.3, 0, 0.4]]) * tall
    at = np.abs(shot.camera.project(reach))
    top, foot = shot.camera.project(np.array([[0.0, 0.0, tall], [0.0, 0.0, 0.0]]))
    return bool((at <= (shot.width / shot.height, 1.0)).all() and top[1] - foot[1] > 1.0)
