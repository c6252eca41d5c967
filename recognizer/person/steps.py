"""What each sample shows of the person, in windows of their own size: flow in head heights per second."""

from __future__ import annotations

import dataclasses

import numpy as np

from recognizer.motion.flow_pyramid import coarse_to_fine
from recognizer.person.head_follower import displacement
from recognizer.person.head_shoulders import Body
from recognizer.person.view import GRID_X, GRID_Y, HEAD, POSE, WHOLE, cell_means, cut_window, even_contrast, in_view
from recognizer.video.samples import Sample

STILL = 0.35  # head heights per second: slower is sway or noise
_CHEST = (np.abs(GRID_X) < 0.7) & (GRID_Y > 1.3) & (GRID_Y < 3.0)
_TORSO = (_CHEST / _CHEST.sum()).ravel().astype(np.float32)


@dataclasses.dataclass(frozen=True)
class Step:
    """What one sample shows of the person since the sample before.

    Attributes:
        time: seconds.
        seconds: since the sample before.
        picture: (64, 80) float32, the window with its contrast evened out.
        flow: (2, 64, 80) velocity right and down in the window WHOLE [head heights per second], 0 where slower
            than STILL and beyond the image's border.
        speed: (64, 80) its magnitude.
        ways: (4, 8, 10) motion right, left, down and up, mean over cells of one head height.
        torso: (2,) mean velocity of chest and belly, slow motion included.
        head_flow: (2, 42, 42) velocity in the window HEAD, which follows the head, slow motion included.
        pose: (88, 112) uint8, the window POSE as the camera saw it.
        place: (2,) of the head, right and down from the person's place [head heights].
    """

    time: float
    seconds: float
    picture: np.ndarray
    flow: np.ndarray
    speed: np.ndarray
    ways: np.ndarray
    torso: np.ndarray
    head_flow: np.ndarray
    pose: np.ndarray
    place: np.ndarray


class Windows:
    """Turns samples into steps, one by one, once the body is known."""

    def __init__(self, body: Body) -> None:
        self.body = body
        self._before: tuple[float, np.ndarray, np.ndarray, Body] | None = None
        self._inside: np.ndarray | None = None

    def push(self, sample: Sample, head: Body) -> Step | None:
        """Take the next sample, in which the head is at ``head``; the first gives no step."""
        whole = even_contrast(cut_window(sample.grey, self.body, WHOLE), WHOLE.pixels / 2)
        face = even_contrast(cut_window(sample.grey, head, HEAD), HEAD.pixels / 4)
        before, self._before = self._before, (sample.time, whole, face, head)
        if before is None or self._inside is None:
            self._inside = in_view(self.body, sample.grey.shape)
            return None
        seconds = sample.time - before[0]
        flow = np.stack(coarse_to_fine(before[1], whole)) * (self._inside / np.float32(WHOLE.pixels * seconds))
        head_flow = np.stack(coarse_to_fine(before[2], face)) / np.float32(HEAD.pixels)
        head_flow += displacement(before[3], head)[:, None, None]  # the window's own way
        pose = cut_window(sample.grey, self.body, POSE).astype(np.uint8)
        place = displacement(self.body, head)
        return make_step(sample.time, seconds, whole, flow, head_flow / np.float32(seconds), pose, place)


def make_step(
    time: float,
    seconds: float,
    picture: np.ndarray,
    flow: np.ndarray,
    head_flow: np.ndarray,
    pose: np.ndarray,
    place: np.ndarray,
) -> Step:
    """Work out the rest of a step from its flow, as it is measured."""
    speed = np.sqrt(flow[0] * flow[0] + flow[1] * flow[1])
    torso = flow.reshape(2, -1) @ _TORSO
    moving = (speed > STILL).astype(np.float32)
    flow, speed = flow * moving, speed * moving
    ways = np.stack([np.maximum(f, 0) for f in (flow[0], -flow[0], flow[1], -flow[1])])
    return Step(time, seconds, picture, flow, speed, cell_means(ways), torso, head_flow, pose, place)
