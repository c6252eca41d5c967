"""How many persons does a database need? Parts of one, asked about persons who are in none of the parts.

Usage: python benchmarks/few_persons.py [--database FILE]

The last fifteen persons are asked about; learned from are the first 1, 2, 4 … of the others, with all their clips.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from nao_sim.resources import resource
from recognizer.learning.body_model import BodyModel
from recognizer.learning.database import IRRELEVANT, Database

ASKED = 15


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--database", type=Path, default=resource("assets", "databases", "dynamic.parquet"))
    database = Database.load(parser.parse_args().database)
    persons = np.unique(database.persons)
    unseen = database.take(np.isin(database.persons, persons[-ASKED:]))
    gesture = unseen.labels != IRRELEVANT
    print(f"{gesture.sum()} gestures and {(~gesture).sum()} irrelevant motions of {ASKED} persons are asked about")
    print("persons  clips  small  large  gestures rejected  irrelevant rejected")
    most = len(persons) - ASKED
    for count in [*(2**k for k in range(most.bit_length()) if 2**k < most), most]:
        known = database.take(np.isin(database.persons, persons[:count]))
        model = BodyModel().fit(known)
        said = [model.decide(vector) for vector in unseen.features]
        right = np.array([decision.nearest for decision in said]) == unseen.labels
        rejected = np.array([decision.rejected for decision in said])
        small, large = (right[unseen.families == family].mean() for family in ("small", "large"))
        shares = (small, large, rejected[gesture].mean(), rejected[~gesture].mean())
        print(f"{count:7d} {len(known):6d}", *(f"{100 * share:5.1f} %" for share in shares))


if __name__ == "__main__":
    main()
