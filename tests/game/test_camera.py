"""A camera stream: somebody moves before it, rests, and is answered; or nobody moves until the time-out."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import cv2
import numpy as np
import pytest

from nao_sim.game.errors import GameError
from nao_sim.game.play import play
from nao_sim.game.session import read_session
from nao_sim.resources import resource
from recognizer import open_clip

FPS = 15.0


class _Camera(BaseHTTPRequestHandler):
    """Motion JPEG over HTTP, as network cameras serve it: rest, then the clip, then rest, from each connection on."""

    pictures: list[bytes]

    def do_GET(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=picture")
        self.end_headers()
        begun = time.monotonic()
        try:
            while True:
                at = int((time.monotonic() - begun) * FPS)
                jpeg = self.pictures[min(at, len(self.pictures) - 1)]
                self.wfile.write(b"--picture\r\nContent-Type: image/jpeg\r\n\r\n" + jpeg + b"\r\n")
                time.sleep(1 / FPS)
        except OSError:
            pass

    def log_message(self, format: str, *args: object) -> None:
        pass


@pytest.fixture
def camera() -> Iterator[tuple[str, type[_Camera]]]:
    handler = type("Handler", (_Camera,), {"pictures": []})
    server = ThreadingHTTPServer(("127.0.0.1", 0), handler)
    server.daemon_threads = True
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/stream.mjpg", handler
    server.shutdown()
    thread.join()
    server.server_close()


def _pictures(rest_s: float, clip: str | None) -> list[bytes]:
    """JPEGs at FPS: the clip's first frame for a while, the clip, its last frame for ever."""
    film = open_clip(resource("assets", "clips", f"{clip or 'stop'}.avi"))
    frames = list(film)
    times = np.arange(0, len(frames) / film.fps, 1 / FPS)
    moving = [frames[int(t * film.fps)] for t in times] if clip else []
    shown = [frames[0]] * round(rest_s * FPS) + moving + [moving[-1] if moving else frames[0]]
    return [cv2.imencode(".jpg", frame)[1].tobytes() for frame in shown]


def _session(path: Path, address: str, timeout_s: int = 3) -> Path:
    path.write_text(
        f"""
        [study]
        condition = "dyadic"
        design = "single_case"
        [game]
        gestures = ["right_arm_up"]
        turns = 1
        timeout_s = {timeout_s}
        [prompts]
        highest = 0
        [[participant]]
        id = "C01"
        role = "child"
        turns = {{ camera = "{address}" }}
        models = "unseen"
        [[participant]]
        id = "T01"
        role = "therapist"
        turns = "unseen"
        """,
        encoding="utf-8",
    )
    return path


@pytest.mark.slow
def test_a_movement_is_watched_until_the_person_rests(tmp_path, camera):
    address, handler = camera
    handler.pictures = _pictures(6.0, "right_arm_up")  # however slowly this machine begins the turn
    tables = play(read_session(_session(tmp_path / "s.toml", address, timeout_s=10)), tmp_path / "out")
    (turn,) = tables.turns
    assert turn.excluded is None
    assert (turn.seen, turn.auto_score) == ("right_arm_up", 1)
    assert 0 < turn.latency_s < 10.5
    # The server names no rate, for which OpenCV says 25; what comes is measured.
    assert open_clip(tmp_path / "out" / turn.clip).fps < 20
    assert turn.movement_end_s - turn.movement_start_s < 4


@pytest.mark.slow
def test_nobody_moves(tmp_path, camera):
    address, handler = camera
    handler.pictures = _pictures(0.5, None)
    (turn,) = play(read_session(_session(tmp_path / "s.toml", address)), tmp_path / "out").turns
    assert (turn.excluded, turn.auto_score, turn.latency_s, turn.latency_censored) == (None, 0, None, True)
    assert turn.waited_s == pytest.approx(3.0, abs=0.5)


def test_a_camera_that_is_not_there_is_said_before_anything_begins(tmp_path):
    session = read_session(_session(tmp_path / "s.toml", "http://127.0.0.1:9/none"))
    with pytest.raises(GameError, match="gives no picture"):
        play(session, tmp_path / "out")
    assert not (tmp_path / "out" / "journal.jsonl").exists()
