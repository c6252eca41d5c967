"""Which of the places that look like head and shoulders is the person who moves?"""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.person.closer_look import closer_score
from recognizer.person.head_fit import fit, fit_weights, moved
from recognizer.person.head_shoulders import Body, best_bodies, closer_look, score_maps, template
from recognizer.person.ranking import Ranking
from recognizer.video.samples import Sample

OBSERVED = (1, 8, 16, 26, 36, 46, 56)  # samples on which the template is tried, until the person is found
FITTED_EVERY = 2  # samples: on these the head's place is made exact once it is known who it is …
FITTED = 8  # … on so many of them at most
LAG = 2  # samples between the two pictures whose difference is motion
MOVED = 8.0  # grey levels
ACTIVE_AREA = 0.004  # share of the image that must change for a sample to count as moving
ENOUGH_ACTIVE = 8  # moving samples after which the search may end …
ENOUGH_SEEN = 12  # … but not before this one
LAST_CHANCE = 60  # samples after which the search ends, or begins anew where nothing looks like a person
NAMES = (
    "template", "rank", "share_reach", "share_body", "density_body", "share_head", "density_head",
    "now_reach", "now_body", "now_density_body", "now_head", "now_density_head",
    "size", "seen_again", "first", "closer",
)  # fmt: skip


class BodyFinder:
    """Collects candidates and motion while frames arrive; :attr:`body` is set when the person is found."""

    def __init__(self) -> None:
        self.body: Body | None = None
        self._begin()

    def _begin(self) -> None:
        """Forget what was seen."""
        self._flat: list[np.ndarray] = []
        self._moved: list[np.ndarray] = []
        self._active = 0
        self._found: list[tuple[int, list[Body], np.ndarray]] = []
        self._pictures: list[np.ndarray] = []
        self._last: Sample | None = None

    def observe(self, sample: Sample) -> None:
        """Take one sample; after the person is found nothing more is done."""
        if self.body is not None:
            return
        number = len(self._moved)
        self._last = sample
        if number % FITTED_EVERY == 0:
            self._pictures.append(sample.grey)
        # Without the local mean, flicker and exposure do not look like motion.
        self._flat.append(sample.small - cv2.blur(sample.small, (15, 15)))
        self._flat = self._flat[-LAG - 1 :]
        self._moved.append((np.abs(self._flat[-1] - self._flat[0]) > MOVED).astype(np.uint8))
        if number in OBSERVED:
            self._search(sample)
        self._active += cv2.countNonZero(self._moved[-1]) > ACTIVE_AREA * self._moved[-1].size
        late = number + 1 >= LAST_CHANCE
        if ((self._active >= ENOUGH_ACTIVE and number + 1 >= ENOUGH_SEEN) or late) and self.decide() is None and late:
            self._begin()

    def _search(self, sample: Sample) -> None:
        self._found.append((len(self._moved) - 1, *self.search(sample.grey)))

    def search(self, grey: np.ndarray) -> tuple[list[Body], np.ndarray]:
        """Return the places that look like a person, and the score of the closer look at each."""
        height, width = grey.shape
        found = best_bodies(score_maps(grey, *template()), (width, height))
        cells = closer_look(grey, found)
        return moved(found, cells, *fit_weights()[0]), closer_score(cells)

    def decide(self) -> Body | None:
        """Choose among the candidates seen so far; None where no place looks like a person.

        Once there is an answer, it stays the same.
        """
        if self.body is None:
            if not self._found and self._last is not None:
                self._search(self._last)
            candidates, table = self.candidates()
            if not candidates:
                return None
            scores = Ranking.load()(table)
            best = int(np.argmax(scores))
            self.body = self._exact(_mean_body(candidates, scores, best))
            self._pictures.clear()
        return self.body

    def _exact(self, body: Body) -> Body:
        """Fit the head in several pictures; the median of them is where it mostly is, and its size."""
        chosen = np.unique(np.linspace(0, len(self._pictures) - 1, FITTED).round().astype(int))
        fits = [fit(self._pictures[k], body) for k in chosen]
        x, y, head = np.median([(b.x, b.y, b.head) for b in fits], axis=0).tolist()
        return Body(x, y, head, body.score)

    def searched(self) -> np.ndarray:
        """Number of the sample, from 0, in which each candidate was found."""
        return np.concatenate([np.full(len(found), number) for number, found, _ in self._found])

    def candidates(self) -> tuple[list[Body], np.ndarray]:
        """Return the candidates and what is known of each, (n, 32).

        Columns are as in NAMES, then the same relative to the highest of the clip: what counts is to be
        more like a person than the rest of the picture.
        """
        bodies = [body for _, found, _ in self._found for body in found]
        if self._last is None or not bodies:
            return [], np.zeros((0, 2 * len(NAMES)))
        height, width = self._last.grey.shape
        scale = self._last.small.shape[1] / width
        numbers = self.searched()
        places = np.array([(b.x, b.y, b.head, b.score) for b in bodies])
        again = np.zeros(len(bodies))
        same = _same(places, places)
        for number, _, _ in self._found:  # seen in other samples, however often in each
            there = numbers == number
            again[~there] += same[np.ix_(~there, there)].any(axis=1)
        whole = cv2.integral(np.mean(self._moved, axis=0).astype(np.float32))
        now = np.empty((len(bodies), 5))
        for number, _, _ in self._found:
            near = np.mean(self._moved[max(0, number - 3) : number + 4], axis=0).astype(np.float32)
            there = numbers == number
            now[there] = _motion(cv2.integral(near), places[there], scale)
        table = np.column_stack(
            [
                places[:, 3],
                np.concatenate([np.arange(len(found)) for _, found, _ in self._found]),
                _motion(whole, places, scale),
                now,
                np.log(places[:, 2] / height),
                again / max(1, len(self._found) - 1),
                numbers == self._found[0][0],
                np.concatenate([closer for _, _, closer in self._found]),
            ]
        )
        return bodies, np.hstack([table, table - table.max(axis=0)])


