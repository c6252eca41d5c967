"""A motion as one person performs it once: minimum-jerk strokes at an own tempo and size, and a body that joins in.

Strokes follow the minimum-jerk course of Flash & Hogan, *The coordination of arm movements*, J. Neurosci. 5 (1985),
eq. 5: position 10 s³ - 15 s⁴ + 6 s⁵ of the way at the share s of the time.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from nao_sim.people.gait import Walk, walk_angles
from nao_sim.people.motions import SLIDES, Motion, joint_ranges, joints, motions, pose, tables
from nao_sim.people.persons import FINGERS, Person
from nao_sim.people.standing import standing, sway_of_clip
from nao_sim.people.surface import Array

TEMPO = (0.6, 1.6)
SIZE = (0.7, 1.3)
CLIP_SECONDS = (1.6, 6.5)
# Standard deviation of each posed angle from clip to clip.
_JITTER_DEG = 3.5
# Distal joints trail the shoulder by up to this long.
_LAG_SECONDS = {"elbow": 0.03, "pronate": 0.05, "wrist_flex": 0.06, "wrist_deviate": 0.06, "head_roll": 0.08}


@dataclass(frozen=True)
class Stroke:
    """A minimum-jerk course through ``knots`` (k, nq) from ``start`` for ``seconds``."""

    start: float
    seconds: float
    knots: Array


@dataclass(frozen=True)
class Performance:
    """One performance, ready to be sampled.

    Attributes:
        label, action: what is performed.
        seconds: length of the clip.
        tempo, size, cycles: as drawn.
        strokes: in time order.
        base: angles (nq,) of this person standing at rest, rad and m.
        sway: joint index -> rows (amplitude, frequency in Hz, phase).
        walk: a crossing, or None.
        lively: factor on what the rest of the body does.
    """

    label: str
    action: str
    seconds: float
    tempo: float
    size: float
    cycles: int
    strokes: tuple[Stroke, ...]
    base: Array
    sway: Mapping[int, Array]
    walk: Walk | None
    lively: float
    stature: float

    def angles(self, times: Array) -> Array:
        """Joint angles (n, nq) at ``times`` (n,) in s; hinges in rad, slides in m."""
        out = np.tile(self.base, (len(times), 1))
        gesture = self._gesture(times)
        self._follow(gesture)
        out += gesture
        for joint, rows in self.sway.items():
            waves = rows[:, 0] * np.sin(2 * np.pi * rows[:, 1] * times[:, None] + rows[:, 2])
            out[:, joint] += waves.sum(axis=1) * self.lively
        if self.walk is not None:
            walk_angles(self.walk, times, out)
        index = joints()
        # The legs stay planted when the pelvis tips or leans.
        for side, lean in (("r_", 1.0), ("l_", -1.0)):
            out[:, index[f"{side}hip_flex"]] += out[:, index["root_pitch"]]
            out[:, index[f"{side}hip_abduct"]] -= lean * out[:, index["root_roll"]]
        for slide in SLIDES:
            out[:, index[slide]] *= self.stature
        low, high = joint_ranges()
        return np.clip(out, low, high)

    def _gesture(self, times: Array) -> Array:
        """Angles (n, nq) of the strokes alone, each joint with its own lag."""
        out = np.zeros((len(times), len(self.base)))
        groups: dict[float, list[int]] = {}
        for name, k in joints().items():
            stem = name[2:] if name[:2] in ("r_", "l_") else name
            groups.setdefault(_LAG_SECONDS.get(stem, 0.0), []).append(k)
        for lag, members in groups.items():
            out[:, members] = self._course(times - lag)[:, members]
        return out

    def _course(self, times: Array) -> Array:
        first = self.strokes[0].knots[0]
        out = np.tile(first, (len(times), 1))
        for stroke in self.strokes:
            now = times >= stroke.start
            share = np.clip((times[now] - stroke.start) / stroke.seconds, 0.0, 1.0)
            out[now] = _along(stroke.knots, minimum_jerk(share))
        return out

    def _follow(self, gesture: Array) -> None:
        """Let trunk and head answer a raised arm, in place."""
        index = joints()
        for side, sign in (("r_", 1.0), ("l_", -1.0)):
            abduct, flex = gesture[:, index[f"{side}shoulder_abduct"]], gesture[:, index[f"{side}shoulder_flex"]]
            lift = (1 - np.cos(abduct) * np.cos(flex)) / 2
            for name, value in tables()["follow"].items():
                amount = value if name.startswith("root_y") else np.radians(value)
                gesture[:, index[name]] += sign * amount * lift * self.lively


def minimum_jerk(share: Array) -> Array:
    """Share of the way covered at a share of the time, both in [0, 1]."""
    return share**3 * (10 - 15 * share + 6 * share**2)


def _along(knots: Array, way: Array) -> Array:
    """Angles (n, nq) at the shares ``way`` (n,) of the course through ``knots``."""
    if len(knots) == 2:
        return knots[0] + way[:, None] * (knots[1] - knots[0])
    return PchipInterpolator(np.linspace(0, 1, len(knots)), knots, axis=0)(way)


def perform(label: str, person: Person, rng: Generator, half_width: float, action: str | None = None) -> Performance:
    """Draw a performance of ``label``.

    Clip lengths come from one distribution for all labels: the gesture is drawn again until it fits, and what is left
    is spent standing before and after it, so that the length of a clip does not tell the gesture.

    Args:
        label: a dynamic vocabulary name, or ``irrelevant``.
        person: who performs.
        rng: source of everything that varies.
        half_width: half of the width (m) the camera sees at the person, for those who cross it.
        action: one irrelevant motion by name; by weight when None.
    """
    ways = [m for m in motions()[label] if action in (None, m.action)]
    weight = np.array([m.weight for m in ways])
    motion = ways[int(rng.choice(len(ways), p=weight / weight.sum()))]
    wanted = float(np.clip(rng.lognormal(np.log(3.1), 0.3), *CLIP_SECONDS))
    for _ in range(16):
        plan = _Plan(motion, person, rng, half_width)
        if plan.now <= wanted - 0.2:
            break
    return plan.finish(max(wanted, plan.now + 0.25), rng)


class _Plan:
    """The strokes of one try, before the clip's length is fixed."""

    def __init__(self, motion: Motion, person: Person, rng: Generator, half_width: float) -> None:
        self.motion, self.person, self.rng = motion, person, rng
        self.tempo = float(np.exp(rng.uniform(*np.log(TEMPO))))
        self.size = float(np.exp(rng.uniform(*np.log(SIZE))))
        self.mirrored = motion.mirrored or (motion.either_side and bool(rng.random() < 0.5))
        self.jitter = rng.normal(0, np.radians(_JITTER_DEG), len(joints()))
        self.base = standing(person, rng)
        self.cycles, self.now = 0, 0.0
        self.walk: Walk | None = None
        self.strokes: list[Stroke] = []
        self.at = self._pose(motion.start)
        for k, step in enumerate(motion.steps):
            self._step(step, first=k == 0, half_width=half_width)

    def _pose(self, names: Any) -> Array:
        """One of the named poses, sized and with this performance's own deviation."""
        name = names[int(self.rng.integers(len(names)))]
        if name == "rest":
            return np.zeros(len(joints()))
        target = pose(name, self.mirrored)
        size = np.where(of_a_finger(), 1.0, 1 + (self.size - 1) * self.motion.reach)
        return target.angles * size + self._own(target.named)

    def _own(self, named: NDArray[np.bool_]) -> Array:
        """What this performance adds to the angles of the ``named`` joints; limbs leave how they hung at rest."""
        return self.jitter * named - self.base * (named & _of_a_limb())

    def _step(self, step: Mapping[str, Any], first: bool, half_width: float) -> None:
        skipped = self.rng.random() < step.get("skip", 0.0)
        if "walk" in step:
            self.walk = Walk.draw(step["walk"], half_width, self.person.stature, self.tempo, self.rng)
            self.now = self.walk.seconds
        elif "hold" in step:
            self.now += self.rng.uniform(*step["hold"])
        elif "cycle" in step:
            self._cycle(step)
        elif skipped and first:
            self.at = self._pose(step["to"])
        elif not skipped:
            knots = [self.at] + [self._pose([n]) for n in step["through"]] if "through" in step else None
            self._stroke(np.array(knots) if knots else np.array([self.at, self._pose(step["to"])]), step["time"])

    def _cycle(self, step: Mapping[str, Any]) -> None:
        poses = [pose(name, self.mirrored) for name in step["cycle"]]
        turns = [turn.angles for turn in poses]
        middle = np.mean(turns, axis=0)
        offset = self._own(np.any([turn.named for turn in poses], axis=0))
        self.cycles = int(self.rng.integers(step["count"][0], step["count"][1] + 1))
        for _ in range(self.cycles):
            fade = self.rng.uniform(0.85, 1.1)
            for turn in turns:
                target = middle + (turn - middle) * self.size * fade + offset
                self._stroke(np.array([self.at, target]), step["time"] * self.rng.uniform(0.92, 1.1), hesitates=False)

    def _stroke(self, knots: Array, seconds: float, hesitates: bool = True) -> None:
        if hesitates and self.rng.random() < 0.15:
            self.now += self.rng.uniform(0.1, 0.4)
        seconds = seconds / self.tempo
        self.strokes.append(Stroke(self.now, seconds, knots))
        self.now += seconds
        self.at = knots[-1]

    def finish(self, seconds: float, rng: Generator) -> Performance:
        """Place the strokes inside a clip of ``seconds``."""
        lead = (seconds - self.now) * rng.uniform(0.1, 0.9)
        strokes = [Stroke(s.start + lead, s.seconds, s.knots) for s in self.strokes]
        strokes = strokes or [Stroke(0.0, seconds, np.array([self.at, self.at]))]
        return Performance(
            label=self.motion.label,
            action=self.motion.action,
            seconds=seconds,
            tempo=self.tempo,
            size=self.size,
            cycles=self.cycles,
            strokes=tuple(strokes),
            base=self.base,
            sway=sway_of_clip(rng),
            walk=None if self.walk is None else self.walk.delayed(lead),
            lively=self.person.liveliness,
            stature=self.person.stature,
        )


@lru_cache
def of_a_finger() -> NDArray[np.bool_]:
    """Joints (nq,) of fingers and thumbs: a hand's posture is not made larger."""
    return np.array([any(finger in name for finger in ("thumb", *FINGERS)) for name in joints()])


@lru_cache
def _of_a_limb() -> NDArray[np.bool_]:
    """Joints (nq,) of arms and legs: a pose names their angle, while trunk and head move from where they are."""
    return np.array([name[:2] in ("r_", "l_") for name in joints()])
