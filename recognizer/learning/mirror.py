"""What a feature vector becomes when the clip is mirrored: a permutation with signs, so no clip is read twice.

A mirrored clip is as true as the original; its gesture is the mirror twin of the vocabulary. The model learns from
both, which doubles the data and makes left and right treated alike.
"""

from __future__ import annotations

import functools

import numpy as np

from recognizer.features.body_features import ONLY_MIRRORED, blank
from recognizer.features.phases import PHASES
from recognizer.learning.database import IRRELEVANT, Database, Rows

_OPPOSITE = {"right": "left", "left": "right", "right_side": "left_side", "left_side": "right_side"}


@functools.cache
def mirror_map() -> tuple[np.ndarray, np.ndarray]:
    """Return ``source`` and ``sign``, both (d,): ``mirrored = sign * vector[source]``."""
    groups = {name: np.shape(values) for name, values in blank()}
    sizes = {name: int(np.prod(shape)) for name, shape in groups.items()}
    start = dict(zip(groups, np.cumsum([0, *sizes.values()]), strict=False))
    sources, signs = [], []
    for name, shape in groups.items():
        inside, sign = _within(name, shape)
        sources.append(start[_twin(name)] + inside.ravel())
        signs.append(sign.ravel())
    return np.concatenate(sources), np.concatenate(signs)


@functools.cache
def asked() -> np.ndarray:
    """Which features a model may look at, (d,) bool: not those that only its rows have, for their mirrored twins."""
    return np.concatenate([np.full(np.size(values), name != ONLY_MIRRORED) for name, values in blank()])


def mirrored(vectors: np.ndarray) -> np.ndarray:
    """Feature vectors (n, d) of the mirrored clips."""
    source, sign = mirror_map()
    return vectors[:, source] * sign


def mirrored_map(maps: np.ndarray) -> np.ndarray:
    """What ``maps`` (d, c) must be so that a vector gives what its mirrored one gives with ``maps``."""
    source, sign = mirror_map()
    out = np.empty_like(maps)
    out[source] = maps * sign.astype(maps.dtype)[:, None]
    return out


def twins(database: Database) -> Rows:
    """Return what the mirrored clips of a database show.

    The twin of a gesture that the database does not know (``left_arm_up``) is irrelevant motion, and an irrelevant
    motion that is such a twin becomes the gesture.
    """
    rows, mirror = database.rows, database.mirror
    family = dict(zip(rows.labels.tolist(), rows.families.tolist(), strict=True))
    gesture = {twin: name for name, twin in mirror.items() if twin not in mirror and name in family}
    labels, actions = [], []
    for label, action in zip(rows.labels.tolist(), rows.actions.tolist(), strict=True):
        if label == IRRELEVANT:
            # An action of a gesture's own name was called irrelevant by who labelled it, and stays so.
            labels.append(gesture.get(action, IRRELEVANT))
            actions.append(gesture.get(action, action))
        else:
            twin = mirror.get(label, label)
            labels.append(twin if twin in family else IRRELEVANT)
            actions.append(twin)
    return Rows(
        np.array(labels),
        np.array([family.get(label, IRRELEVANT) for label in labels]),
        np.array(actions),
        rows.persons,
        np.char.add(rows.sources, " mirrored"),
    )


def _twin(name: str) -> str:
    """The group that describes the other side."""
    for prefix in ("path_", "circulation_", "flicker_"):
        if name.startswith(prefix):
            side = name.removeprefix(prefix)
            return prefix + _OPPOSITE.get(side, side)
    if name in (both := ("motion", ONLY_MIRRORED)):
        return both[name == "motion"]
    if name.startswith("rhythm_"):
        side, axis = name.removeprefix("rhythm_").rsplit("_", 1)
        return f"rhythm_{_OPPOSITE.get(side, side)}_{axis}"
    return name


def _within(name: str, shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Order and signs inside one group."""
    order = np.arange(int(np.prod(shape))).reshape(shape)
    sign = np.ones(shape)
    if name == "flow_phase":  # phase, way, row, column; ways are right, left, down, up
        order = order[:, [1, 0, 2, 3], :, ::-1]
    elif name == "flow":
        order = order[[1, 0, 2, 3], :, ::-1]
    elif name.startswith("changed_") or name in ("head_cells", "unrest"):
        order = order[..., ::-1]
    elif name.startswith("edges_"):  # direction, row, column; a slanting edge slants the other way
        order = order[[0, 3, 2, 1], :, ::-1]
    elif name.startswith(("rhythm_", "head_rhythm_")) and name.endswith("_x"):
        sign[-1] = -1  # net direction
    elif name.startswith("circulation_"):
        sign[:] = -1
    elif name.startswith("path_"):  # x, y, spreads and amount of each phase, then the steps of x and of y
        sign[:PHASES] = -1
        sign[5 * PHASES : 6 * PHASES - 1] = -1
    elif name == "head_places":  # x of each phase, y of each phase, spreads
        sign[:PHASES] = -1
    elif name == "image_path":
        sign[[0, 4, 8, 10, 11]] = -1
    return order, sign
