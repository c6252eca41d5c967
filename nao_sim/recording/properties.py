"""What a recording is, as a few typed values, for viewers and catalogs that look at many recordings.

A number is a float64 and the rest is text, whatever came first: ``rr.AnyValues`` keeps a field's first type for the
whole process, so that a score of 0.75 after one of 1 is dropped, and 2.0 becomes 2.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import pyarrow as pa
    import rerun as rr


class _Values:
    """Values as Rerun takes them, each with its type."""

    def __init__(self, values: Mapping[str, object]) -> None:
        self._values = {name: _arrow(value) for name, value in values.items() if value is not None}

    def as_component_batches(self) -> list[rr.DescribedComponentBatch]:
        import rerun as rr

        return [
            rr.DescribedComponentBatch(_Array(array), rr.ComponentDescriptor(name))
            for name, array in self._values.items()
        ]


class _Array:
    def __init__(self, array: pa.Array) -> None:
        self._array = array

    def as_arrow_array(self) -> pa.Array:
        return self._array


def _arrow(value: object) -> pa.Array:
    import pyarrow as pa

    if isinstance(value, int | float | np.number) and not isinstance(value, bool):
        return pa.array([float(value)], pa.float64())
    return pa.array([str(value)], pa.string())


def send_properties(stream: rr.RecordingStream, group: str, values: Mapping[str, object]) -> None:
    """Give a recording its properties.

    Args:
        stream: an open recording.
        group: their common name.
        values: numbers become float64, everything else text; None is left out.
    """
    stream.send_property(group, _Values(values))
