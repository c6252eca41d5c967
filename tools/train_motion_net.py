"""Learn the network of ``recognizer/networks/motion_net.py`` anew: ``python tools/train_motion_net.py SET``.

Needs PyTorch, the extra ``network``.

SET is a folder that ``nao-sim film`` made. The shipped weights were learned in four runs. Three on ``nao-sim film --out
SET --persons 90 --takes 4 --irrelevant 6000 --seed 3``, by former versions of films and windows: ten epochs on 60
persons, eight on all 90, both with less variation than below (no other sizes, tempi or noise), eighteen more. The
fourth on other 90 persons, ``--seed 5``, with the films and windows of today: ``--epochs 8 --rate 1.2e-3 --from
recognizer/networks/motion_net.npz``, twenty minutes on two cores and nearly as much for what every clip shows, which is
kept in SET/looks.npz. None of these persons is in the shipped database or takes part in its figures. With new weights
raise ``VERSION`` in ``recognizer/features/body_features.py`` and train all databases again.

The network learns to name gestures and kinds of irrelevant motion. Half of the clips are mirrored; the head is found up
to half a head elsewhere, larger or smaller than it is, contrast and tempo vary, pictures are noisy, and a few steps are
cut off at the ends.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from zipfile import BadZipFile

import cv2
import joblib
import numpy as np
import torch
from motion_net_torch import Net
from torch import nn

from nao_sim.gestures.vocabulary import vocabulary
from recognizer import open_clip
from recognizer.evaluation.dataset import Entry, read_manifest
from recognizer.features.network_features import look_of
from recognizer.learning.database import IRRELEVANT, Database
from recognizer.learning.mirror import twins
from recognizer.learning.person_folds import metric_classes
from recognizer.networks.motion_net import BRIGHTEST, FILE, PICTURE_UNIT, REST, Look
from recognizer.person.steps import Step
from recognizer.person.view import WHOLE
from recognizer.tracking import track_clip

BATCH, SMOOTHED = 32, 0.05


class Clips:
    """What all clips show, step after step, and what they are.

    Args:
        entries: of the data set.
        cache: file in which it is kept.
    """

    def __init__(self, entries: list[Entry], cache: Path) -> None:
        if not cache.exists():
            shown = joblib.Parallel(-1, verbose=5)(joblib.delayed(look_at)(entry) for entry in entries)
            steps = np.array([len(pictures) for pictures, _, _ in shown])
            pictures, flow, head = (np.concatenate(part) for part in zip(*shown, strict=True))
            np.savez(cache, steps=steps, pictures=pictures, flow=flow, head=head)
        with np.load(cache) as kept:
            self.steps, self.pictures, self.flow, self.head = (kept[n] for n in ("steps", "pictures", "flow", "head"))
        self.start = np.concatenate([[0], np.cumsum(self.steps)[:-1]])
        self.own, self.twin, self.classes = classes(entries)

    def batch(self, chosen: np.ndarray, rng: np.random.Generator) -> tuple[torch.Tensor, ...]:
        """Pictures, flow and head of the steps of some clips, varied, which steps there are, and classes."""
        mirror = rng.random(len(chosen)) < 0.5
        shown = [self._varied(int(clip), turned, rng) for clip, turned in zip(chosen, mirror, strict=True)]
        steps = np.array([len(head) for _, _, head in shown])
        there = np.arange(steps.max()) < steps[:, None]
        pictures, flow, head = (torch.from_numpy(np.concatenate(part)) for part in zip(*shown, strict=True))
        target = np.where(mirror, self.twin[chosen], self.own[chosen])
        # Channels are the second axis to PyTorch, and yet lie last in memory: half the time.
        images = pictures.permute(0, 3, 1, 2), flow.permute(0, 3, 1, 2)
        return *images, head, torch.from_numpy(there), torch.from_numpy(target)

    def _varied(self, clip: int, turned: bool, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        first, last = self.start[clip], self.start[clip] + self.steps[clip]
        faster, larger = np.exp(rng.normal(0, (0.15, 0.08)))
        right, down = rng.uniform(-0.5, 0.5, 2)
        kept = first + _cut_and_hurried(last - first, faster, rng)
        gain = np.float32(np.exp(rng.normal(0, 0.15)) / PICTURE_UNIT)
        rest = self.pictures[first : first + REST].mean(axis=0, dtype=np.float32)[None] * gain
        pictures = self.pictures[kept] * gain
        if rng.random() < 0.3:
            noise = gain * np.float32(rng.uniform(0, 8))
            pictures += noise * rng.standard_normal(pictures.shape, np.float32)
        pictures, rest, flow = (
            _seen_from(maps, larger, right, down) for maps in (pictures, rest, self.flow[kept].astype(np.float32))
        )
        speed = np.float32((larger * faster) ** 0.5)  # the network reads roots of velocities
        head = self.head[kept].astype(np.float32) * speed
        head[:, -2:] /= np.float32(faster**0.5)  # a place
        look = Look(pictures, flow * speed, head)
        if turned:
            look, rest = look.mirrored(), rest[..., ::-1]
        return np.stack([look.picture, look.picture - rest], axis=-1), look.flow, look.head


def _cut_and_hurried(steps: int, faster: float, rng: np.random.Generator) -> np.ndarray:
    """Which steps are shown: in a third of the clips not the very first and last, and fewer of a faster motion."""
    first, last = 0, steps
    if rng.random() < 0.3 and steps > 20:
        first, last = int(rng.integers(0, 3)), steps - int(rng.integers(0, 3))
    count = max(3, round((last - first) / faster))
    return np.linspace(first, last - 1, count).round().astype(int)


def _seen_from(windows: np.ndarray, larger: float, right: float, down: float) -> np.ndarray:
    """Windows (n, h, w, …) as they are where the head is found elsewhere [head heights] and larger or smaller."""
    height, width = windows.shape[1:3]
    per_head = width / (WHOLE.right - WHOLE.left)
    centre = -WHOLE.left * per_head - 0.5, -WHOLE.top * per_head - 0.5
    shift = [(1 - larger) * middle + way * per_head for middle, way in zip(centre, (right, down), strict=True)]
    matrix = np.array([[larger, 0, shift[0]], [0, larger, shift[1]]])
    seen = np.empty_like(windows)
    for window, out in zip(windows, seen, strict=True):
        cv2.warpAffine(window, matrix, (width, height), dst=out, borderMode=cv2.BORDER_REPLICATE)
    return seen


def look_at(entry: Entry) -> tuple[np.ndarray, ...]:
    """Pictures (n, 64, 80) int8, flow (n, 16, 20, 3) and head (n, 76) float16 of the steps of a clip."""
    cv2.setNumThreads(1)
    steps = track_clip(open_clip(entry.path, entry.frames)).steps
    names = Step.__dataclass_fields__
    looks = [look_of(Step(*(steps.stacked(name)[k] for name in names))) for k in range(len(steps))]
    pictures = steps.stacked("picture").clip(-BRIGHTEST, BRIGHTEST).astype(np.int8)
    return pictures, np.array([k.flow for k in looks], np.float16), np.array([k.head for k in looks], np.float16)


def classes(entries: list[Entry]) -> tuple[np.ndarray, np.ndarray, int]:
    """Class of each clip, class of the mirrored clip, and how many classes there are."""
    family = {name: entry.family for name, entry in vocabulary().items()}
    columns = [[e.label, family.get(e.label, IRRELEVANT), e.action, e.person, e.name] for e in entries]
    mirror = {name: entry.mirror for name, entry in vocabulary().items() if entry.family in ("small", "large")}
    rows = Database(np.zeros((len(entries), 0), np.float32), *np.array(columns).T, (), "body", 0, mirror)
    own, twin = metric_classes(rows.rows), metric_classes(twins(rows))
    known, index = np.unique(np.concatenate([own, twin]), return_inverse=True)
    return *np.split(index, 2), len(known)


def batches(clips: Clips, chosen: np.ndarray, rng: np.random.Generator) -> list[np.ndarray]:
    """All clips once, in batches of about equal length."""
    order = rng.permutation(chosen)
    batches = []
    for first in range(0, len(order), 20 * BATCH):
        some = order[first : first + 20 * BATCH]
        some = some[np.argsort(clips.steps[some], kind="stable")]
        batches += [some[k : k + BATCH] for k in range(0, len(some), BATCH)]
    return [batches[k] for k in rng.permutation(len(batches))]


def train(net: Net, part: nn.Module, clips: Clips, chosen: np.ndarray, epochs: int, rate: float, out: Path) -> None:
    """Show the network the ``chosen`` clips so many times and let a ``part`` of it learn; ``out`` gets all weights."""
    rng = np.random.default_rng(0)
    torch.manual_seed(0)
    net.requires_grad_(False)
    part.requires_grad_(True)
    optimizer = torch.optim.AdamW(part.parameters(), rate, weight_decay=2e-2)
    updates = epochs * -(-len(chosen) // BATCH) + 20
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, rate, updates, pct_start=0.1)
    net.train()
    for epoch in range(epochs):
        lost, right = 0.0, 0
        with ThreadPoolExecutor(1) as ahead:
            todo = batches(clips, chosen, rng)
            coming = ahead.submit(clips.batch, todo[0], rng)
            for following in [*todo[1:], None]:
                *inputs, target = coming.result()
                if following is not None:
                    coming = ahead.submit(clips.batch, following, rng)
                with torch.autocast("cpu", torch.bfloat16):
                    named = net(*inputs)
                loss = nn.functional.cross_entropy(named.float(), target, label_smoothing=SMOOTHED)
                optimizer.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_(part.parameters(), 2.0)
                optimizer.step()
                schedule.step()
                lost, right = lost + loss.item() * len(target), right + int((named.argmax(1) == target).sum())
        np.savez_compressed(out, **net.folded())
        print(f"epoch {epoch + 1}: loss {lost / len(chosen):.3f}, {right / len(chosen):.1%} right", flush=True)


def main() -> None:
    """Look at the film, train, write the weights."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("set", type=Path)
    parser.add_argument("--persons", type=int, default=1000, help="use the first so many")
    parser.add_argument("--epochs", type=int, default=10)
    parser.add_argument("--rate", type=float, default=2e-3)
    parser.add_argument("--from", dest="begin", type=Path, help=f"a {FILE} to go on from, the shipped one or another")
    parser.add_argument("--out", type=Path, default=Path("recognizer/networks"), help=f"folder of {FILE}")
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    entries = read_manifest(asked.set)
    clips = Clips(entries, asked.set / "looks.npz")
    net = Net(clips.classes).to(memory_format=torch.channels_last)
    first = np.unique([entry.person for entry in entries])[: asked.persons]
    chosen = np.flatnonzero(np.isin([entry.person for entry in entries], first))
    if asked.begin:
        try:
            with np.load(asked.begin) as arrays:
                rng = np.random.default_rng(0)
                net.begin_with(arrays, (clips.batch(k, rng)[:-1] for k in batches(clips, chosen, rng)[:40]))
        except (OSError, EOFError, BadZipFile, ValueError, KeyError, RuntimeError) as error:
            parser.error(f"{asked.begin} are no weights to go on from: {str(error).splitlines()[0]}")
        train(net, net.name, clips, chosen, 1, 1e-2, asked.out / FILE)
    train(net, net, clips, chosen, asked.epochs, asked.rate, asked.out / FILE)


if __name__ == "__main__":
    main()