def _same(some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Which candidates x, y, head … (n, 4) are at the place and of the size of which others (m, 4), (n, m) bool."""
    x, y, head = (some[:, None, i] for i in range(3))
    near = np.hypot(x - others[:, 0], y - others[:, 1]) < 0.5 * others[:, 2]
    alike: np.ndarray = near & (np.abs(np.log(head / others[:, 2])) < 0.3)
    return alike


def _mean_body(candidates: list[Body], scores: np.ndarray, best: int) -> Body:
    """Average the chosen candidate with its sightings on other samples."""
    places = np.array([(b.x, b.y, b.head) for b in candidates])
    x, y, head = places[_same(places, places[best : best + 1])[:, 0]].T
    return Body(float(x.mean()), float(y.mean()), float(np.exp(np.log(head).mean())), float(scores[best]))


def _motion(integral: np.ndarray, places: np.ndarray, scale: float) -> np.ndarray:
    """Share and density of the motion within arm's reach of candidates (n, 3 or more), on body, and on head, (n, 5)."""
    x, y, h = (places[:, i] * scale for i in range(3))
    total = float(integral[-1, -1]) + 1.0
    reach, _ = _box(integral, x - 3.8 * h, y - 3 * h, x + 3.8 * h, y + 5 * h)
    trunk, trunk_area = _box(integral, x - 2 * h, y - h, x + 2 * h, y + 3.5 * h)
    head, head_area = _box(integral, x - 0.5 * h, y - 0.6 * h, x + 0.5 * h, y + 0.6 * h)
    return np.column_stack([reach / total, trunk / total, trunk / trunk_area, head / total, head / head_area])


def _box(
    integral: np.ndarray, x0: np.ndarray, y0: np.ndarray, x1: np.ndarray, y1: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Sums and areas [px] of boxes of an integral image, cut at the border."""
    height, width = integral.shape[0] - 1, integral.shape[1] - 1
    left, right = (np.round(v).clip(0, width).astype(int) for v in (x0, x1))
    top, bottom = (np.round(v).clip(0, height).astype(int) for v in (y0, y1))
    total = integral[bottom, right] - integral[top, right] - integral[bottom, left] + integral[top, left]
    return total, np.maximum(1.0, (right - left) * (bottom - top))
