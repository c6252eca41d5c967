"""A motion as one person performs it once: strokes at an own tempo and size, and a body that joins in."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from nao_sim.people.actors.persons import Person
from nao_sim.people.arrays import Array
from nao_sim.people.performance.gait import Walk, walk_angles
from nao_sim.people.performance.motions import SLIDES, joint_ranges, joints, motions, tables
from nao_sim.people.performance.planning import Plan
from nao_sim.people.performance.standing import sway_of_clip
from nao_sim.people.performance.strokes import Stroke, course

CLIP_SECONDS = (1.6, 6.5)
# Share of a clip that a gesture fills at least, where it can: people who are filmed for it begin at once.
_FILLED = 0.5
# From hip joint to ankle, statures, as in models/person.
_LEG = 0.49
# Distal joints trail the shoulder by up to this long.
_LAG_SECONDS = {"elbow": 0.03, "pronate": 0.05, "wrist_flex": 0.06, "wrist_deviate": 0.06, "head_roll": 0.08}


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
        underway: the clip begins and ends amid a repeated motion.
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
    underway: bool
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
        index = joints()
        # The feet stay where they are when the pelvis tips, leans or moves aside.
        for side, lean in (("r_", 1.0), ("l_", -1.0)):
            out[:, index[f"{side}hip_flex"]] += out[:, index["root_pitch"]]
            out[:, index[f"{side}hip_abduct"]] += lean * (out[:, index["root_y"]] / _LEG + out[:, index["root_roll"]])
        if self.walk is not None:
            walk_angles(self.walk, times, out)
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
            out[:, members] = course(self.strokes, times - lag)[:, members]
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


def perform(
    label: str,
    person: Person,
    rng: Generator,
    half_width: float,
    action: str | None = None,
    restless: float | None = None,
    underway: float | None = None,
) -> Performance:
    """Draw a performance of ``label``.

    Clip lengths come from one distribution for all labels: the gesture is drawn again until it fits, and what is left
    is spent standing before and after it, so that the length of a clip does not tell the gesture.

    Args:
        label: a dynamic vocabulary name, or ``irrelevant``.
        person: who performs.
        rng: source of everything that varies.
        half_width: half of the width (m) the camera sees at the person, for those who cross it.
        action: one irrelevant motion by name; by weight when None.
        restless: share of performances by people who cannot keep still; as in the motion file when None.
        underway: share of performances of a repeated motion that begin and end amid it; as in the file when None.
    """
    ways = [m for m in motions()[label] if action in (None, m.action)]
    weight = np.array([m.weight for m in ways])
    motion = ways[int(rng.choice(len(ways), p=weight / weight.sum()))]
    wanted = float(np.clip(rng.lognormal(np.log(2.9), 0.32), *CLIP_SECONDS))
    plan = _fitting(wanted, lambda: Plan(motion, person, rng, half_width))
    seconds = max(wanted, plan.now + 0.25)
    lead = (seconds - plan.now) * rng.uniform(0.1, 0.9)
    cut = rng.spawn(1)[0]  # a stream of its own: the other clips stay as they are
    share = motion.underway if underway is None else underway
    amid = motion.repeated is not None and bool(cut.random() < share)
    if amid:
        seconds = wanted
        plan = Plan(motion, person, cut, half_width, underway=seconds)
        lead = (seconds - plan.now) * cut.random()
    return Performance(
        label=motion.label,
        action=motion.action,
        seconds=seconds,
        tempo=plan.tempo,
        size=plan.size,
        cycles=plan.cycles,
        strokes=plan.placed(lead, seconds),
        base=plan.base,
        sway=sway_of_clip(rng, restless),
        walk=None if plan.walk is None else plan.walk.delayed(lead),
        underway=amid,
        lively=person.liveliness,
        stature=person.stature,
    )


def _fitting(wanted: float, draw: Callable[[], Plan]) -> Plan:
    """The first of 16 plans that fills a clip of ``wanted`` seconds well, else the longest that fits, else the last."""
    fits: Plan | None = None
    for _ in range(16):
        plan = draw()
        if plan.now <= wanted - 0.2:
            if plan.now >= _FILLED * wanted:
                return plan
            fits = plan if fits is None or plan.now > fits.now else fits
    return fits or plan
