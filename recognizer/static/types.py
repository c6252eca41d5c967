"""Array types that the static chain passes along."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]  # (h, w, 3) BGR
Mask = NDArray[np.bool_]  # (h, w), True on skin
Floats = NDArray[np.float64]
Contour = NDArray[np.float64]  # (n, 2) x, y in pixels, closed: the last point joins the first
