"""The head's own motion: a known nod, shake or sway is measured as such, whatever the size of the picture."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from recognizer.features.head_features import head_features
from recognizer.person.head_motion import AXES, LIGHT, NAMES, HeadMotion
from recognizer.person.head_shoulders import Body

BODY = Body(160.0, 100.0, 48.0, 1.0)
SECONDS = 1 / 30


@pytest.fixture(scope="module")
def texture() -> np.ndarray:
    """A picture with detail of the size of eyes and mouth, and flat enough to be interpolated."""
    noise = np.random.default_rng(3).uniform(0, 255, (240, 320)).astype(np.float32)
    smooth = cv2.GaussianBlur(noise, (0, 0), 5)
    return cv2.normalize(smooth, None, 20, 235, cv2.NORM_MINMAX).astype(np.uint8)


def moved(picture: np.ndarray, right: np.ndarray | float, down: np.ndarray | float) -> np.ndarray:
    """The picture with every pixel moved by so much [px]."""
    rows, columns = np.mgrid[: picture.shape[0], : picture.shape[1]].astype(np.float32)
    return cv2.remap(
        picture,
        (columns - right).astype(np.float32),
        (rows - down).astype(np.float32),
        cv2.INTER_CUBIC,
        borderMode=cv2.BORDER_REPLICATE,
    )


def bulge() -> np.ndarray:
    """How far each pixel of the picture stands out of the ellipsoid's rim, 0 … 1."""
    rows, columns = np.mgrid[:240, :320]
    x, y = (columns + 0.5 - BODY.x) / BODY.head, (rows + 0.5 - BODY.y) / BODY.head
    return np.sqrt(np.clip(1 - (x / AXES[0]) ** 2 - (y / AXES[1]) ** 2, 0, 1))


def measured(first: np.ndarray, second: np.ndarray, body: Body = BODY, after: Body | None = None) -> dict[str, float]:
    """Motion between two pictures [head heights per frame], of a head at ``body`` and then at ``after``."""
    head = HeadMotion()
    assert head.push([(0.0, first)], body) == []
    (row,) = head.push([(SECONDS, second)], after or body)
    assert row[:2] == pytest.approx([SECONDS, SECONDS], rel=1e-6)
    return dict(zip(NAMES, (row[2:10] * SECONDS).tolist(), strict=True))


@pytest.mark.parametrize(("right", "down"), [(3.0, 0.0), (0.0, -2.5), (-1.5, 1.5)])
def test_sway_moves_head_and_chest_together(texture: np.ndarray, right: float, down: float) -> None:
    found = measured(texture, moved(texture, right, down))
    for part in ("", "chest_"):
        assert found[part + "right"] == pytest.approx(right / BODY.head, abs=0.012)
        assert found[part + "down"] == pytest.approx(down / BODY.head, abs=0.012)
    assert abs(found["turn"]) < 0.02
    assert abs(found["nod"]) < 0.02


def test_where_the_window_is_does_not_count(texture: np.ndarray) -> None:
    pair = texture, moved(texture, 9.0 + 2.0 * bulge(), -4.0)
    followed = measured(*pair, after=Body(BODY.x + 8, BODY.y - 5, BODY.head, 1.0))
    for name, expected in (("chest_right", 9.0), ("chest_down", -4.0), ("down", -4.0)):
        assert followed[name] == pytest.approx(expected / BODY.head, abs=0.02)
    assert followed["right"] + followed["turn"] == pytest.approx(11.0 / BODY.head, abs=0.04)


def test_the_head_is_measured_in_every_frame_and_the_chest_between_samples(texture: np.ndarray) -> None:
    """The head turns to and fro from frame to frame while the whole person sways steadily."""
    head, sway, turns = HeadMotion(), 0.8, (0.0, 2.5, 0.0, 2.5, 0.0, 2.5)
    frames = [(k * SECONDS, moved(texture, sway * k + turn * bulge(), 0.0)) for k, turn in enumerate(turns)]
    rows = [*head.push(frames[:1], BODY), *head.push(frames[1:3], BODY), *head.push(frames[3:], BODY)]
    assert len(rows) == len(frames) - 1
    found = dict(zip(("time", "seconds", *NAMES), np.array(rows).T, strict=False))
    np.testing.assert_allclose(found["time"], [time for time, _ in frames[1:]], rtol=1e-6)
    np.testing.assert_allclose(found["seconds"], SECONDS, rtol=1e-5)
    assert np.sign(found["turn"]).tolist() == [1, -1, 1, -1, 1]
    np.testing.assert_allclose(found["chest_right"], sway / BODY.head / SECONDS, rtol=0.1)
    assert len(set(found["chest_right"][:2].tolist())) == len(set(found["chest_right"][2:].tolist())) == 1


