from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recognizer.postures.thesis.contour import resample, smooth, sobel_edge, to_thesis_size, trace
from recognizer.postures.thesis.hand_region import centroid, cut_arm, most_featured, recentred
from recognizer.postures.thesis.shape_features import NAMES, measure, thesis_vector

from .conftest import posture, unseen_hands


def ellipse(a: float, b: float, count: int = 4000) -> np.ndarray:
    t = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.column_stack([a * np.cos(t) + 50, b * np.sin(t) + 40])


def test_circle():
    r = 10.0
    s = measure(ellipse(r, r))
    assert s.area == pytest.approx(np.pi * r**2, rel=1e-5)
    assert s.perimeter == pytest.approx(2 * np.pi * r, rel=1e-5)
    assert s.centroid == pytest.approx([50, 40])
    assert s.moment_max == pytest.approx(np.pi * r**4 / 4, rel=1e-5)
    assert s.moment_min == pytest.approx(s.moment_max, rel=1e-5)
    assert s.distance_max == pytest.approx(r)
    assert s.distance_min == pytest.approx(r)


def test_ellipse():
    a, b = 12.0, 5.0
    s = measure(ellipse(a, b))
    assert s.area == pytest.approx(np.pi * a * b, rel=1e-5)
    assert s.moment_max == pytest.approx(np.pi * a**3 * b / 4, rel=1e-5)
    assert s.moment_min == pytest.approx(np.pi * a * b**3 / 4, rel=1e-5)
    assert (s.distance_max, s.distance_min) == (pytest.approx(a), pytest.approx(b, rel=1e-5))


def test_rectangle_and_its_seven_numbers():
    w, h = 8.0, 3.0
    corners = np.array([[1, 1], [1 + w, 1], [1 + w, 1 + h], [1, 1 + h]])
    s = measure(corners)
    high, low = w**3 * h / 12, w * h**3 / 12
    assert (s.area, s.perimeter) == (w * h, 2 * (w + h))
    assert s.moment_max == pytest.approx(high)
    assert s.moment_min == pytest.approx(low)
    a, p = w * h, 2 * (w + h)
    expected = [p**4 / low, a**2 / high, a**2 / low, 1.0, p**2 / a, (low + high) / a**2, (high - low) / (high + low)]
    assert len(NAMES) == 7
    assert thesis_vector(corners) == pytest.approx(expected)


def test_polygon_moments_equal_those_of_the_filled_pixels():
    mask = unseen_hands("victory", 1)[0]
    ys, xs = np.nonzero(mask)
    fine = np.kron(mask, np.ones((1, 1)))  # one unit square a pixel
    s = measure(trace(mask))
    # The outline runs through pixel centres, so that it lies half a pixel inside the pixels' edge.
    assert s.area == pytest.approx(fine.sum(), rel=0.06)
    assert s.centroid == pytest.approx([xs.mean(), ys.mean()], abs=1.5)
    assert s.moment_max + s.moment_min == pytest.approx(len(xs) * (xs.var() + ys.var()), rel=0.1)


@settings(deadline=None, max_examples=20)
@given(turn=st.floats(0, 6.28), scale=st.floats(0.2, 5), dx=st.floats(-50, 50), flip=st.booleans())
def test_seven_numbers_do_not_depend_on_turn_scale_place_and_mirror(turn, scale, dx, flip):
    outline = np.array([[0, 0], [6, 0], [7, 3], [4, 2.5], [3, 8], [1, 4]], float)
    c, s = np.cos(turn), np.sin(turn)
    moved = outline * ([-1, 1] if flip else [1, 1]) @ np.array([[c, -s], [s, c]]) * scale + [dx, 3]
    assert thesis_vector(moved) == pytest.approx(thesis_vector(outline), rel=1e-6)


def test_a_line_has_no_shape():
    with pytest.raises(ValueError, match="no area"):
        measure(np.array([[0, 0], [1, 1], [2, 2]], float))


def test_sobel_edge_is_the_rim_of_the_mask():
    mask = np.zeros((20, 20), bool)
    mask[5:15, 4:16] = True
    rim = mask.copy()
    rim[6:14, 5:15] = False
    assert (sobel_edge(mask) == rim).all()
    assert {tuple(p) for p in trace(mask).astype(int)} == {(x, y) for y, x in zip(*np.nonzero(rim), strict=True)}


def test_smoothing_keeps_a_circle_and_removes_a_zigzag():
    circle = resample(ellipse(30, 30), 180)
    assert np.abs(smooth(circle) - circle).max() < 0.05
    zigzag = circle + np.where(np.arange(180) % 2, 0.5, -0.5)[:, None]
    assert np.abs(smooth(zigzag) - circle).max() < 0.25


def test_resampling_steps_are_equal():
    points = resample(ellipse(20, 8), 64)
    steps = np.hypot(*np.diff(np.vstack([points, points[:1]]), axis=0).T)
    assert steps.std() / steps.mean() < 0.02


def test_the_thesis_size_of_its_own_camera():
    assert to_thesis_size(np.zeros((1200, 1600, 3), np.uint8)).shape == (144, 176, 3)
    assert to_thesis_size(np.zeros((100, 100, 3), np.uint8)).shape == (144, 132, 3)


def test_cut_worked_example():
    """A wide bar above a narrow one: C, M and P by hand, the arm goes and the fingers stay."""
    mask = np.zeros((144, 176), bool)
    mask[20:80, 80:94] = True  # a finger: half width 7, its ridge within 4 to 12
    mask[80:130, 80:94] = True  # the arm below, as wide
    cut = cut_arm(mask)
    ys, xs = np.nonzero(mask)
    assert cut.centroid == pytest.approx([xs.mean(), ys.mean()])
    fy, fx = np.nonzero(cut.features)
    above = fy < cut.centroid[1]
    assert cut.fingers_mean == pytest.approx([fx[above].mean(), fy[above].mean()])
    assert cut.point == pytest.approx(cut.centroid - np.round(0.75 * (cut.fingers_mean - cut.centroid)))
    rows = np.nonzero(cut.hand.any(axis=1))[0]
    assert rows[0] == 20
    assert rows[-1] == pytest.approx(cut.point[1], abs=1)


def test_cut_without_features_leaves_the_object_whole():
    mask = np.zeros((144, 144), bool)
    mask[70:73, 70:73] = True
    assert (cut_arm(mask).hand == mask).all()


def test_the_open_hand_has_more_feature_pixels_than_a_face():
    hand = unseen_hands("stop_hand", 1)[0]
    scene = np.zeros((200, 320), bool)
    scene[:, :200] = hand
    y, x = np.mgrid[:200, :320]
    face = ((x - 265) / 42) ** 2 + ((y - 90) / 60) ** 2 < 1
    chosen = most_featured(scene | face, erosion=1)
    assert (chosen & face).sum() == 0
    assert (chosen & scene).sum() > 0.97 * scene.sum()
    assert not most_featured(np.zeros((9, 9), bool)).any()


def test_recentred_puts_the_centroid_in_the_middle():
    mask = unseen_hands("three", 1)[0]
    moved = recentred(mask)
    assert moved.sum() == mask.sum()
    assert centroid(moved) == pytest.approx([(moved.shape[1] - 1) / 2, (moved.shape[0] - 1) / 2], abs=0.51)


def test_every_posture_of_the_vocabulary_has_a_description():
    names = ("round", "victory", "three", "perfect", "pointing", "stop_hand", "four", "fist")
    assert [posture(name).label for name in names[:-1]] == list(names[:-1])
    assert posture("fist").label == "irrelevant"
