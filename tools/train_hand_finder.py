"""Learn the template of `recognizer.postures.person.hand_finder` anew: ``python tools/train_hand_finder.py FOLDER``.

FOLDER is what ``tools/film_hands.py`` filmed; every ``--every``-th of its photos is used. Photos labelled by hand serve
as well. The network of ``tools/train_hand_net.py`` is learnt at the places that the template finds.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from recognizer.postures.person.training.hand_finder_training import read_hands, train


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--every", type=int, default=4)
    parser.add_argument("--out", type=Path, default=Path("recognizer/postures/person/hand_template.npz"))
    asked = parser.parse_args()
    train(read_hands(asked.folder)[:: asked.every], asked.out)


if __name__ == "__main__":
    main()
