"""The closer look: is this really a head on shoulders?"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from sklearn.neural_network import MLPClassifier

from nao_sim.resources import resource
from recognizer import open_clip
from recognizer.networks.hidden_layer import HiddenLayer
from recognizer.person.closer_look import closer_score
from recognizer.person.head_shoulders import Body, closer_look
from recognizer.person.training.closer_training import learn, mirrored, save
from recognizer.tracking import track_clip

CELLS = 2800


def places(n: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Cells of n places; where the eighth or the ninth row is dark, but not both, there is a head."""
    rng = np.random.default_rng(seed)
    cells = rng.uniform(0, 1, (n, 20, 20, 7)).astype(np.float32)
    dark = rng.random((2, n)) < 0.5
    for row, chosen in zip((8, 9), dark, strict=True):
        cells[chosen, row] *= 0.2
    return cells.reshape(n, -1), dark[0] != dark[1]


def test_a_mirrored_picture_has_mirrored_cells() -> None:
    clip = open_clip(resource("assets", "clips", "bye_right.avi"))
    grey = next(iter(clip)).mean(axis=2).astype(np.uint8)
    width = grey.shape[1]
    body = Body(width * 0.4, grey.shape[0] * 0.4, 36.0, 0.0)
    twin = Body(width - body.x, body.y, 36.0, 0.0)
    other = closer_look(np.ascontiguousarray(grey[:, ::-1]), [twin])
    seen = mirrored(closer_look(grey, [body]))
    assert np.corrcoef(seen[0], other[0])[0, 1] > 0.9
    np.testing.assert_array_equal(mirrored(seen), closer_look(grey, [body]))


def test_units_learn_what_no_weighted_sum_can_tell(tmp_path: Path) -> None:
    said: list[str] = []
    network = learn(*places(6000, 0), tell=said.append)
    cells, right = places(500, 1)
    assert np.mean((network(cells)[:, 0] > 0) == right) > 0.9
    assert len(said) == 10
    save(network, tmp_path / "look.npz")
    with np.load(tmp_path / "look.npz") as stored:
        back = HiddenLayer(**{name: stored[name].astype(np.float32) for name in stored.files})
    np.testing.assert_allclose(back(cells), network(cells), atol=0.1)  # half precision


@pytest.mark.parametrize("name", ["bye_right", "kowtow", "yes"])
def test_a_found_head_is_one_and_a_wall_is_none(name: str) -> None:
    track = track_clip(open_clip(resource("assets", "clips", f"{name}.avi")))
    grey, body = track.samples[0].grey, track.body
    beside = [Body(body.x + side * 3 * body.head, body.y, body.head, 0.0) for side in (-1, 1)]
    head, *others = closer_score(closer_look(grey, [body, *beside]))
    assert head > 0 > max(others)


@pytest.mark.parametrize("classes", [2, 4])
def test_a_hidden_layer_says_what_the_trained_network_says(classes: int) -> None:
    rng = np.random.default_rng(classes)
    inputs, targets = rng.normal(3, 2, (300, 6)), rng.integers(0, classes, 300)
    mean, spread = inputs.mean(axis=0), inputs.std(axis=0)
    trained = MLPClassifier((8,), random_state=0)
    trained.partial_fit((inputs - mean) / spread, targets, classes=range(classes))
    logits = HiddenLayer.of(trained, mean, spread)(inputs)
    if classes == 2:
        logits = np.hstack([np.zeros_like(logits), logits])
    shares = np.exp(logits) / np.exp(logits).sum(axis=1, keepdims=True)
    np.testing.assert_allclose(shares, trained.predict_proba((inputs - mean) / spread), rtol=1e-6)
