"""Motion described relative to the body: where, which way, in what order, how often.

The default method. All lengths are head heights from the head's centre, all times seconds; five phases of the
active part stand for the thesis's five consecutive states (ch. 2 (2)), with flow in place of difference images.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np

from recognizer.features.change_features import unrest_features
from recognizer.features.head_features import SWAY_SECONDS, head_features, running_mean
from recognizer.features.phases import PHASES, Active, active_part
from recognizer.features.pose_features import pose_features
from recognizer.features.step_history import Steps
from recognizer.motion.moving_regions import MovingRegions
from recognizer.networks.motion_net import FEATURES
from recognizer.person.head_motion import LIGHT
from recognizer.person.head_motion import NAMES as HEAD_MOTIONS
from recognizer.person.head_shoulders import Body
from recognizer.person.steps import make_step
from recognizer.person.view import COLUMNS, GRID_X, GRID_Y, HEAD, POSE, ROWS

METHOD = "body"
VERSION = 8
ONLY_MIRRORED = "motion_mirrored"  # the group that only says what the mirrored row has for "motion"
BANDS = ((0.2, 0.8), (0.8, 1.5), (1.5, 2.5), (2.5, 5.01))  # Hz
SHOULDERS = (-0.8, 0.8)  # x of the shoulders, 1.4 below the head's centre
_FFT = 64
HEAD_X, HEAD_Y = HEAD.grid()
Item = tuple[str, np.ndarray]


def describe(
    steps: Steps,
    head_motion: np.ndarray,
    motion: np.ndarray,
    regions: list[MovingRegions],
    body: Body,
    size: tuple[int, int],
) -> list[Item]:
    """Return named groups of features of one clip.

    Args:
        steps: from :class:`recognizer.person.steps.Windows`; 2 at least.
        head_motion: from :class:`recognizer.person.head_motion.HeadMotion`, (n, 17).
        motion: from :class:`recognizer.features.network_features.MotionWatch`, (2, 128); of a question, the second row
            is not asked for (:func:`recognizer.learning.mirror.asked`).
        regions: moving regions in the whole image.
        body: place and size of the person [px of an image of ``size``].
        size: width and height of that image.
    """
    active = active_part(steps)
    return [
        *_flow_maps(active),
        *pose_features(active),
        *unrest_features(active),
        *_rhythm(active),
        *_paths(active),
        *_circulation(active),
        *_head(active),
        *_head_places(active),
        *head_features(head_motion),
        *_whole_image(regions, body, size),
        *zip(("motion", ONLY_MIRRORED), motion, strict=True),
        ("moved", np.array([math.log1p(active.moved), math.log1p(active.speed.max(axis=0).mean())])),
        ("active_seconds", np.array([math.log((active.last - active.first) * active.period + 0.2)])),
    ]


def _flow_maps(active: Active) -> Iterator[Item]:
    """Motion to the right, left, down and up: on coarse cells in each phase, on fine cells over the clip."""
    fine = np.einsum("pt,tdyx->pdyx", active.phases, active.ways)
    coarse = fine.reshape(PHASES, 4, ROWS // 2, 2, COLUMNS // 2, 2).mean(axis=(3, 5))
    yield "flow_phase", np.sqrt(coarse / (fine.sum() + 0.5))
    yield "flow", np.sqrt(fine.sum(axis=0))


def _signals(values: np.ndarray, period: float) -> np.ndarray:
    """Shares of four frequency bands, number of turns, amount and net direction of velocity signals (n, k), (k, 7)."""
    n, k = values.shape
    spectrum = np.abs(np.fft.rfft(values * np.hanning(n + 2)[1:-1, None], _FFT, axis=0)) ** 2
    frequency = np.fft.rfftfreq(_FFT, period)
    total = spectrum[1:].sum(axis=0) + 1e-4
    shares = [spectrum[(frequency >= low) & (frequency < high)].sum(axis=0) / total for low, high in BANDS]
    sizes = np.abs(values)
    amount = sizes.sum(axis=0)
    strong = sizes > 0.25 * sizes.max(axis=0) + 1e-6
    turns = [np.count_nonzero(np.diff(np.sign(values[strong[:, i], i]))) for i in range(k)]
    return np.column_stack([*shares, np.sqrt(turns), np.log1p(0.1 * amount), values.sum(axis=0) / (amount + 0.1)])


_REGIONS = {
    "right_side": (GRID_X < -0.6) & (GRID_Y < 2.5),
    "left_side": (GRID_X > 0.6) & (GRID_Y < 2.5),
    "face": (np.abs(GRID_X) < 0.7) & (np.abs(GRID_Y) < 0.7),
    "all": np.ones_like(GRID_X, bool),
}
_REGION_MAPS = np.column_stack([region.ravel() for region in _REGIONS.values()]).astype(np.float32)


def _rhythm(active: Active) -> Iterator[Item]:
    """How often motion turns round, and at what frequency, on each side, at the face, and overall."""
    part, n = slice(active.first, active.last), active.last - active.first
    flows = [flow[part].reshape(n, -1) @ _REGION_MAPS for flow in (active.u, active.v)]
    described = _signals(np.hstack(flows) / 64, active.period)
    for i, values in enumerate(described):
        yield f"rhythm_{list(_REGIONS)[i % len(_REGIONS)]}_{'xy'[i // len(_REGIONS)]}", values


def _paths(active: Active) -> Iterator[Item]:
    """Centre, spread and amount of motion in each phase: everywhere, on each side of the body's axis."""
    x, y = GRID_X.ravel(), GRID_Y.ravel()
    speed = active.phases @ active.speed.reshape(len(active.speed), -1)
    for name, side in (("all", np.ones_like(x)), ("right", x < 0), ("left", x >= 0)):
        weight = speed * side
        total = weight.sum(axis=1) + 2.0
        cx, cy = weight @ x / total, weight @ y / total
        sx = np.sqrt(np.maximum(weight @ (x * x) / total - cx * cx, 0))
        sy = np.sqrt(np.maximum(weight @ (y * y) / total - cy * cy, 0))
        values = (cx, cy, sx, sy, np.log1p(total / 64), np.diff(cx), np.diff(cy))
        yield f"path_{name}", np.concatenate(values)