@pytest.mark.parametrize(("name", "other"), [("turn", "nod"), ("nod", "turn")])
def test_who_turns_moves_the_middle_and_leaves_the_rim(texture: np.ndarray, name: str, other: str) -> None:
    pixels = 3.0 * bulge()
    found = measured(texture, moved(texture, pixels if name == "turn" else 0, pixels if name == "nod" else 0))
    assert found[name] == pytest.approx(3.0 / BODY.head, abs=0.02)
    assert abs(found[other]) < 0.015
    assert abs(found["right" if name == "turn" else "down"]) < 0.02
    assert abs(found["chest_right"]) + abs(found["chest_down"]) < 0.005


def test_half_the_picture_gives_the_same(texture: np.ndarray) -> None:
    pair = texture, moved(texture, 3.0 * bulge(), 1.0)
    small = [cv2.resize(picture, (160, 120), interpolation=cv2.INTER_AREA) for picture in pair]
    whole, half = measured(*pair), measured(*small, Body(80.0, 50.0, 24.0, 1.0))
    for name in ("turn", "down", "chest_down"):
        assert half[name] == pytest.approx(whole[name], abs=0.02)


COLUMNS = (*NAMES, *LIGHT)
TURNING, NODDING = 5, 11  # among the sizes of head_whole and head_peak


def clip(nod: float, turn: float, sway: float, seconds: float = 3.0, fps: float = 25.0) -> np.ndarray:
    """Rows as of HeadMotion: two oscillations a second of so many head heights a second, over a slow sway."""
    time = np.arange(1, round(seconds * fps)) / fps
    rows = np.zeros((len(time), 2 + len(NAMES) + len(LIGHT)))
    rows[:, -1] = 40.0  # contrast
    rows[:, 0], rows[:, 1] = time, 1 / fps
    beat, slow = np.sin(4 * np.pi * time), np.sin(0.6 * np.pi * time)
    for name, amount in (
        ("nod", nod * beat),
        ("turn", turn * beat),
        ("right", sway * slow),
        ("chest_right", sway * slow),
        ("light_down", 8 * nod * np.cos(4 * np.pi * time)),
        ("light_right", 8 * turn * np.cos(4 * np.pi * time)),
    ):
        rows[:, 2 + COLUMNS.index(name)] = amount
    return rows


def test_nod_and_shake_are_told_apart_over_a_strong_sway() -> None:
    nodded, shaken = (dict(head_features(clip(nod, turn, 0.8))) for nod, turn in ((0.6, 0.0), (0.0, 0.6)))
    for group in ("head_peak", "head_whole"):
        assert nodded[group][NODDING] - nodded[group][TURNING] > 1
        assert shaken[group][TURNING] - shaken[group][NODDING] > 1
    assert nodded["head_light"][2] - nodded["head_light"][1] > 1  # what is dark moves down and up, too


def test_mirroring_changes_none_of_the_head_features() -> None:
    rows = clip(0.3, 0.5, 0.4)
    turned = rows.copy()
    for name in ("right", "roll", "turn", "chest_right", "light_right", "light_askew"):
        turned[:, 2 + COLUMNS.index(name)] *= -1
    for (name, values), (_, other) in zip(head_features(rows), head_features(turned), strict=True):
        np.testing.assert_allclose(values, other, atol=1e-9, err_msg=name)


def test_camera_at_half_the_rate_gives_nearly_the_same_features() -> None:
    quick, slow = (dict(head_features(clip(0.5, 0.1, 0.3, fps=fps))) for fps in (30.0, 15.0))
    apart_quick, apart_slow = (f["head_peak"][NODDING] - f["head_peak"][TURNING] for f in (quick, slow))
    assert apart_quick == pytest.approx(apart_slow, abs=0.35)
    sizes_quick, sizes_slow = (np.exp(f["head_peak"][:12]) for f in (quick, slow))
    np.testing.assert_allclose(sizes_quick, sizes_slow, atol=0.02)  # head heights per second
    np.testing.assert_allclose(quick["head_light"], slow["head_light"], atol=0.2)
