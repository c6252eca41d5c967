import errno
from pathlib import Path

import pytest

from nao_sim.episodes.errors import EpisodeError
from nao_sim.episodes.folder import complete_folder


def interrupted(out: Path) -> None:
    with complete_folder(out, "episode.json") as work:
        (work / "episode.json").write_text("lost")
        raise KeyboardInterrupt


def test_folder_appears_only_when_complete(tmp_path: Path) -> None:
    out = tmp_path / "new" / "episode"
    with complete_folder(out, "episode.json") as work:
        (work / "episode.json").write_text("{}")
        assert not out.exists()
    assert (out / "episode.json").read_text() == "{}"
    assert [p.name for p in out.parent.iterdir()] == ["episode"]


def test_an_older_episode_is_replaced_whole(tmp_path: Path) -> None:
    out = tmp_path / "episode"
    for text in ("first", "second"):
        with complete_folder(out, "episode.json") as work:
            (work / "episode.json").write_text(text)
            (work / text).touch()
    assert (out / "episode.json").read_text() == "second"
    assert {p.name for p in out.iterdir()} == {"episode.json", "second"}


def test_an_interrupted_one_leaves_the_older_untouched(tmp_path: Path) -> None:
    out = tmp_path / "episode"
    with complete_folder(out, "episode.json") as work:
        (work / "episode.json").write_text("kept")
    with pytest.raises(KeyboardInterrupt):
        interrupted(out)
    assert (out / "episode.json").read_text() == "kept"
    assert [p.name for p in tmp_path.iterdir()] == ["episode"]


def test_other_peoples_files_are_not_replaced(tmp_path: Path) -> None:
    (tmp_path / "thesis.doc").touch()
    with pytest.raises(EpisodeError, match="holds other files"), complete_folder(tmp_path, "episode.json"):
        pass
    assert (tmp_path / "thesis.doc").exists()


def test_a_file_in_the_way_is_named(tmp_path: Path) -> None:
    (tmp_path / "out").touch()
    with pytest.raises(EpisodeError, match="out is a file"), complete_folder(tmp_path / "out", "episode.json"):
        pass
    with pytest.raises(EpisodeError, match="cannot be written"), complete_folder(tmp_path / "out" / "deeper", "x"):
        pass


def test_a_full_disk_is_said_and_nothing_is_left(tmp_path: Path) -> None:
    with pytest.raises(EpisodeError, match=r"No space left.*free some space"), complete_folder(tmp_path / "e", "x"):
        raise OSError(errno.ENOSPC, "No space left on device")
    assert list(tmp_path.iterdir()) == []
