"""A gesture of one's own, checked and played: ``python examples/own_gesture.py``.

What is written here is what a file in ``assets/gestures`` says; ``docs/gestures.md`` explains each line.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

from nao_sim.gestures.validation import validate_gesture

GESTURE = """
name = "look_up"
title = "Looking up, arms a little open"
kind = "linear"

[[key_frame]]
time = 1.0
angles = { HeadPitch = -25, LShoulderRoll = 25, RShoulderRoll = -25 }
mark = "hold"

[[key_frame]]
time = 2.0
angles = { HeadPitch = -25 }

[[key_frame]]
time = 3.0
rest = true
"""


def main() -> None:
    """Write the gesture file and hold it against what the body allows."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "look_up.toml"
        file.write_text(GESTURE, encoding="utf-8")
        found = validate_gesture(file)
    print("\n".join(found.faults) or "nothing wrong with it")
    if found.measures is not None:
        worst = found.measures.tracking_deg
        print(f"{found.measures.duration_s:.1f} s; {worst.where} follows worst, {worst.value:.1f}° RMS")
        print("ends standing" if found.measures.ends_standing else "ends otherwise than standing")


if __name__ == "__main__":
    main()
