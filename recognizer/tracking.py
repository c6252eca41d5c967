"""What is measured on a clip while its frames arrive, and what every method reads when it has ended."""

from __future__ import annotations

from collections import deque

import numpy as np

from recognizer.errors import ClipError
from recognizer.features.network_features import MotionWatch
from recognizer.features.step_history import Steps
from recognizer.motion.flow import horn_schunck
from recognizer.motion.moving_regions import MovingRegions, moving_regions
from recognizer.person.body_finder import BodyFinder
from recognizer.person.head_follower import HeadFollower
from recognizer.person.head_motion import HeadMotion
from recognizer.person.head_shoulders import Body
from recognizer.person.steps import Windows
from recognizer.video.clip import Clip
from recognizer.video.samples import LOOKS, RATE, Sample, Sampler
from recognizer.video.scene import Scene

MIN_SAMPLES = 6  # six key frames make the five states of a large gesture
FLOW_ITERATIONS = 20  # few, because each flow begins with the one before
ALPHA = 8.0
CATCH_UP = 3  # samples worked off per new one, once the body is found


class Track:
    """Samples, flow, moving regions and the person's window of a clip, frame by frame.

    Args:
        fps: frames per second; None when every frame comes with its time.
        first_index: number of the first frame in its source.
        source: name for messages.
        find_body: follow the person's window as well; the thesis's method does without.
        mirrored: let the network watch the mirrored clip, too, for a row that will stand for both.

    Attributes:
        regions: moving regions of each kept sample but the first of the clip.
        scene: watches for a moving camera, cuts and no motion at all.
        steps: what the person's window shows; see :meth:`end`.
    """

    def __init__(
        self,
        fps: float | None,
        first_index: int = 0,
        source: str = "stream",
        find_body: bool = True,
        mirrored: bool = False,
    ) -> None:
        self.source = source
        self.sampler = Sampler(fps, first_index)
        kept = self.sampler.kept
        self.regions: deque[MovingRegions] = deque(maxlen=kept - 1)  # one between two samples
        self.steps = Steps(kept)
        self._waiting: deque[Sample] = deque(maxlen=kept)
        self._finder = BodyFinder() if find_body else None
        self._windows: Windows | None = None
        self._follower: HeadFollower | None = None
        self._head = HeadMotion()
        self._head_rows: deque[np.ndarray] = deque(maxlen=kept * LOOKS)
        self._watch = MotionWatch(kept, mirrored) if find_body else None
        self.scene = Scene()
        self._first_time = 0.0
        self._flow: tuple[np.ndarray, np.ndarray] | None = None
        self._before: Sample | None = None

    @property
    def samples(self) -> list[Sample]:
        """The samples kept, in order."""
        return list(self.sampler.samples)

    @property
    def body(self) -> Body | None:
        """Place and size of the person [px of the samples' pictures], None where no place looks like one.

        Decided now if it was not yet.
        """
        return None if self._finder is None else self._finder.decide()

    @property
    def whole(self) -> bool:
        """Whether every sample of the clip is still kept."""
        return bool(self.sampler.samples) and self.sampler.samples[0].time == self._first_time

    @property
    def head_motion(self) -> np.ndarray:
        """(n, 17) how the head moved, at the camera's own rate; rows of :class:`HeadMotion`."""
        return np.array(self._head_rows)

    @property
    def motion(self) -> np.ndarray:
        """(2, 128) what the network sees in the clip, and in the mirrored one if asked; see :class:`MotionWatch`."""
        assert self._watch is not None
        return self._watch.features

    def push(self, frame: np.ndarray, time: float | None = None) -> None:
        """Take one frame, (h, w, 3) uint8 BGR, all of one size.

        Args:
            frame: the picture.
            time: seconds from the first frame; None at a steady rate.

        Raises:
            ClipError: the frame has another size than those before.
        """
        for sample in self.sampler.feed(frame, time):
            self.take(sample)

    def push_sample(self, sample: Sample) -> None:
        """Take a sample that another track has made of a frame."""
        self.sampler.samples.append(sample)
        self.sampler.pushed = sample.index + 1 - self.sampler.first_index
        self.take(sample)

    def take(self, sample: Sample) -> None:
        """Measure the next sample of :attr:`sampler`; what :meth:`push` does with each."""
        before, self._before = self._before, sample
        if before is None:
            self._first_time = sample.time
        self.scene.observe(sample)
        if before is not None:
            if before.grey.shape != sample.grey.shape:
                raise ClipError(f"{self.source} changes its frame size on the way; convert it to one size")
            self._flow = horn_schunck(before.small, sample.small, ALPHA, FLOW_ITERATIONS, self._flow)
            self.regions.append(moving_regions(*self._flow, sample.time, sample.time - before.time))
            self.scene.observe_motion(self.regions[-1].area, self.regions[-1].sides)
            if self.scene.cut:
                self._flow = None  # across a cut it means nothing, and nothing may begin with it
        if self._finder is not None:
            self._waiting.append(sample)
            self._finder.observe(sample)
            if self._finder.body is not None:
                self._work_off()

    def _work_off(self) -> None:
        """Measure a few of the samples that have waited for the person to be found."""
        assert self._watch is not None
        if self._windows is None or self._follower is None:
            body = self.body
            assert body is not None
            self._windows, self._follower = Windows(body), HeadFollower(body)
        taken = []
        for _ in range(min(CATCH_UP, len(self._waiting))):
            sample = self._waiting.popleft()
            head = self._follower.push(sample.grey)
            self._head_rows.extend(self._head.push(sample.looks, head))
            step = self._windows.push(sample, head)
            if step is not None:
                self.steps.append(step)
                taken.append(step)
        self._watch.push(taken)

    def end(self) -> None:
        """Finish what is pending; call it after the last frame.

        Raises:
            ClipError: too few frames for a gesture.
        """
        n = len(self.sampler.samples)
        if n < MIN_SAMPLES:
            need = MIN_SAMPLES / min(self.sampler.fps or RATE, RATE)
            raise ClipError(
                f"{self.source} has {self.sampler.pushed} frames, too short for a gesture; film {need:.1f} s or more"
            )
        if self.body is not None:
            while self._waiting:
                self._work_off()


def track_clip(clip: Clip, find_body: bool = True, mirrored: bool = False) -> Track:
    """Run all frames of a clip through a :class:`Track`; arguments as there.

    Raises:
        ClipError: the clip cannot be read or is too short.
    """
    track = Track(clip.fps, clip.frames[0], clip.source, find_body, mirrored)
    for time, frame in clip.timed():
        track.push(frame, time)
    track.end()
    return track
