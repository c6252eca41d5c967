"""Files are whole or not there, and a full disk is one line."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from nao_sim.files import FileError, whole_file
from nao_sim.pictures import write_picture


def test_a_file_is_whole_or_not_there(tmp_path: Path) -> None:
    path = tmp_path / "a [b].txt"
    path.write_text("old")
    with pytest.raises(TypeError), whole_file(path) as beside:
        beside.write_text("half")[0]  # type: ignore[index]
    assert [p.read_text() for p in tmp_path.iterdir()] == ["old"]
    with whole_file(path) as beside:
        beside.write_text("new")
    assert [p.read_text() for p in tmp_path.iterdir()] == ["new"]
    with (
        pytest.raises(FileError, match=r"cannot be written \(No such file or directory\)"),
        whole_file(tmp_path / "none" / "x") as beside,
    ):
        beside.write_text("x")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full to write to")
def test_a_full_disk_is_told_and_leaves_what_was(tmp_path: Path) -> None:
    path = tmp_path / "sheet.png"
    path.write_bytes(b"old")
    (tmp_path / ".sheet.part.png").symlink_to("/dev/full")
    with pytest.raises(FileError, match=r"sheet\.png cannot be written \(No space left on device\)"):
        write_picture(path, np.zeros((50, 50, 3), np.uint8))
    assert [p.read_bytes() for p in tmp_path.iterdir()] == [b"old"]


@pytest.mark.parametrize("name", ["sheet.txt", "sheet", "sheet.xyz"])
def test_what_is_no_picture_is_told(tmp_path: Path, name: str) -> None:
    with pytest.raises(FileError, match="is no picture format"):
        write_picture(tmp_path / name, np.zeros((5, 5, 3), np.uint8))
    assert list(tmp_path.iterdir()) == []


def test_a_film_that_does_not_fit_is_told(tmp_path: Path, gl: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """OpenCV's writer says nothing of a full disk: one that stops writing on the way stands for it here."""
    from nao_sim.episodes import EpisodeError
    from nao_sim.episodes.film_robot import film_robot
    from nao_sim.motion import Trajectory, perform
    from nao_sim.robot import Nao

    class Full:
        fourcc = staticmethod(cv2.VideoWriter.fourcc)

        def __init__(self, path: str, *_: object) -> None:
            Path(path).write_bytes(b"\0" * 4096)

        def isOpened(self) -> bool:
            return True

        def write(self, _: object) -> None: ...

        def release(self) -> None: ...

    with Nao() as nao:
        log = perform(nao, Trajectory(np.zeros(1), nao.setpoint[None]), settle_s=0.2)
        film_robot(nao.model, log, tmp_path / "good.mp4", (64, 64))
        monkeypatch.setattr(cv2, "VideoWriter", Full)
        with pytest.raises(EpisodeError, match="could not be written whole; is the disk full"):
            film_robot(nao.model, log, tmp_path / "bad.mp4", (64, 64))
    assert [path.name for path in tmp_path.iterdir()] == ["good.mp4"]