def _circulation(active: Active) -> Iterator[Item]:
    """Sense of rotation about each shoulder in each phase and in all; positive is clockwise to the camera."""
    for name, shoulder in zip(("right", "left"), SHOULDERS, strict=True):
        rx, ry = GRID_X - shoulder, GRID_Y - 1.4
        arm = (rx * rx + ry * ry < 16) & (GRID_X * np.sign(shoulder) > -0.3)
        n = len(active.u)
        turning = active.v.reshape(n, -1) @ (rx * arm).ravel() - active.u.reshape(n, -1) @ (ry * arm).ravel()
        phases = active.phases @ (turning / 64)
        values = np.append(phases, phases.sum())
        yield f"circulation_{name}", np.sign(values) * np.sqrt(np.abs(values))


def _head(active: Active) -> Iterator[Item]:
    """The head from near: nodding and shaking, as rhythm and as a map of 3×3 cells."""
    part = active.head[active.first : active.last]
    seconds = active.seconds[active.first : active.last]
    face = ((HEAD_X / 0.38) ** 2 + (HEAD_Y / 0.5) ** 2 < 1).astype(np.float32).ravel()
    flat = part.reshape(len(part), 2, -1)
    mean = flat @ (face / face.sum())
    moved = np.tensordot(seconds, np.abs(part), 1)
    amount = moved.reshape(2, -1) @ (face / face.sum())
    # Who sways takes head and chest along; a nod is the head's own.
    own = mean - active.torso[active.first : active.last]
    described = _signals(4 * np.column_stack([mean, own]), active.period)
    for name, values in zip(("x", "y", "own_x", "own_y"), described, strict=True):
        yield f"head_rhythm_{name}", values
    quick = own - running_mean(own, round(SWAY_SECONDS / active.period))
    sizes = np.concatenate(
        [amount + 0.02, mean.std(axis=0) + 0.02, quick.std(axis=0) + 0.02, np.abs(quick).max(axis=0) + 0.05]
    )
    yield "head_amount", np.log(sizes)
    yield "head_axis", np.log(sizes[1::2] / sizes[::2])
    cells = moved.reshape(2, 3, 14, 3, 14).mean(axis=(2, 4))
    yield "head_cells", np.sqrt(cells / (cells.sum() + 0.1))


