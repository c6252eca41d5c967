"""Take a picture of an episode or session with Rerun's headless viewer.

    python tools/screenshot.py demo 5.0 docs/episode.png
    python tools/screenshot.py C07-1 44.0 docs/session.png

Needs a Vulkan driver (on Debian or Ubuntu: apt-get install mesa-vulkan-drivers libvulkan1) and ``rerun`` on the PATH.
The viewer's remote control is experimental in Rerun 0.41, so it stays out of the package.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

import cv2
from rerun.experimental import ViewerClient

from nao_sim.game.review.gather import recordings

PORT = 9899
LOAD_S = 8.0
WIDTH_PX = 1280


def main(path: str, seconds: str, picture: str) -> None:
    """Open what ``nao-sim review`` would, move to a time, save what the viewer shows, and print its complaints."""
    viewer = ViewerClient.spawn(headless=True, port=PORT)
    with tempfile.TemporaryDirectory() as work:
        viewer.open([str(file) for file in recordings([Path(path)], Path(work))])
        time.sleep(LOAD_S)
    viewer.set_time("time", duration=float(seconds))
    time.sleep(LOAD_S / 2)
    viewer.save_screenshot(picture)
    for view in viewer.get_state().views:
        if view.reports:
            print(view.name, view.reports)
    full = cv2.imread(picture)
    height = round(full.shape[0] * WIDTH_PX / full.shape[1])
    cv2.imwrite(picture, cv2.resize(full, (WIDTH_PX, height), interpolation=cv2.INTER_AREA))
    print(f"{picture}: {Path(picture).stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main(*sys.argv[1:])
