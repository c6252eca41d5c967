"""The imitation game: how soon the robot answers, how long a session takes, what a kill loses, when movement begins.

    python benchmarks/game.py answer          end of a clip to the robot's first motion command
    python benchmarks/game.py session         the twelve-turn example with a rendered child, unattended
    python benchmarks/game.py kills           20 kills at random moments of a game
    python benchmarks/game.py onset           found starts of movement against the truth of simulated people

Wall-clock figures need an otherwise idle machine; processor time is printed beside them.
"""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from nao_sim.episodes.imitate import answer_to, answer_to_label
from nao_sim.game.play import play
from nao_sim.game.play.clock import Clock
from nao_sim.game.play.robot import RobotPlayer
from nao_sim.game.session import read_session
from nao_sim.game.store import SessionFolder
from nao_sim.game.store.folder import JOURNAL
from nao_sim.game.tables import Turn
from nao_sim.game.watch.movement import movement
from nao_sim.game.watch.watching import Film, Watcher
from nao_sim.gestures import vocabulary
from nao_sim.people.filming.film import one_core, roll
from nao_sim.people.filming.shots import COARSE, draw_cast, draw_shot
from nao_sim.people.filming.stage import Stage
from nao_sim.resources import resource
from recognizer import Clip, Recognizer, open_clip

EXAMPLE = resource("assets", "sessions", "groups_triadic.toml")
THESIS_S = (3.0, 4.0)
"""From capture to imitation (thesis, appendix 7)."""


def _recognizer() -> Recognizer:
    return Recognizer.load(resource("assets", "databases", "dynamic.parquet"))


def answer() -> None:
    """Print the delay for the sample clip of each gesture that is played."""
    names = [n for n, e in vocabulary().items() if e.playable and e.family in ("small", "large")]
    robot, watcher = RobotPlayer(Clock()), Watcher(_recognizer(), None)
    robot.rehearse(answer_to_label(name) for name in names)
    wall, cpu = [], []
    for name in names:
        clip = open_clip(resource("assets", "clips", f"{name}.avi"))
        robot.stand()
        seen = watcher.watch(Film.of(clip))
        assert seen.recognition is not None
        done = robot.perform(answer_to(seen.recognition))
        wall.append(done.began - seen.ended)
        again = watcher.recognizer.stream(clip.fps)
        for frame in clip:
            again.push(frame)
        start = time.process_time()
        again.finish()
        cpu.append(time.process_time() - start)
    print(f"{len(names)} clips: wall median {np.median(wall):.3f} s, worst {max(wall):.3f} s; recognition alone takes")
    print(f"processor time median {np.median(cpu):.3f} s, worst {max(cpu):.3f} s; the thesis: {THESIS_S[0]:g} to 4 s")


def session() -> None:
    """Print how long the example takes without its baseline, which leaves twelve turns."""
    agreed = replace(read_session(EXAMPLE), baseline=0)
    with tempfile.TemporaryDirectory() as work:
        begun, used = time.perf_counter(), time.process_time()
        tables = play(agreed, Path(work) / "out")
        wall, cpu = time.perf_counter() - begun, time.process_time() - used
    delays = [turn.answer_delay_s for turn in tables.turns if turn.answer_delay_s is not None]
    print(f"{len(tables.turns)} turns: {wall:.1f} s wall, {cpu:.1f} s processor")
    print(f"the robot's answers began after {max(delays):.3f} s at most")


def kills(count: int = 20) -> None:
    """Kill a game at random moments until it is through; compare with one that was left alone."""
    rng, left, lost, twice = random.Random(1), count, 0, 0
    agreed = replace(read_session(EXAMPLE), baseline=0)
    with tempfile.TemporaryDirectory() as work:
        whole = play(agreed, Path(work) / "whole").turns
        games = 0
        while left:
            games += 1
            out = Path(work) / f"out{games}"
            file = Path(work) / "session.toml"
            text = EXAMPLE.read_text(encoding="utf-8").replace("baseline = 2", "baseline = 0")
            file.write_text(text, encoding="utf-8")
            finished = 0
            while True:
                arguments = ["game", str(file), "--out", str(out), *(["--resume"] if (out / JOURNAL).exists() else [])]
                child = subprocess.Popen(
                    [sys.executable, "-c", "from nao_sim.cli import main; main()", *arguments],
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                )
                if left and _until_it_plays(out, child):
                    time.sleep(rng.uniform(0.0, 8.0))
                    if child.poll() is None:
                        os.kill(child.pid, signal.SIGKILL)
                        left -= 1
                child.wait()
                turns = SessionFolder(out).played().turns if (out / JOURNAL).exists() else []
                lost += len(turns) < finished
                finished = len(turns)
                if child.returncode == 0:
                    break
            numbers = [turn.turn for turn in turns]
            twice += len(numbers) - len(set(numbers))
            same = _said(turns) == _said(whole)
            print(f"game {games}: {len(turns)} turns, {'as' if same else 'NOT as'} in the game left alone")
    print(f"{count} kills: {lost} finished turns lost, {twice} played twice")


def _said(turns: Sequence[Turn]) -> list[tuple[object, ...]]:
    return [(turn.turn, turn.target, turn.seen, turn.auto_score) for turn in turns]


def _until_it_plays(out: Path, child: subprocess.Popen[bytes]) -> bool:
    """Wait until this run has begun to play: the lock is its own by then, and the robot rehearsed."""
    before = (out / JOURNAL).stat().st_size if (out / JOURNAL).exists() else 0
    while child.poll() is None:
        if (out / JOURNAL).exists() and (out / JOURNAL).stat().st_size > before:
            return True
        time.sleep(0.05)
    return False


def onset(people: int = 12, takes: int = 5) -> None:
    """Print how far found starts lie from the first moment at which a joint turns at a tenth of its peak speed."""
    labels = [n for n, e in vocabulary().items() if e.playable and e.family in ("small", "large")]
    cast, recognizer, errors, still = draw_cast(41, people), _recognizer(), [], 0
    with one_core(), Stage(COARSE) as stage:
        for number in range(people * takes):
            label = labels[number % len(labels)]
            shot = draw_shot(41, label, cast[number % people], number, restless=0.0, underway=0.0)
            shot = replace(shot, width=320, height=240, fps=10.0)
            times = np.arange(0, shot.performance.seconds, 0.02)
            speed = np.abs(np.diff(shot.performance._gesture(times), axis=0)).max(axis=1)
            truth = times[int(np.argmax(speed > 0.1 * speed.max()))]
            seen = recognizer.recognize(Clip.from_array(list(roll(stage, shot)), shot.fps))
            assert seen.evidence is not None
            found = movement(seen.evidence, certain=True)
            assert found is not None
            errors.append(found[0] - truth)
        for number in range(people):
            shot = draw_shot(41, "irrelevant", cast[number], number, "stand", restless=0.0, underway=0.0)
            shot = replace(shot, width=320, height=240, fps=10.0)
            seen = recognizer.recognize(Clip.from_array(list(roll(stage, shot)), shot.fps))
            assert seen.evidence is not None
            still += movement(seen.evidence) is None
    off = np.percentile(np.abs(errors), [50, 80, 95])
    print(f"{len(errors)} films: start off by {off[0]:.2f} s (median), {off[1]:.2f} s (80 %), {off[2]:.2f} s (95 %)")
    print(f"{still} of {people} people who only stand are said not to move")


if __name__ == "__main__":
    {"answer": answer, "session": session, "kills": kills, "onset": onset}[sys.argv[1]]()
