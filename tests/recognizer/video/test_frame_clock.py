from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from recognizer.video.frame_clock import FrameClock, rate_of


def told(fps: float | None, stamps: list[float | None]) -> list[float]:
    clock = FrameClock(fps)
    return [clock(stamp) for stamp in stamps]


@pytest.mark.parametrize("fps", [7.5, 10.0, 29.97, 120.0, 1000.0])
def test_stamps_that_agree_with_the_rate_leave_it_exact(fps: float) -> None:
    rounded = [round(1000 * n / fps) / 1000 + 0.04 for n in range(200)]  # whole milliseconds, an origin of their own
    if fps <= 250:
        assert told(fps, rounded) == [n / fps for n in range(200)]
    assert told(fps, [None] * 200) == [n / fps for n in range(200)]


def test_uneven_stamps_are_the_time() -> None:
    stamps = [0.0, 4.0, 4.1, 4.2, 4.7, 4.8]
    assert told(2.2, stamps) == pytest.approx(stamps)
    assert told(None, [100 + s for s in stamps]) == pytest.approx(stamps)


def test_one_wrong_stamp_costs_nothing_and_stamps_that_begin_anew_are_followed() -> None:
    wrong = [0.0, 0.1, 0.2, 0.0, 0.4, 0.5]
    assert told(None, wrong)[-1] == pytest.approx(0.5, abs=0.06)
    anew = [0.0, 0.5, 1.0, 0.0, 0.5, 1.0]
    assert told(None, anew) == pytest.approx([0, 0.5, 1.0, 1.04, 1.54, 2.04])


def test_a_clock_that_jumps_by_days_is_no_gap() -> None:
    assert told(None, [0.0, 0.1, 1e6, 1e6 + 0.1]) == pytest.approx([0.0, 0.1, 0.14, 0.24])


@given(
    fps=st.one_of(st.none(), st.floats(0.5, 1000)),
    stamps=st.lists(st.one_of(st.none(), st.floats(allow_nan=True, allow_infinity=True)), min_size=1, max_size=40),
)
def test_time_never_stands_still_whatever_the_stamps(fps: float | None, stamps: list[float | None]) -> None:
    times = told(fps, stamps)
    assert times[0] == 0
    assert all(math.isfinite(t) for t in times)
    assert (np.diff(times) > 0).all()


def test_a_rate_is_told_by_most_of_the_stamps() -> None:
    assert rate_of([0.0, 0.1, 0.2, 0.2, 0.3]) == pytest.approx(10)
    assert rate_of([0.0, 0.0, 0.0]) is None
    assert rate_of([]) is None
