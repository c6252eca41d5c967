from __future__ import annotations

import math
from pathlib import Path

import cv2
import numpy as np
import pytest

from recognizer import Clip, ClipError, open_clip, parse_frame_range
from recognizer.video.clip import MAX_SIDE, _plausible_fps


def write_video(path: Path, frames: list[np.ndarray], fps: float = 20.0) -> Path:
    height, width = frames[0].shape[:2]
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), fps, (width, height))
    for frame in frames:
        writer.write(frame)
    writer.release()
    return path


def counting(n: int, width: int = 64, height: int = 48) -> list[np.ndarray]:
    return [np.full((height, width, 3), 5 * i, np.uint8) for i in range(n)]


def test_frames_come_in_order_and_again(tmp_path: Path) -> None:
    clip = open_clip(write_video(tmp_path / "a.avi", counting(20)))
    assert clip.fps == 20
    assert clip.size == (64, 48)
    assert clip.frame_count == 20
    for _ in range(2):
        levels = [round(float(frame.mean()) / 5) for frame in clip]
        assert levels == list(range(20))


def test_small_motion_jpeg_is_decoded_by_one_thread_and_all_else_as_ffmpeg_likes(tmp_path: Path) -> None:
    assert open_clip(write_video(tmp_path / "small.avi", counting(3))).threads == 1
    assert open_clip(write_video(tmp_path / "large.avi", counting(3, 1280, 720))).threads == 0


def test_a_range_has_both_its_ends(tmp_path: Path) -> None:
    path = write_video(tmp_path / "a.avi", counting(20))
    assert [round(float(f.mean()) / 5) for f in open_clip(path, (6, 9))] == [6, 7, 8, 9]
    assert len(list(open_clip(path, (15, None)))) == 5
    assert len(list(open_clip(path, (15, 99)))) == 5


@pytest.mark.parametrize(("text", "expected"), [("6:44", (6, 44)), (":44", (0, 44)), ("48:", (48, None))])
def test_ranges_are_read(text: str, expected: tuple[int, int | None]) -> None:
    assert parse_frame_range(text) == expected


@pytest.mark.parametrize("text", ["", "6", "a:b", "-3:5", "1:2:3"])
def test_odd_ranges_are_refused(text: str) -> None:
    with pytest.raises(ClipError, match="FIRST:LAST"):
        parse_frame_range(text)


def test_bad_places_are_named(tmp_path: Path) -> None:
    (tmp_path / "empty.avi").touch()
    (tmp_path / "text.avi").write_text("no video " * 100)
    (tmp_path / "noise.mp4").write_bytes(np.random.default_rng(0).bytes(5000))
    (tmp_path / "photo.jpg").write_text("no photo")
    (tmp_path / "void.png").write_bytes(b"")
    for name, words in {
        "absent.avi": "no such file",
        ".": "is a folder",
        "empty.avi": "is empty",
        "text.avi": "not a video|no frame",
        "noise.mp4": "not a video|no frame",
        "photo.jpg": "not a photo",
        "void.png": "is empty",
    }.items():
        with pytest.raises(ClipError, match=words) as caught:
            open_clip(tmp_path / name)
        assert "\n" not in str(caught.value)


def test_a_truncated_video_is_read_as_far_as_it_goes_or_refused(tmp_path: Path) -> None:
    whole = write_video(
        tmp_path / "whole.avi", [np.random.default_rng(i).integers(0, 255, (48, 64, 3), np.uint8) for i in range(30)]
    )
    data = whole.read_bytes()
    for share in (0.02, 0.5, 0.9):
        cut = tmp_path / "cut.avi"
        cut.write_bytes(data[: int(len(data) * share)])
        assert frames_or_refusal(cut) <= 30


def frames_or_refusal(path: Path) -> int:
    """Number of frames; 0 when the file is refused, which it must be by name."""
    try:
        return len(list(open_clip(path)))
    except ClipError as error:
        return 0 if path.name in str(error) else 999


def test_a_range_beyond_the_end_is_refused(tmp_path: Path) -> None:
    path = write_video(tmp_path / "a.avi", counting(10))
    with pytest.raises(ClipError, match="10 frames"):
        open_clip(path, (10, 12))
    with pytest.raises(ClipError, match="not after"):
        open_clip(path, (5, 4))


def test_tiny_frames_are_refused_and_huge_ones_scaled(tmp_path: Path) -> None:
    with pytest.raises(ClipError, match="16×16"):
        open_clip(write_video(tmp_path / "tiny.avi", counting(5, 16, 16)))
    clip = open_clip(write_video(tmp_path / "huge.avi", counting(2, 7680, 4320)))
    assert clip.size == (MAX_SIDE, 360)
    assert next(iter(clip)).shape == (360, MAX_SIDE, 3)


@pytest.mark.parametrize("fps", [0.0, -5.0, 90000.0, 1e9, math.nan, math.inf])
def test_impossible_frame_rates_are_replaced_and_said(fps: float) -> None:
    rate, warnings = _plausible_fps(fps)
    assert rate == 25
    assert len(warnings) == 1


@pytest.mark.parametrize("channels", [1, 3, 4])
def test_photos_of_any_kind_are_colour_stills(tmp_path: Path, channels: int) -> None:
    image = np.random.default_rng(0).integers(0, 255, (50, 60, channels), np.uint8)
    cv2.imwrite(str(tmp_path / "p.png"), image)
    clip = open_clip(tmp_path / "p.png")
    assert clip.still
    assert [frame.shape for frame in clip] == [(50, 60, 3)]


@pytest.mark.parametrize("shape", [(4, 48, 64), (4, 48, 64, 1), (4, 48, 64, 3), (4, 48, 64, 4)])
def test_arrays_of_any_kind_become_colour(shape: tuple[int, ...]) -> None:
    clip = Clip.from_array(np.zeros(shape, np.uint8), 25)
    assert [frame.shape for frame in clip] == [(48, 64, 3)] * 4


@pytest.mark.parametrize(
    "frames", [[], np.zeros((3, 48, 64, 3)), [np.zeros((48, 64, 3), np.uint8), np.zeros((4, 6, 3), np.uint8)]]
)
def test_arrays_that_are_no_frames_are_refused(frames: object) -> None:
    with pytest.raises(ClipError):
        Clip.from_array(frames, 25)  # type: ignore[arg-type]
