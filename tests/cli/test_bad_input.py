"""Bad input gets one line that names the thing and the mend, an exit code, and leaves nothing behind."""

from __future__ import annotations

import errno
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from nao_sim.episodes import store
from tests.cli.conftest import Ran

Run = Callable[..., Ran]


def write_video(path: Path, frames: int, size: tuple[int, int] = (160, 120), fps: float = 20.0) -> Path:
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), fps, size)
    rng = np.random.default_rng(1)
    for _ in range(frames):
        writer.write(rng.integers(0, 255, (size[1], size[0], 3), dtype=np.uint8))
    writer.release()
    return path


def missing(folder: Path) -> Path:
    return folder / "missing.avi"


def a_folder(folder: Path) -> Path:
    (folder / "clips").mkdir()
    return folder / "clips"


def empty(folder: Path) -> Path:
    (folder / "empty.avi").touch()
    return folder / "empty.avi"


def text(folder: Path) -> Path:
    (folder / "notes.mp4").write_text("not a video\n" * 1000)
    return folder / "notes.mp4"


def header_only(folder: Path) -> Path:
    whole = write_video(folder / "whole.avi", 30)
    (folder / "cut.avi").write_bytes(whole.read_bytes()[:300])
    whole.unlink()
    return folder / "cut.avi"


def one_frame(folder: Path) -> Path:
    return write_video(folder / "one.avi", 1)


def three_frames(folder: Path) -> Path:
    return write_video(folder / "three.avi", 3)


def sixteen_pixels(folder: Path) -> Path:
    return write_video(folder / "tiny.avi", 30, size=(16, 16))


@pytest.mark.parametrize(
    "make",
    [missing, a_folder, empty, text, header_only, one_frame, three_frames, sixteen_pixels],
    ids=lambda f: f.__name__,
)
def test_unusable_clip(nao_sim: Run, tmp_path: Path, make: Callable[[Path], Path]) -> None:
    clip = make(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    ran = nao_sim("imitate", clip, "--out", tmp_path / "episode")
    assert ran.code == 2
    assert ran.out == ""
    assert ran.err.count("\n") == 1, ran.err
    assert ran.err.startswith("nao-sim: ")
    assert clip.name in ran.err
    assert sorted(tmp_path.rglob("*")) == before


def test_nothing_but_the_line_reaches_the_terminal(tmp_path: Path) -> None:
    command = [sys.executable, "-c", "from nao_sim.cli import main; main()", "imitate", str(text(tmp_path))]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (ran.returncode, ran.stdout) == (2, "")
    assert ran.stderr.count("\n") == 1, ran.stderr
    assert "notes.mp4" in ran.stderr


def test_a_place_that_the_system_refuses_is_named(nao_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    ran = nao_sim("film", "--out", tmp_path / "file" / "set", "--persons", 1, "--takes", 1)
    assert ran.code == 2
    assert ran.err.count("\n") == 1
    assert "choose another place" in ran.err


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--frames", "six"], "FIRST:LAST"),
        (["--frames", "9:3"], "9:3"),
        (["--frames", "9000:"], "9000"),
        (["--among", "dance"], "dance"),
    ],
)
def test_unusable_options(nao_sim: Run, tmp_path: Path, sample_clips: Path, options: list[str], said: str) -> None:
    ran = nao_sim("imitate", sample_clips / "bye_right.avi", "--out", tmp_path / "episode", *options)
    assert (ran.code, ran.err.count("\n")) == (2, 1)
    assert said in ran.err
    assert list(tmp_path.iterdir()) == []


def test_output_place_is_checked_before_the_work(nao_sim: Run, tmp_path: Path, sample_clips: Path) -> None:
    (tmp_path / "taken").write_text("mine")
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").touch()
    for out in ("taken", "full", "taken/deeper"):
        ran = nao_sim("imitate", sample_clips / "bye_right.avi", "--out", tmp_path / out)
        assert (ran.code, ran.err.count("\n")) == (2, 1)
        assert "--out" in ran.err
    assert (tmp_path / "taken").read_text() == "mine"
    assert (tmp_path / "full" / "mine.txt").exists()


def test_a_disk_that_fills_up_leaves_nothing(
    nao_sim: Run, tmp_path: Path, sample_clips: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(store, "write_table", full)
    ran = nao_sim("imitate", sample_clips / "bye_right.avi", "--out", tmp_path / "episode")
    assert ran.code == 2
    assert "No space left" in ran.err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("words", "option"),
    [
        ("train set --out d.parquet --jobs 0", "--jobs"),
        ("evaluate d.parquet --jobs 0", "--jobs"),
        ("film --out set --persons 1 --takes 1 --seed 1 --processes -1", "--processes"),
    ],
)
def test_too_few_processes_are_refused_before_anything_is_done(
    nao_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: str, option: str
) -> None:
    monkeypatch.chdir(tmp_path)
    ran = nao_sim(*words.split())
    assert ran.code == 2
    assert option in ran.err
    assert list(tmp_path.iterdir()) == []