def _head_places(active: Active) -> Iterator[Item]:
    """Where the head is in each phase against where it was before, and how far it goes to the sides and up and down."""
    before = active.places[max(0, active.first - 2) : active.first + 1].mean(axis=0)
    phases = active.phases @ active.places / (active.phases.sum(axis=1, keepdims=True) + 1e-6) - before
    spread = np.log(active.places[active.first : active.last].std(axis=0) + 0.03)
    yield "head_places", np.concatenate([phases.T.ravel(), spread])


def _whole_image(regions: list[MovingRegions], body: Body, size: tuple[int, int]) -> Iterator[Item]:
    """Path of all motion across the image, for who walks through it."""
    head, aspect = body.head / size[0], size[0] / size[1]
    rows = np.array([(*r.centroid, r.area, *r.velocity) for r in regions if r.area > 0.003]).reshape(-1, 5)
    out = np.zeros(13)
    if len(rows) >= 2:
        x, y, area, u, v = rows.T
        quarter = max(1, len(rows) // 4)
        first, last = slice(0, quarter), slice(-quarter, None)
        dx, dy = (np.average(c[last], weights=area[last]) - np.average(c[first], weights=area[first]) for c in (x, y))
        wide, tall = _spread(x), _spread(y)
        steady = _correlation(x, np.arange(len(x)))
        in_heads = [np.sign(dx) * min(5, abs(dx) / head / 2), min(5, wide / head / 2), min(5, tall / head / aspect / 2)]
        net = float((u * area).sum() / ((np.abs(u) * area).sum() + 0.01))
        mean_u, mean_v = np.average(u, weights=area), np.average(v, weights=area)
        covered = min(4, area.mean() / (head * head * aspect) / 4)
        out = np.array([dx, dy, wide, tall, *in_heads, math.sqrt(area.mean()), mean_u, mean_v, net, steady, covered])
    yield "image_path", out


def _spread(values: np.ndarray) -> float:
    """Between the 5 % and the 95 % quantile of two values or more; NumPy's own takes longer than all around it."""
    ordered = np.sort(values)
    places = np.array([0.05, 0.95]) * (len(values) - 1)
    below = places.astype(int)
    low, high = ordered[below] + (places - below) * (ordered[np.minimum(below + 1, len(values) - 1)] - ordered[below])
    return float(high - low)


def _correlation(a: np.ndarray, b: np.ndarray) -> float:
    """Pearson's, of two values or more; 0 where ``a`` does not vary."""
    a, b = a - a.mean(), b - b.mean()
    size = math.sqrt(float(a @ a) * float(b @ b))
    return float(a @ b) / size if a @ a > 1e-12 * len(a) else 0.0


def vector(items: list[Item]) -> np.ndarray:
    """Concatenate named groups, (d,) float32."""
    return np.concatenate([np.ravel(values) for _, values in items]).astype(np.float32)


def blank() -> list[Item]:
    """Features of a clip in which nothing moves: their names and number."""
    zero = np.zeros((2, 64, 80), np.float32)
    head = np.zeros((2, *HEAD_X.shape), np.float32)
    pose = np.zeros(POSE.size[::-1], np.uint8)
    steps = Steps(7)
    for i in range(1, 8):
        steps.append(make_step(0.1 * i, 0.1, zero[0], zero, head, pose, np.zeros(2, np.float32)))
    head_motion = np.zeros((7, 2 + len(HEAD_MOTIONS) + len(LIGHT)), np.float32)
    head_motion[:, 1] = 0.1
    motion = np.zeros((2, FEATURES), np.float32)
    return describe(steps, head_motion, motion, [], Body(40, 40, 10, 0), (320, 240))


def names() -> tuple[str, ...]:
    """Name of every feature, in order."""
    groups = ([f"{name}_{i}" for i in range(np.size(values))] for name, values in blank())
    return tuple(itertools.chain.from_iterable(groups))
