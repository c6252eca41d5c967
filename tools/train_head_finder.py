"""Learn how heads are found and fitted anew: ``MUJOCO_GL=egl python tools/train_head_finder.py SET [SET …]``.

Each SET is a folder that ``nao-sim film`` made; its shots are staged again to see where the heads are. Three parts are
learned one after the other, each on persons whom the one before does not know:

- the template and the fit with ``--persons 40 --every 1`` on ``nao-sim film --out SET --persons 40 --takes 2
  --irrelevant 400 --seed 7 --restless 0.3``, 1,438 clips (who walks is left out);
- the closer look with ``--part closer --persons 60 --every 1`` on ``nao-sim film --out SET --persons 90 --takes 4
  --irrelevant 6000 --seed 3`` (waves were a little different then), 7,600 clips;
- the ranking with ``--part ranking --first 60 --persons 30 --every 1`` on the same film, 3,800 clips of other persons.

None of all these takes part in the database and its figures.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from nao_sim.people.datasets.head_ground_truth import heads_of_film
from recognizer.person import closer_look, ranking
from recognizer.person.training.closer_training import save
from recognizer.person.training.finder_training import train, train_closer, train_ranking
from recognizer.person.training.known_heads import KnownHead


def known_heads(folder: Path, persons: range, in_view: bool) -> list[KnownHead]:
    """Heads in the film of some persons: of all clips, or of those where they are in view from the beginning."""
    return [
        KnownHead(folder / row["file"], f"{folder}/{row['person']}", track)
        for row, track in heads_of_film(folder)
        if int(row["person"][1:]) in persons and not (in_view and _walks_in(row, track))
    ]


def _walks_in(row: dict[str, Any], track: np.ndarray) -> bool:
    seen = 0 < track[0, 0] < row["width"] / row["height"] and 0 < track[0, 1] < 1
    return row["label"].startswith("walk") or not seen


def main() -> None:
    """Stage the sets again and train."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sets", nargs="+", type=Path)
    parser.add_argument("--persons", type=int, default=12, help="use so many of each set")
    parser.add_argument("--first", type=int, default=0, help="number of the first of them")
    parser.add_argument("--part", choices=("template", "closer", "ranking"), default="template", help="what to learn")
    parser.add_argument("--every", type=int, default=2, help="use one clip of so many")
    parser.add_argument("--out", type=Path, default=Path("recognizer/person"), help="folder of the files of weights")
    asked = parser.parse_args()
    persons = range(asked.first, asked.first + asked.persons)
    heads = [
        head for folder in asked.sets for head in known_heads(folder, persons, asked.part == "template")[:: asked.every]
    ]
    print(f"{len(heads)} clips with known heads")
    if asked.part == "closer":
        save(train_closer(heads), asked.out / closer_look.FILE)
    elif asked.part == "ranking":
        train_ranking(heads).save(asked.out / ranking.FILE)
    else:
        train(heads, asked.out / "head_shoulders.npz", asked.out / "head_fit.npz")


if __name__ == "__main__":
    main()
