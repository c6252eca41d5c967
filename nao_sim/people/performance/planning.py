"""One try at a motion: its steps drawn and laid out as strokes in time, before the length of the clip is known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from nao_sim.people.actors.persons import Person
from nao_sim.people.arrays import Array
from nao_sim.people.performance.gait import Walk
from nao_sim.people.performance.motions import Motion, drawn_offsets, joints, of_a_finger, of_a_limb, pose
from nao_sim.people.performance.standing import standing
from nao_sim.people.performance.strokes import Stroke

TEMPO = (0.6, 1.6)
SIZE = (0.7, 1.3)
# Standard deviation of each posed angle from clip to clip.
_JITTER_DEG = 3.5
# No stroke of an arm or a head turns round faster than this: four waves a second.
_SHORTEST_SECONDS = 0.12


class Plan:
    """The strokes of one try.

    Attributes:
        tempo, size: factors drawn for this try.
        base: angles (nq,) of the person standing at rest, rad.
        cycles: how many times round a cycle goes.
        now: how long the try takes, s.
        walk: a walk, or None.

    Args:
        underway: seconds in which nothing but the motion's repeated step is to be seen; None for the whole motion.
    """

    def __init__(
        self, motion: Motion, person: Person, rng: Generator, half_width: float, underway: float | None = None
    ) -> None:
        self.motion, self.person, self.rng = motion, person, rng
        self.tempo = float(np.exp(rng.uniform(*np.log(TEMPO))))
        self.size = float(np.exp(rng.uniform(*np.log(SIZE))))
        self.mirrored = motion.mirrored or (motion.either_side and bool(rng.random() < 0.5))
        self.jitter = rng.normal(0, np.radians(_JITTER_DEG), len(joints()))
        self.shift = drawn_offsets(motion.vary, self.mirrored, rng)
        self.base = standing(person, rng)
        self.cycles, self.now = 0, 0.0
        self.walk: Walk | None = None
        self.strokes: list[Stroke] = []
        self.at = self._pose(motion.start)
        if underway is not None:
            self._repeat(underway)
            return
        for k, step in enumerate(motion.steps):
            self._step(step, first=k == 0, half_width=half_width)

    def _repeat(self, seconds: float) -> None:
        """The repeated step alone, from the pose before it, as often as ``seconds`` need."""
        k = self.motion.repeated
        assert k is not None
        if k and "to" in self.motion.steps[k - 1]:
            self.at = self._pose(self.motion.steps[k - 1]["to"])
        while self.now < seconds + 0.5:
            self._step(self.motion.steps[k], first=False, half_width=0.0)

    def placed(self, lead: float, seconds: float) -> tuple[Stroke, ...]:
        """The strokes, beginning ``lead`` seconds after a clip of ``seconds`` does."""
        if not self.strokes:
            return (Stroke(0.0, seconds, np.array([self.at, self.at])),)
        return tuple(Stroke(stroke.start + lead, stroke.seconds, stroke.knots) for stroke in self.strokes)

    def _pose(self, names: Sequence[str]) -> Array:
        """One of the named poses, sized and with this performance's own deviation."""
        name = names[int(self.rng.integers(len(names)))]
        if name == "rest":
            return np.zeros(len(joints()))
        target = pose(name, self.mirrored)
        size = np.where(of_a_finger(), 1.0, 1 + (self.size - 1) * self.motion.reach)
        return target.angles * size + self._own(target.named)

    def _own(self, named: NDArray[np.bool_]) -> Array:
        """What this performance adds to the angles of the ``named`` joints; limbs leave how they hung at rest."""
        return self.shift + self.jitter * named - self.base * (named & of_a_limb())

    def _step(self, step: Mapping[str, Any], first: bool, half_width: float) -> None:
        skipped = self.rng.random() < step.get("skip", 0.0)
        if "walk" in step or "approach" in step:
            self.walk = Walk.draw(step, half_width, self.person.stature, self.tempo, self.rng)
            self.now = self.walk.seconds
        elif "hold" in step:
            self.now += self.rng.uniform(*step["hold"])
        elif "cycle" in step:
            poses = [pose(name, self.mirrored) for name in step["cycle"]]
            named = np.any([turn.named for turn in poses], axis=0)
            self._cycle([turn.angles for turn in poses], self._own(named), step)
        elif "about" in step:
            middle = pose(step["about"], self.mirrored)
            swing = drawn_offsets(step["swing"], self.mirrored, self.rng)
            self._cycle([middle.angles + swing, middle.angles - swing], self._own(middle.named), step)
        elif "wander" in step:
            self._wander(step)
        elif skipped and first:
            self.at = self._pose(step["to"])
        elif not skipped:
            way = [self._pose([name]) for name in step.get("through", ())]
            self._stroke([*way, self._pose(step["to"])], self._seconds(step))

    def _cycle(self, turns: Sequence[Array], offset: Array, step: Mapping[str, Any]) -> None:
        """Strokes to the ``turns`` in turn, which are sized about their middle and die down a little."""
        middle = np.mean(turns, axis=0)
        cycles = int(self.rng.integers(step["count"][0], step["count"][1] + 1))
        self.cycles += cycles
        seconds, decay = self._seconds(step), self.rng.uniform(0.88, 1.02)
        for cycle in range(cycles):
            fade = self.rng.uniform(0.85, 1.1) * decay**cycle
            for turn in turns:
                target = middle + (turn - middle) * self.size * fade + offset
                self._stroke([target], seconds * self.rng.uniform(0.92, 1.1), hesitates=False)

    def _wander(self, step: Mapping[str, Any]) -> None:
        """Strokes to ``count`` poses drawn from the ranges of ``wander``: an arm that means nothing."""
        said = drawn_offsets(dict.fromkeys(step["wander"], (1.0, 1.0)), self.mirrored, self.rng) != 0
        for _ in range(int(self.rng.integers(step["count"][0], step["count"][1] + 1))):
            target = drawn_offsets(step["wander"], self.mirrored, self.rng) + self._own(said)
            self._stroke([target], self._seconds(step))

    def _seconds(self, step: Mapping[str, Any]) -> float:
        """Duration of a stroke at tempo 1: as written, or drawn between two."""
        written = step["time"]
        return float(self.rng.uniform(*written)) if isinstance(written, list) else float(written)

    def _stroke(self, targets: Sequence[Array], seconds: float, hesitates: bool = True) -> None:
        """A stroke by way of all but the last of ``targets`` to the last."""
        if hesitates and self.rng.random() < 0.15:
            self.now += self.rng.uniform(0.1, 0.4)
        seconds = max(seconds / self.tempo, _SHORTEST_SECONDS)
        self.strokes.append(Stroke(self.now, seconds, np.array([self.at, *targets])))
        self.now += seconds
        self.at = targets[-1]
