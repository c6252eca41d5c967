"""A command that is stopped or killed ends in one line, and leaves nobody and nothing behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from nao_sim.episodes.folder import complete_folder
from nao_sim.processes import alive

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals are POSIX's")

WORKING = """
import sys, time
import joblib
from concurrent.futures import ProcessPoolExecutor
import multiprocessing
from nao_sim.processes import end_with_parent, joblib_workers
import os

def work(seconds):
    print(os.getpid(), flush=True)
    time.sleep(seconds)

if __name__ == "__main__":
    if sys.argv[1] == "joblib":
        with joblib_workers():
            joblib.Parallel(2)(joblib.delayed(work)(60) for _ in range(2))
    else:
        spawn = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(2, mp_context=spawn, initializer=end_with_parent, initargs=(os.getpid(),)) as pool:
            list(pool.map(work, [60, 60]))
"""


def _gone(pids: list[int], seconds: float) -> bool:
    end = time.monotonic() + seconds
    while any(map(alive, pids)) and time.monotonic() < end:
        time.sleep(0.1)
    return not any(map(alive, pids))


@pytest.mark.parametrize("pool", ["joblib", "pool"])
def test_workers_end_with_a_parent_that_is_killed(tmp_path: Path, pool: str) -> None:
    script = tmp_path / "working.py"
    script.write_text(WORKING)
    with subprocess.Popen([sys.executable, str(script), pool], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        workers = [int(parent.stdout.readline()) for _ in range(2)]
        parent.kill()
    assert _gone(workers, 30)


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_command_that_is_stopped_says_so_in_one_line(tmp_path: Path, number: signal.Signals, code: int) -> None:
    command = [sys.executable, "-m", "nao_sim", "stress", "yes", "--trials", "100000", "--no-sweep"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True, "cwd": tmp_path}
    with subprocess.Popen(command, **quiet) as running:  # type: ignore[call-overload]
        time.sleep(4)
        running.send_signal(number)
        _, said = running.communicate(timeout=60)
    assert running.returncode == code
    assert said == "nao-sim: stopped\n"
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_a_killed_run_was_making_is_swept_by_the_next(tmp_path: Path) -> None:
    made = tmp_path / "take [1]"
    with complete_folder(made, "mark") as folder:
        (folder / "mark").write_text("first")
    program = (
        "import os, signal, sys, pathlib; from nao_sim.episodes.folder import complete_folder\n"
        "with complete_folder(pathlib.Path(sys.argv[1]), 'mark') as folder:\n"
        "    (folder / 'half').write_text('half')\n    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    subprocess.run([sys.executable, "-c", program, str(made)], check=False)
    assert len(list(tmp_path.iterdir())) == 2
    other = tmp_path / f".{made.name}-{os.getpid()}-abcdefgh"
    other.mkdir()  # of a run that is still on
    with complete_folder(made, "mark") as folder:
        (folder / "mark").write_text("second")
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([other.name, made.name])
    assert (made / "mark").read_text() == "second"


def test_a_result_that_was_being_replaced_is_put_back(tmp_path: Path) -> None:
    """Killed between the two renames, the former result is in the hidden folder and nothing in its place."""
    former = tmp_path / f".result-{2**22 + 1}-abcdefgh" / "former"
    former.mkdir(parents=True)
    (former / "mark").write_text("former")
    with pytest.raises(KeyboardInterrupt), complete_folder(tmp_path / "result", "mark"):
        raise KeyboardInterrupt
    assert [path.name for path in tmp_path.iterdir()] == ["result"]
    assert (tmp_path / "result" / "mark").read_text() == "former"
