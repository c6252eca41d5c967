"""The thesis's seven shape numbers (S6; chapter 1 (3), eq. 6-13)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from recognizer.postures.types import Contour, Floats

NAMES = ("P4_over_Imin", "A2_over_Imax", "A2_over_Imin", "Dmax_over_Dmin", "compactness", "spreadness", "elongation")


@dataclass(frozen=True)
class Shape:
    """Geometry of a closed contour, in pixels and their powers."""

    area: float
    perimeter: float
    centroid: Floats  # (2,) x, y (eq. 8)
    moment_max: float  # principal second moments of the enclosed area (eq. 10, 11)
    moment_min: float
    distance_max: float  # from the centroid (eq. 12, 13)
    distance_min: float


def measure(contour: Contour) -> Shape:
    """Measure a closed polygon; area and moments (eq. 7-9) are exact, by Green's theorem.

    Eq. 12 and 13 as printed combine |x - x̄| and |y - ȳ| of different pixels; the smallest of each is 0 for every
    shape around its centroid, so that Dmax/Dmin would measure the pixel grid. Here D is what the text above them
    says: the largest and smallest distance of the outline from the centre of gravity.

    Args:
        contour: (n, 2) x, y, closed, n ≥ 3.

    Raises:
        ValueError: the contour encloses no area.
    """
    offset = contour.mean(axis=0)
    x, y = (contour - offset).T
    x1, y1 = np.roll(x, -1), np.roll(y, -1)
    cross = x * y1 - x1 * y
    signed = cross.sum() / 2
    if abs(signed) < 1e-9:
        raise ValueError("the contour encloses no area")
    cx = ((x + x1) * cross).sum() / (6 * signed)
    cy = ((y + y1) * cross).sum() / (6 * signed)
    sign = np.sign(signed)
    area = abs(signed)
    mu20 = sign * ((x * x + x * x1 + x1 * x1) * cross).sum() / 12 - area * cx * cx
    mu02 = sign * ((y * y + y * y1 + y1 * y1) * cross).sum() / 12 - area * cy * cy
    mu11 = sign * ((x * y1 + 2 * x * y + 2 * x1 * y1 + x1 * y) * cross).sum() / 24 - area * cx * cy
    root = np.sqrt(4 * mu11**2 + (mu20 - mu02) ** 2)
    distances = np.hypot(x - cx, y - cy)
    return Shape(
        area=float(area),
        perimeter=float(np.hypot(x1 - x, y1 - y).sum()),
        centroid=np.array([cx, cy]) + offset,
        moment_max=float((mu20 + mu02 + root) / 2),
        moment_min=float((mu20 + mu02 - root) / 2),
        distance_max=float(distances.max()),
        distance_min=float(distances.min()),
    )


def thesis_vector(contour: Contour) -> Floats:
    """Return the seven numbers of eq. 6, in its order (names in `NAMES`); none depends on scale or rotation.

    Args:
        contour: (n, 2) smoothed outline of the isolated hand.
    """
    s = measure(contour)
    low = max(s.moment_min, 1e-9)
    return np.array(
        [
            s.perimeter**4 / low,
            s.area**2 / s.moment_max,
            s.area**2 / low,
            s.distance_max / max(s.distance_min, 1e-9),
            s.perimeter**2 / s.area,
            (low + s.moment_max) / s.area**2,
            (s.moment_max - low) / (s.moment_max + low),
        ]
    )
