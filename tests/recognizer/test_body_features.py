"""Small statistics of the features, against NumPy's own."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from recognizer.body_features import _correlation, _spread

VALUES = st.lists(st.floats(-5, 5), min_size=2, max_size=40).map(np.array)


@given(values=VALUES)
def test_spread_lies_between_two_quantiles(values: np.ndarray) -> None:
    low, high = np.quantile(values, (0.05, 0.95))
    assert _spread(values) == pytest.approx(high - low, abs=1e-9)


@given(values=VALUES)
def test_correlation_with_time(values: np.ndarray) -> None:
    when = np.arange(len(values))
    if values.std() > 1e-3:
        assert _correlation(values, when) == pytest.approx(float(np.corrcoef(values, when)[0, 1]), abs=1e-6)
    assert _correlation(np.full(len(values), 2.0), when) == 0
