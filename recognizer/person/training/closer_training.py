"""How the network of :mod:`recognizer.person.closer_look` is learned, from what the closer look sees of candidates."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from sklearn.neural_network import MLPClassifier

from recognizer.networks.hidden_layer import HiddenLayer
from recognizer.person.head_shoulders import BINS, CHANNELS, FINE

UNITS, DECAY = 64, 0.03
BATCHES = (250, 500, 1000, 1000, 2000, 2000, 4000, 4000, 8000, 8000)  # a round each; larger ones still the weights
LEFT_OUT = 0.4  # share of the cells that training leaves out, others each time, so that no unit hangs on a few


def learn(cells: np.ndarray, right: np.ndarray, seed: int = 0, tell: Callable[[str], None] = print) -> HiddenLayer:
    """Learn from what the closer look sees of candidates (n, 2800), and whether each is a head (n,).

    Heads are as likely turned one way as the other: in each round half of the candidates are mirrored.
    """
    rng = np.random.default_rng(seed)
    mean = (cells.mean(axis=0, dtype=float) + mirrored(cells).mean(axis=0, dtype=float)) / 2
    spread = float(cells[:: max(1, len(cells) // 10_000)].std(axis=0, dtype=float).mean())
    network = MLPClassifier((UNITS,), alpha=DECAY, random_state=seed)
    for turn, batch in enumerate(BATCHES):
        network.set_params(batch_size=min(batch, len(cells)))
        seen = cells.astype(np.float32)
        other = rng.random(len(cells)) < 0.5
        seen[other] = mirrored(seen[other])
        seen = (seen - mean.astype(np.float32)) / np.float32(spread)
        seen *= (rng.random(seen.shape, np.float32) >= LEFT_OUT) / np.float32(1 - LEFT_OUT)
        network.partial_fit(seen, right, classes=[False, True])
        tell(f"closer look, round {turn}: loss {network.loss_:.4f}")
    return HiddenLayer.of(network, mean, spread)


def mirrored(cells: np.ndarray) -> np.ndarray:
    """What the closer look would see of mirrored pictures, (n, 2800) both."""
    planes = cells.reshape(-1, FINE, FINE, CHANNELS)[:, :, ::-1]
    turned = [-bin_ % BINS for bin_ in range(BINS)]  # a slanting edge slants the other way
    return planes[..., [*turned, BINS]].reshape(len(cells), -1)


def save(network: HiddenLayer, path: Path) -> None:
    """Write the weights in half precision."""
    arrays: dict[str, Any] = {name: value.astype(np.float16) for name, value in dataclasses.asdict(network).items()}
    np.savez_compressed(path, **arrays)
