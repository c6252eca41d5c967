"""Array types that the static chain passes along."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Image = NDArray[Any]  # (h, w, 3) uint8 BGR; Any because OpenCV's hints are wider
Mask = NDArray[np.bool_]  # (h, w), True on skin
Floats = NDArray[np.float64]
Contour = NDArray[np.float64]  # (n, 2) x, y in pixels, closed: the last point joins the first
