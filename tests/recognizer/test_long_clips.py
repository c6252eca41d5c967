"""Clips of any length and rate: there is an answer, in the clip's own time, and it says which part it is about."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import av
import cv2
import numpy as np
import pytest

from nao_sim.episodes import imitate
from nao_sim.resources import resource
from recognizer import Clip, ClipError, DatabaseError, Recognizer, RecognizerError, open_clip


@pytest.fixture(scope="module")
def recognizer() -> Recognizer:
    return Recognizer.load(resource("assets", "databases", "dynamic.parquet"))


def frames_of(name: str) -> list[np.ndarray]:
    return list(open_clip(resource("assets", "clips", f"{name}.avi")))


def resting(frame: np.ndarray, count: int, seed: int = 0) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    return [(frame + rng.normal(0, 1.5, frame.shape)).clip(0, 255).astype(np.uint8) for _ in range(count)]


def write_at(path: Path, frames: list[np.ndarray], times: list[float]) -> Path:
    """A video whose frames stand at these times [s], whatever they are."""
    with av.open(str(path), "w") as container:
        stream = container.add_stream("libx264", rate=30, options={"crf": "12", "bf": "0"})
        stream.height, stream.width = frames[0].shape[:2]
        stream.pix_fmt = "yuv420p"
        stream.time_base = stream.codec_context.time_base = Fraction(1, 1000)
        for frame, time in zip(frames, times, strict=True):
            picture = av.VideoFrame.from_ndarray(np.ascontiguousarray(frame), format="bgr24")
            picture.pts, picture.time_base = round(1000 * time), Fraction(1, 1000)
            container.mux(stream.encode(picture))
        container.mux(stream.encode())
    return path


@pytest.mark.parametrize("name", ["bye_right", "kowtow", "right_arm_up"])
@pytest.mark.parametrize("rest_s", [9, 12, 20])
def test_one_gesture_before_rest_is_named_and_its_part_is_said(recognizer: Recognizer, name: str, rest_s: int) -> None:
    frames = frames_of(name)
    answer = recognizer.recognize(Clip.from_array([*frames, *resting(frames[-1], 10 * rest_s)], 10))
    assert answer.label == name
    assert answer.watched.frames == len(frames) + 10 * rest_s
    assert answer.watched.seconds == pytest.approx(answer.watched.frames / 10)
    told = any("--all" in warning for warning in answer.warnings)
    assert told == (answer.end < 5)  # the whole clip, or the movement alone, and then it says so
    assert rest_s < 12 or told


def test_the_first_gesture_of_several_is_the_answer(recognizer: Recognizer) -> None:
    wave, up = frames_of("bye_right"), frames_of("right_arm_up")
    up = [cv2.resize(frame, wave[0].shape[1::-1]) for frame in up]
    session = [*wave, *resting(wave[-1], 50), *up, *resting(up[-1], 60)]
    clip = Clip.from_array(session, 10)
    answer = recognizer.recognize(clip)
    assert answer.label == "bye_right"
    assert any("movements" in warning and "--all" in warning for warning in answer.warnings)
    everything = recognizer.recognize_all(clip)
    assert next(a.label for a in everything if not a.rejected) == "bye_right"
    assert recognizer.recognize(clip, among="right_arm_up").label in (None, "right_arm_up")


@pytest.mark.parametrize("value", [0, 127, 255])
@pytest.mark.parametrize("seconds", [2, 15])
def test_a_flat_picture_is_rejected(recognizer: Recognizer, value: int, seconds: int) -> None:
    flat = np.full((10 * seconds, 120, 160, 3), value, np.uint8)
    answer = recognizer.recognize(Clip.from_array(flat, 10))
    assert answer.rejected
    assert answer.label is None
    assert answer.reason
    assert answer.to_dict()["threshold"] is None or answer.nearest


def test_flashing_is_rejected(recognizer: Recognizer) -> None:
    flashing = np.full((40, 120, 160, 3), 0, np.uint8)
    flashing[::2] = 255
    assert recognizer.recognize(Clip.from_array(flashing, 10)).rejected


def test_darkness_before_somebody_comes_does_not_end_the_search(recognizer: Recognizer) -> None:
    wave = frames_of("bye_right")
    dark = [np.zeros_like(wave[0])] * 300
    answer = recognizer.recognize(Clip.from_array([*dark, *wave, *resting(wave[-1], 20)], 10))
    assert answer.label == "bye_right"
    assert answer.start >= 29.5
    stream = recognizer.stream(10)
    for frame in [*dark, *wave]:
        stream.push(frame)
    assert stream.finish().nearest  # somebody was found in the end


@pytest.mark.parametrize("fps", [120, 240, 1000])
def test_high_rates_are_the_clips_own(recognizer: Recognizer, tmp_path: Path, fps: int) -> None:
    path = tmp_path / "fast.avi"
    wave = frames_of("bye_right")
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), fps, wave[0].shape[1::-1])
    for frame in wave:
        for _ in range(fps // 10):
            writer.write(frame)
    writer.release()
    answer = recognizer.recognize(path)
    assert answer.label == "bye_right"
    assert answer.watched.seconds == pytest.approx(2.4, abs=0.02)
    assert not answer.warnings


@pytest.mark.parametrize("name", ["yes", "bye_right", "stop"])
def test_frames_only_where_something_changes_answer_as_an_even_file_does(
    recognizer: Recognizer, tmp_path: Path, name: str
) -> None:
    frames = [cv2.resize(frame, (320, 240)) for frame in frames_of(name)]
    times = [4 + k / 10 for k in range(len(frames))]
    even = write_at(tmp_path / "even.mp4", [frames[0]] * 40 + frames, [k / 10 for k in range(40 + len(frames))])
    uneven = write_at(tmp_path / "uneven.mp4", [frames[0], *frames], [0.0, *times])
    a, b = (recognizer.recognize_all(path) for path in (even, uneven))
    assert [x.label for x in a] == [x.label for x in b]
    assert np.allclose([(x.start, x.end) for x in a], [(x.start, x.end) for x in b], atol=0.11)
    assert recognizer.recognize(even).label == recognizer.recognize(uneven).label


def test_a_phones_jitter_changes_nothing(recognizer: Recognizer, tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    frames = [cv2.resize(frame, (320, 240)) for frame in frames_of("bye_right")]
    thrice = [frame for frame in frames for _ in range(3)]
    times = np.cumsum(rng.uniform(0.02, 0.047, len(thrice)))
    answer = recognizer.recognize(write_at(tmp_path / "phone.mp4", thrice, times.tolist()))
    assert answer.label == "bye_right"
    assert answer.watched.seconds == pytest.approx(times[-1] - times[0], abs=0.1)


def test_a_name_with_a_colon_is_a_file(recognizer: Recognizer, tmp_path: Path) -> None:
    path = tmp_path / "rec:1.avi"
    path.write_bytes(resource("assets", "clips", "bye_right.avi").read_bytes())
    assert recognizer.recognize(path).label == "bye_right"


def test_an_episode_of_a_long_clip_is_made(tmp_path: Path) -> None:
    from nao_sim.episodes import save_episode

    frames = frames_of("bye_right")
    path = tmp_path / "long.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10, frames[0].shape[1::-1])
    for frame in [*frames, *resting(frames[-1], 97)]:  # 12.1 s
        writer.write(frame)
    writer.release()
    episode, nao = imitate(path)
    assert episode.answer.gesture == "bye_right"
    assert episode.watched_s == pytest.approx(12.1)
    save_episode(tmp_path / "episode", episode, nao)
    assert (tmp_path / "episode" / "episode.rrd").stat().st_size > 0


class TestStreams:
    """What cameras and arrays give."""

    def test_a_camera_that_knows_no_rate_gives_times(self, recognizer: Recognizer) -> None:
        stream = recognizer.stream(fps=0)
        with pytest.raises(ClipError, match="no frame rate"):
            stream.push(np.zeros((120, 160, 3), np.uint8))
        for number, frame in enumerate(frames_of("bye_right")):
            stream.push(frame, 1_700_000_000.0 + number / 10)
        answer = stream.finish("bye_right")
        assert answer.label == "bye_right"
        assert answer.end == pytest.approx(2.3)

    @pytest.mark.parametrize("fps", [float("nan"), float("inf"), -3.0])
    def test_rates_that_cannot_be_are_refused(self, recognizer: Recognizer, fps: float) -> None:
        with pytest.raises(ClipError, match="frames/s"):
            recognizer.stream(fps)

    @pytest.mark.parametrize("channels", [None, 1, 4])
    def test_grey_frames_are_pictures_too(self, recognizer: Recognizer, channels: int | None) -> None:
        stream = recognizer.stream(10)
        for frame in frames_of("bye_two_hands"):
            grey = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
            stream.push(grey if channels is None else np.stack([grey] * channels, axis=-1))
        assert stream.finish().label == "bye_two_hands"

    @pytest.mark.parametrize(
        "frame",
        [
            np.zeros((120, 160, 3), np.uint16),
            np.zeros((120, 160, 3)),
            np.zeros((120, 160, 2), np.uint8),
            np.zeros(9, np.uint8),
            np.zeros((4, 4, 3), np.uint8),
            "frame",
        ],
    )
    def test_what_is_no_picture_is_refused_in_words(self, recognizer: Recognizer, frame: object) -> None:
        with pytest.raises(ClipError, match=r"frame|px"):
            recognizer.stream(10).push(frame)  # type: ignore[arg-type]

    def test_a_context_is_checked(self, recognizer: Recognizer) -> None:
        stream = recognizer.stream(10)
        for frame in frames_of("yes"):
            stream.push(frame)
        assert stream.finish(among="yes").label == "yes"
        for wrong in ({"nod"}, "nod", set(), []):
            with pytest.raises(DatabaseError, match="known"):
                stream.finish(among=wrong)

    def test_a_vector_that_holds_no_numbers_has_no_answer(self, recognizer: Recognizer) -> None:
        with pytest.raises(RecognizerError, match="finite"):
            recognizer.decide(np.full(len(recognizer.method.names), np.nan))


def test_the_clip_says_how_long_it_is() -> None:
    assert Clip.from_array(np.zeros((20, 40, 40, 3), np.uint8), 10).seconds == 2.0
