"""Steps in arrays are the last ones, in order, however many came."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from recognizer.features.step_history import Steps
from recognizer.person.steps import Step, make_step
from recognizer.person.view import HEAD, POSE, WHOLE


def step(number: int) -> Step:
    zero = np.zeros((2, *WHOLE.size[::-1]), np.float32)
    pose = np.full(POSE.size[::-1], number % 256, np.uint8)
    return make_step(
        0.1 * number, 0.1, zero[0] + number, zero, np.zeros((2, *HEAD.size[::-1]), np.float32), pose, np.zeros(2)
    )


@given(st.integers(1, 6), st.integers(1, 40))
def test_the_last_steps_are_kept_in_order(kept: int, count: int) -> None:
    steps = Steps(kept)
    for number in range(count):
        steps.append(step(number))
    expected = list(range(max(0, count - kept), count))
    assert len(steps) == len(expected)
    np.testing.assert_allclose(steps.stacked("time"), 0.1 * np.array(expected))
    assert steps.stacked("picture")[:, 0, 0].tolist() == expected
    assert steps.stacked("pose")[:, 3, 5].tolist() == expected
    assert steps.stacked("flow").shape == (len(expected), 2, *WHOLE.size[::-1])
