"""The network that names hands: NumPy against plain correlations, what it reads, and drawn hands that it names."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from scipy.signal import correlate

from recognizer.postures.person.hand_net import CHANNELS, HAND, SIDE, STRIDES, HandNet, look

from .conftest import hand_photo, unseen_hands


def window(seed: int = 0) -> np.ndarray:
    """Soft coloured spots, neither black nor white."""
    rng = np.random.default_rng(seed)
    spots = cv2.GaussianBlur(rng.integers(0, 256, (SIDE, SIDE, 3), np.uint8), (0, 0), 4).astype(np.float32)
    return cv2.normalize(spots, None, 60, 190, cv2.NORM_MINMAX).astype(np.uint8)


def test_shares_are_what_plain_correlations_give() -> None:
    net, maps = HandNet.load(), look(window())
    for layer, stride in zip(net.space, STRIDES, strict=True):
        side = round((len(layer.weights) / maps.shape[-1]) ** 0.5)
        kernels = layer.weights.reshape(side, side, maps.shape[-1], -1)
        around = [(side // 2,) * 2] * 2 + [(0, 0)]
        outs = [correlate(np.pad(maps, around), kernels[..., k], "valid")[..., 0] for k in range(kernels.shape[-1])]
        maps = np.maximum(np.stack(outs, axis=-1)[::stride, ::stride] + layer.offsets, 0)
    whole = np.maximum(maps.ravel() @ net.whole.weights + net.whole.offsets, 0)
    found = net(look(window())[None])[0]
    np.testing.assert_allclose(found, whole @ net.name + net.name_offsets, rtol=1e-3, atol=1e-3)
    assert found.shape == (len(net.classes),)


def test_several_windows_are_answered_as_each_alone() -> None:
    net, looks = HandNet.load(), np.stack([look(window(k)) for k in range(3)])
    np.testing.assert_allclose(net(looks), np.concatenate([net(one[None]) for one in looks]), rtol=1e-4, atol=1e-4)


def test_a_look_is_of_shapes_and_of_colours_beyond_the_palms() -> None:
    """Less light changes the evened lightness little; where the palm is, no colour is beyond the palm's."""
    shown = look(window())
    assert shown.shape == (SIDE, SIDE, CHANNELS)
    darker = look((window() * 0.6).astype(np.uint8))
    assert np.abs(shown[..., 0] - darker[..., 0]).mean() < 0.1
    down = round(SIDE / 2 + 0.18 * HAND)
    assert np.abs(np.median(shown[down - 3 : down + 4, SIDE // 2 - 3 : SIDE // 2 + 4, 1:], axis=(0, 1))).max() < 0.3


def test_a_flat_window_is_no_posture() -> None:
    net = HandNet.load()
    named = net.classes[int(net(look(np.full((SIDE, SIDE, 3), 128, np.uint8))[None])[0].argmax())]
    assert named == "no hand" or named.startswith("irrelevant")


@pytest.mark.parametrize("label", ["stop_hand", "victory", "pointing"])
def test_drawn_hands_that_it_has_never_seen_are_named(label: str) -> None:
    """Flat silhouettes, of builds and with edges, light and paper other than those of drawn hands in its training."""
    net = HandNet.load()
    right = []
    for mask in unseen_hands(label, 6, seed=5):
        picture = hand_photo(mask)
        inside = cv2.distanceTransform(mask.astype(np.uint8), cv2.DIST_L2, 5)
        y, x = np.unravel_index(int(inside.argmax()), inside.shape)
        hand = inside.max() / 0.21
        scale = HAND / hand
        move = SIDE / 2 - scale * np.array([x, y - 0.2 * hand])
        part = cv2.warpAffine(
            picture, np.column_stack([np.eye(2) * scale, move]), (SIDE, SIDE), borderMode=cv2.BORDER_REPLICATE
        )
        right.append(net.classes[int(net(look(part)[None])[0].argmax())] == label)
    assert np.mean(right) >= 0.5
