"""The network in NumPy against plain correlations, and what must hold whatever its weights are."""

from __future__ import annotations

import dataclasses
import hashlib
from importlib.resources import files

import numpy as np
import pytest
from scipy.signal import correlate

from nao_sim.resources import resource
from recognizer import Clip, open_clip
from recognizer.features.body_features import VERSION
from recognizer.features.network_features import MotionWatch, look_of
from recognizer.networks.motion_net import DILATIONS, FEATURES, FILE, STRIDES, Look, MotionNet
from recognizer.person.steps import Step, make_step
from recognizer.person.view import HEAD, POSE
from recognizer.tracking import track_clip

RNG = np.random.default_rng(0)


def some_step(seed: int = 0) -> Step:
    rng = np.random.default_rng(seed)
    picture, flow = rng.normal(0, 20, (64, 80)), rng.normal(0, 3, (2, 64, 80))
    head = rng.normal(0, 1, (2, *HEAD.size[::-1]))
    pose = np.zeros(POSE.size[::-1], np.uint8)
    return make_step(
        0.1, 0.1, *(a.astype(np.float32) for a in (picture, flow, head)), pose, rng.normal(0, 1, 2).astype(np.float32)
    )


def some_look(seed: int = 0) -> Look:
    return look_of(some_step(seed))


def test_a_step_is_what_plain_correlations_give() -> None:
    """The first layer is stored as it was trained: the window and how it differs from rest, one after the other."""
    net, look, rest = MotionNet.load(), some_look(), some_look(1).picture
    with np.load(str(files("recognizer.networks").joinpath(FILE))) as stored:
        first = stored["space0_weights"].astype(np.float32)
    maps = np.stack([look.picture, look.picture - rest], axis=-1)
    for layer, stride in zip(net.space, STRIDES, strict=True):
        if stride == 1:
            maps = np.concatenate([maps, look.flow], axis=-1)
        weights = first if layer is net.space[0] else layer.weights
        side = round((len(weights) / maps.shape[-1]) ** 0.5)
        kernels = weights.reshape(side, side, maps.shape[-1], -1)
        around = [(side // 2,) * 2] * 2 + [(0, 0)]
        outs = [correlate(np.pad(maps, around), kernels[..., k], "valid")[..., 0] for k in range(kernels.shape[-1])]
        maps = np.maximum(np.stack(outs, axis=-1)[::stride, ::stride] + layer.offsets, 0)
    seen = np.maximum(maps.ravel() @ net.seen.weights + net.seen.offsets, 0)
    head = np.maximum(look.head @ net.head.weights + net.head.offsets, 0)
    found = net.steps([look], net.first(rest))[0]
    np.testing.assert_allclose(found, np.concatenate([seen, head]), rtol=1e-3, atol=1e-4)


@pytest.mark.parametrize("n", [1, 4, 30])
def test_a_clip_is_what_plain_sums_over_time_give(n: int) -> None:
    net, steps = MotionNet.load(), RNG.random((n, 96)).astype(np.float32)
    found = steps
    for number, (layer, dilation) in enumerate(zip(net.time, DILATIONS, strict=True)):
        kernels = layer.weights.reshape(5, -1, layer.weights.shape[1])
        new = np.tile(layer.offsets.astype(float), (n, 1))
        for t in range(n):
            for k in range(5):
                if 0 <= (at := t + (k - 2) * dilation) < n:
                    new[t] += found[at] @ kernels[k]
        found = np.maximum(new, 0) + (found if number else 0)
    whole = np.concatenate([found.mean(axis=0), found.max(axis=0), np.sqrt(found.var(axis=0) + 1e-4)])
    expected = np.maximum(whole @ net.whole.weights + net.whole.offsets, 0)
    assert expected.shape == (FEATURES,)
    np.testing.assert_allclose(net.clips(steps[None])[0], expected, rtol=1e-3, atol=1e-3)


def test_a_mirrored_look_is_the_look_of_the_mirrored_step() -> None:
    step = some_step()
    turn = np.array([-1, 1], np.float32)
    mirrored = dataclasses.replace(
        step,
        picture=step.picture[:, ::-1],
        flow=step.flow[..., ::-1] * turn[:, None, None],
        head_flow=step.head_flow[..., ::-1] * turn[:, None, None],
        torso=step.torso * turn,
        place=step.place * turn,
    )
    expected, found = look_of(mirrored), look_of(step).mirrored()
    for name in ("picture", "flow", "head"):
        np.testing.assert_allclose(getattr(found, name), getattr(expected, name), atol=1e-5)


def test_the_mirrored_clip_exchanges_both_halves() -> None:
    clip = open_clip(resource("assets", "clips", "bye_right.avi"))
    frames = np.array(list(clip))
    clips = (Clip.from_array(f, clip.fps) for f in (frames, frames[:, :, ::-1]))
    here, there = (track_clip(c, mirrored=True).motion for c in clips)
    apart = np.linalg.norm(here[0] - here[1])
    assert np.linalg.norm(here - there[::-1]) < 0.35 * apart  # the head is not found on the very same pixel


def test_a_question_does_without_the_mirrored_clip() -> None:
    clip = open_clip(resource("assets", "clips", "bye_right.avi"))
    alone, both = track_clip(clip).motion, track_clip(clip, mirrored=True).motion
    np.testing.assert_allclose(alone[0], both[0], rtol=1e-4, atol=1e-4)
    assert not alone[1].any()
    assert both[1].any()


def test_only_the_last_steps_count_however_they_come_and_few_are_nothing() -> None:
    few, long, short = MotionWatch(6), MotionWatch(6), MotionWatch(6)
    few.push([some_step()])
    assert not few.features.any()
    first, last = [some_step(k) for k in range(3)], [some_step(k) for k in range(10, 16)]
    for step in [*first, *first, *last]:
        long.push([step])
    short.push([*first[:2]])
    short.push([first[2], *last])
    np.testing.assert_allclose(long.features, short.features, rtol=1e-4, atol=1e-4)
    assert long.features.any()


def test_who_trains_a_network_or_the_finder_anew_raises_the_version_of_the_features() -> None:
    """Rows that other weights described would be compared with clips that these see."""
    digest = hashlib.sha256()
    digest.update(files("recognizer.networks").joinpath(FILE).read_bytes())
    for name in ("head_shoulders.npz", "head_fit.npz", "closer_look.npz", "ranking.npz"):
        digest.update(files("recognizer.person").joinpath(name).read_bytes())
    assert (VERSION, digest.hexdigest()[:16]) == (8, "028f68caebf9af52")
