"""Take a picture of a recording with Rerun's headless viewer.

    python tools/screenshot.py demo/episode.rrd 5.0 docs/episode.png

Needs a Vulkan driver (on Debian or Ubuntu: apt-get install mesa-vulkan-drivers libvulkan1) and ``rerun`` on the PATH.
The viewer's remote control is experimental in Rerun 0.41, so it stays out of the package.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import cv2
from rerun.experimental import ViewerClient

PORT = 9899
LOAD_S = 4.0
WIDTH_PX = 1280


def main(recording: str, seconds: str, picture: str) -> None:
    """Open a recording, move to a time, save what the viewer shows, and print what the views complain about."""
    viewer = ViewerClient.spawn(headless=True, port=PORT)
    viewer.open(recording)
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
