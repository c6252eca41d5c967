"""Which of the places that look like head and shoulders is the person who moves?"""

from __future__ import annotations

import math

import cv2
import numpy as np

from recognizer.finder import Body, best_bodies, closer_look, closer_template, ranking, score_maps, template
from recognizer.samples import Sample

OBSERVED = (1, 6, 11, 16, 26, 36, 46, 56)  # samples on which the template is tried, until the person is found
LAG = 2  # samples between the two pictures whose difference is motion
MOVED = 8.0  # grey levels
ACTIVE_AREA = 0.004  # share of the image that must change for a sample to count as moving
ENOUGH_ACTIVE = 8  # moving samples after which the search may end …
ENOUGH_SEEN = 12  # … but not before this one
LAST_CHANCE = 60  # samples after which the search ends in any case
NAMES = (
    "template", "rank", "share_reach", "share_body", "density_body", "share_head", "density_head",
    "now_reach", "now_body", "now_density_body", "now_head", "now_density_head",
    "size", "seen_again", "first", "closer",
)  # fmt: skip


class BodyFinder:
    """Collects candidates and motion while frames arrive; :attr:`body` is set when the person is found."""

    def __init__(self) -> None:
        self.body: Body | None = None
        self._flat: list[np.ndarray] = []
        self._moved: list[np.ndarray] = []
        self._found: list[tuple[int, list[Body], np.ndarray]] = []
        self._last: Sample | None = None

    def observe(self, sample: Sample) -> None:
        """Take one sample; after the person is found nothing more is done."""
        if self.body is not None:
            return
        number = len(self._moved)
        self._last = sample
        # Without the local mean, flicker and exposure do not look like motion.
        self._flat.append(sample.small - cv2.blur(sample.small, (15, 15)))
        self._flat = self._flat[-LAG - 1 :]
        self._moved.append((np.abs(self._flat[-1] - self._flat[0]) > MOVED).astype(np.uint8))
        if number in OBSERVED:
            self._search(sample)
        active = sum(float(m.mean()) > ACTIVE_AREA for m in self._moved)
        if (active >= ENOUGH_ACTIVE and number + 1 >= ENOUGH_SEEN) or number + 1 >= LAST_CHANCE:
            self.decide()

    def _search(self, sample: Sample) -> None:
        self._found.append((len(self._moved) - 1, *self.search(sample.grey)))

    def search(self, grey: np.ndarray) -> tuple[list[Body], np.ndarray]:
        """Return the places that look like a person, and the score of the closer look at each."""
        height, width = grey.shape
        found = best_bodies(score_maps(grey, *template()), (width, height))
        weights, offset = closer_template()
        return found, closer_look(grey, found) @ weights + offset

    def decide(self) -> Body:
        """Choose among the candidates seen so far; the same answer whenever it is called again."""
        if self.body is None:
            if not self._found and self._last is not None:
                self._search(self._last)
            candidates, table = self.candidates()
            if not candidates:
                raise ValueError("no sample was observed")
            weights, offset = ranking()
            scores = table @ weights + offset
            best = int(np.argmax(scores))
            self.body = _mean_body(candidates, scores, best)
        return self.body

    def candidates(self) -> tuple[list[Body], np.ndarray]:
        """Return the candidates and what is known of each, (n, 32).

        Columns are as in NAMES, then the same relative to the highest of the clip: what counts is to be
        more like a person than the rest of the picture.
        """
        assert self._last is not None
        grey = self._last.grey.shape
        scale = self._last.small.shape[1] / grey[1]
        whole = cv2.integral(np.mean(self._moved, axis=0).astype(np.float32))
        bodies, rows = [], []
        for order, (number, found, closer) in enumerate(self._found):
            near = np.mean(self._moved[max(0, number - 3) : number + 4], axis=0).astype(np.float32)
            now = cv2.integral(near)
            for rank, body in enumerate(found):
                again = sum(any(_same(body, b) for b in others) for n, others, _ in self._found if n != number)
                known = [body.score, rank, *_motion(whole, body, scale), *_motion(now, body, scale)]
                rows.append(
                    [
                        *known,
                        math.log(body.head / grey[0]),
                        again / max(1, len(self._found) - 1),
                        order == 0,
                        closer[rank],
                    ]
                )
                bodies.append(body)
        table = np.array(rows, float).reshape(-1, len(NAMES))
        return bodies, np.hstack([table, table - table.max(axis=0)])


def _same(a: Body, b: Body) -> bool:
    return math.hypot(a.x - b.x, a.y - b.y) < 0.5 * b.head and abs(math.log(a.head / b.head)) < 0.3


def _mean_body(candidates: list[Body], scores: np.ndarray, best: int) -> Body:
    """Average the chosen candidate with its sightings on other samples: levels of the pyramid are coarse."""
    same = [b for b in candidates if _same(b, candidates[best])]
    x, y = float(np.mean([b.x for b in same])), float(np.mean([b.y for b in same]))
    return Body(x, y, float(np.exp(np.mean([math.log(b.head) for b in same]))), float(scores[best]))


def _motion(integral: np.ndarray, body: Body, scale: float) -> list[float]:
    """Share and density of the motion within arm's reach of a candidate, on its body, and on its head."""
    x, y, h = body.x * scale, body.y * scale, body.head * scale
    total = float(integral[-1, -1]) + 1.0
    reach, _ = _box(integral, x - 3.8 * h, y - 3 * h, x + 3.8 * h, y + 5 * h)
    trunk, trunk_area = _box(integral, x - 2 * h, y - h, x + 2 * h, y + 3.5 * h)
    head, head_area = _box(integral, x - 0.5 * h, y - 0.6 * h, x + 0.5 * h, y + 0.6 * h)
    return [reach / total, trunk / total, trunk / trunk_area, head / total, head / head_area]


def _box(integral: np.ndarray, x0: float, y0: float, x1: float, y1: float) -> tuple[float, float]:
    """Sum and area [px] of a box of an integral image, cut at the border."""
    height, width = integral.shape[0] - 1, integral.shape[1] - 1
    left, right = (min(width, max(0, round(v))) for v in (x0, x1))
    top, bottom = (min(height, max(0, round(v))) for v in (y0, y1))
    total = integral[bottom, right] - integral[top, right] - integral[bottom, left] + integral[top, left]
    return float(total), max(1.0, float((right - left) * (bottom - top)))
