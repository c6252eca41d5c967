from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recognizer.video.samples import LOOK_RATE, RATE, Sampler


def picture(value: int) -> np.ndarray:
    return np.full((32, 32, 3), value % 256, np.uint8)


@settings(deadline=None, max_examples=30)
@given(st.floats(1, 1000))
def test_at_a_steady_rate_the_frames_nearest_to_the_grid_are_taken(fps: float) -> None:
    sampler = Sampler(fps, seconds=1e3)
    count = min(400, round(3 * fps) + 2)
    for number in range(count):
        list(sampler.feed(picture(number), number / fps))
    step = max(1.0, fps / RATE)
    expected = sorted({round(k * step) for k in range(count) if round(k * step) < count})
    assert [sample.index for sample in sampler.samples] == expected
    looks = [time for sample in sampler.samples for time, _ in sample.looks]
    assert looks == sorted(looks)
    assert len(looks) <= count / max(1.0, fps / LOOK_RATE) + len(expected) + 1


def test_what_was_seen_last_is_seen_until_the_next_frame() -> None:
    uneven = Sampler(2.2)
    times = [0.0, 0.1, 4.0, 4.1, 4.2]
    samples = [sample for t in times for sample in uneven.feed(picture(round(10 * t)), t)]
    assert [sample.time for sample in samples] == pytest.approx(np.arange(43) / 10)
    assert {int(sample.grey[0, 0]) for sample in samples[1:40]} == {1}
    assert int(samples[40].grey[0, 0]) == 40


@settings(deadline=None, max_examples=30)
@given(st.lists(st.floats(0.01, 0.24), min_size=20, max_size=60))
def test_frames_at_any_times_give_about_ten_samples_a_second(steps: list[float]) -> None:
    sampler = Sampler(None)
    times = np.cumsum([0, *steps])
    taken = [sample.time for t in times for sample in sampler.feed(picture(0), float(t))]
    gaps = np.diff(taken)
    assert gaps.min() >= 1 / 30 - 1e-9  # half a period, less half of such a step
    assert gaps.max() <= 0.1 + max(steps)


def test_a_long_gap_does_not_fill_memory() -> None:
    sampler = Sampler(None)
    list(sampler.feed(picture(0), 0.0))
    assert len(list(sampler.feed(picture(9), 3000.0))) <= sampler.kept + 1
