"""Learn the network of `recognizer.postures.person.hand_net` anew: ``python tools/train_hand_net.py FOLDER …``.

Needs PyTorch, the extra ``network``. A FOLDER is what ``tools/film_hands.py`` filmed; the windows of its hands and of
places that the hand finder takes for one are kept in FOLDER/windows.npz. Drawn hands (``tools/drawn_hands.py``) join
them.

Windows stand a little beside the hand, are a little too large or small and turned, as hands are found; half of them are
mirrored. Light, colour, sharpness and noise vary. Each posture, each other hand and "no hand" is a class; what is
reported on the way is of persons that are left out (``--kept-out``).
"""

from __future__ import annotations

import argparse
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import cv2
import joblib
import numpy as np
import torch
from drawn_hands import drawn_hands
from torch import nn

from recognizer.postures.person.hand_finder import find_heads, hand_template, search
from recognizer.postures.person.hand_net import CHANNELS, FILE, HAND, SIDE, STRIDES, look
from recognizer.postures.person.posture_shares import NO_HAND
from recognizer.postures.person.training.hand_finder_training import NOTHING, KnownHand, read_hands, with_head
from recognizer.postures.person.windows import cut_window
from recognizer.postures.photo import read_photo

MAPS, SIDES, WHOLE = (CHANNELS, 20, 32, 48, 64, 80, 80, 112), (5, 3, 3, 3, 3, 3, 3), 128
AROUND = 128  # pixels of a window's side as it is kept, so that it can be moved, scaled and turned
BATCH, SMOOTHED, DROPPED = 64, 0.05, 0.3
MISTAKEN, MISTAKEN_NOTHING = 1, 3  # places that are taken for a hand and are none, in a photo with and without one
DRAWN_HANDS = 12_000
EPOCH = 42_000  # windows, others each time
ON_HAND, OFF_HAND = 0.3, 0.45  # hand lengths from the hand, within and beyond which a place is one and is none
JITTER = (0.06, 0.1, 0.15)  # standard deviations of place [hands], size [logarithm] and turn [rad]


class Net(nn.Module):
    """The layers of `recognizer.postures.person.hand_net.HandNet` before they are folded."""

    def __init__(self, classes: int) -> None:
        super().__init__()
        self.space = nn.ModuleList(
            nn.Sequential(nn.Conv2d(n, out, side, stride, side // 2, bias=False), nn.BatchNorm2d(out), nn.ReLU())
            for n, out, side, stride in zip(MAPS[:-1], MAPS[1:], SIDES, STRIDES, strict=True)
        )
        self.cells = (SIDE // int(np.prod(STRIDES))) ** 2
        self.whole, self.name = nn.Linear(MAPS[-1] * self.cells, WHOLE), nn.Linear(WHOLE, classes)

    def forward(self, looks: torch.Tensor) -> torch.Tensor:
        """Name looks (n, 4, 80, 80): logits (n, classes)."""
        maps = looks
        for layer in self.space:
            maps = layer(maps)
        whole = self.whole(nn.functional.dropout(maps.flatten(1), DROPPED, self.training)).relu()
        return self.name(nn.functional.dropout(whole, DROPPED, self.training))

    def folded(self) -> dict[str, np.ndarray]:
        """Weights as `HandNet` reads them, in half precision."""
        arrays = {}
        for k, (convolution, norm, _) in enumerate(self.space):
            gain = norm.weight / (norm.running_var + norm.eps).sqrt()
            arrays[f"space{k}_weights"] = (convolution.weight.movedim(0, -1) * gain).movedim(0, -2).flatten(0, -2)
            arrays[f"space{k}_offsets"] = norm.bias - norm.running_mean * gain
        # The network reads maps with the channels last.
        whole = self.whole.weight.unflatten(1, (MAPS[-1], self.cells)).transpose(1, 2).flatten(1)
        arrays |= {"whole_weights": whole.T, "whole_offsets": self.whole.bias}
        arrays |= {"name_weights": self.name.weight.T, "name_offsets": self.name.bias}
        return {name: values.detach().contiguous().numpy().astype(np.float16) for name, values in arrays.items()}


def windows_of(known: KnownHand) -> list[tuple[np.ndarray, str, bool]]:
    """Return windows of a photo, what they show, and whether the hand was found there rather than known."""
    picture = read_photo(known.path)
    nothing = known.label == NOTHING
    out = [] if nothing else [(cut_window(picture, known.middle, known.hand, HAND, AROUND), known.label, False)]
    seen = with_head(known)
    head = seen.head if seen else next(iter(find_heads(picture)), None)
    if head is None:
        return out
    mistaken, most = 0, MISTAKEN_NOTHING if nothing else MISTAKEN
    for spot in search(picture, head, *hand_template()):
        away = np.inf if nothing else float(np.hypot(*(spot.middle - known.middle))) / known.hand
        label = known.label if away < ON_HAND else NO_HAND
        if (ON_HAND <= away <= OFF_HAND) or (label == NO_HAND and mistaken == most):
            continue
        mistaken += label == NO_HAND
        out.append((cut_window(picture, spot.middle, spot.hand, HAND, AROUND), label, True))
    return out


def gather(folder: Path) -> Path:
    """Keep all windows of a folder in a file: pictures, labels, which were found, and persons."""
    kept = folder / "windows.npz"
    if not kept.exists():
        hands = read_hands(folder)
        found = joblib.Parallel(-1, verbose=2)(joblib.delayed(windows_of)(known) for known in hands)
        who = [f"{folder.name} {known.person}" for known, windows in zip(hands, found, strict=True) for _ in windows]
        rows = [window for windows in found for window in windows]
        pictures, labels, spots = (np.array(column) for column in zip(*rows, strict=True))
        np.savez(kept, pictures=pictures, labels=labels, spots=spots, persons=np.array(who))
    return kept


def windows(folders: list[Path]) -> dict[str, np.ndarray]:
    """Return the windows of all folders and drawn ones."""
    columns: dict[str, list[np.ndarray]] = {}
    for folder in folders:
        with np.load(gather(folder)) as kept:
            for name in kept.files:
                columns.setdefault(name, []).append(kept[name])
    behind = columns["pictures"][-1][columns["labels"][-1] == NO_HAND]
    parts = np.array_split(np.arange(DRAWN_HANDS), 64)
    work = (
        joblib.delayed(drawn_hands)(len(part), HAND, AROUND, behind[k :: len(parts)], np.random.default_rng([7, k]))
        for k, part in enumerate(parts)
    )
    drawn = joblib.Parallel(-1)(work)
    columns["pictures"] += [pictures for pictures, _ in drawn]
    columns["labels"] += [labels for _, labels in drawn]
    columns["spots"].append(np.zeros(DRAWN_HANDS, bool))
    columns["persons"].append(np.full(DRAWN_HANDS, "drawn"))
    pictures = columns.pop("pictures")
    out = {name: np.concatenate(parts) for name, parts in columns.items()}
    out["pictures"] = np.empty((len(out["labels"]), AROUND, AROUND, 3), np.uint8)
    at = 0
    while pictures:  # they are many: each part is let go when it is copied
        part = pictures.pop(0)
        out["pictures"][at : at + len(part)] = part
        at += len(part)
    return out


def varied(picture: np.ndarray, found: bool, rng: np.random.Generator) -> np.ndarray:
    """Return a look (80, 80, 4) at a kept window (128, 128, 3), varied."""
    jitter = np.array(JITTER) * (0.5 if found else 1.0)
    turn, scale = rng.normal(0, JITTER[2]), np.exp(rng.normal(0, jitter[1]))
    c, s = np.cos(turn) * scale, np.sin(turn) * scale
    matrix = np.array([[c, -s], [s, c]])
    if rng.random() < 0.5:
        matrix[:, 0] *= -1
    move = SIDE / 2 - 0.5 - matrix @ (np.full(2, AROUND / 2 - 0.5) + rng.normal(0, jitter[0], 2) * HAND)
    to_window = np.column_stack([matrix, move])
    border = cv2.BORDER_REPLICATE
    window = cv2.warpAffine(picture, to_window, (SIDE, SIDE), flags=cv2.INTER_LINEAR, borderMode=border)
    if rng.random() < 0.4:
        window = cv2.GaussianBlur(window, (0, 0), rng.uniform(0.3, 1.4))
    if rng.random() < 0.8:
        levels = np.linspace(0, 1, 256)[:, None] ** np.exp(rng.normal(0, 0.25))
        levels = levels * np.exp(rng.normal(0, 0.15) + rng.normal(0, 0.06, 3))
        window = cv2.LUT(window, np.clip(levels * 255, 0, 255).astype(np.uint8)[:, None])
    if rng.random() < 0.4:
        slope = rng.normal(0, 0.25, 2).astype(np.float32)
        ramp = np.linspace(-1, 1, SIDE, dtype=np.float32)
        window = np.clip(window * (1 + slope[0] * ramp[:, None] + slope[1] * ramp)[..., None], 0, 255).astype(np.uint8)
    if rng.random() < 0.5:
        noise = rng.standard_normal(window.shape, np.float32) * np.float32(rng.uniform(0, 8))
        window = np.clip(window + noise, 0, 255).astype(np.uint8)
    return look(window)


def batch(data: dict[str, np.ndarray], chosen: np.ndarray, seed: int, pool: ThreadPoolExecutor) -> torch.Tensor:
    """Return varied looks (n, 4, 80, 80)."""

    def one(k: int) -> np.ndarray:
        return varied(data["pictures"][k], bool(data["spots"][k]), np.random.default_rng([seed, k]))

    return torch.from_numpy(np.stack(list(pool.map(one, chosen)))).permute(0, 3, 1, 2)


def plain(data: dict[str, np.ndarray], chosen: np.ndarray) -> torch.Tensor:
    """Return looks as they are asked."""
    edge = (AROUND - SIDE) // 2
    inside = slice(edge, edge + SIDE)
    return torch.from_numpy(np.stack([look(data["pictures"][k][inside, inside]) for k in chosen])).permute(0, 3, 1, 2)


def report(net: Net, data: dict[str, np.ndarray], chosen: np.ndarray, classes: np.ndarray) -> str:
    """Say how many of found windows are named rightly: postures, and what is none of them."""
    net.eval()
    said = []
    with torch.no_grad():
        for k in range(0, len(chosen), 256):
            said.append(net(plain(data, chosen[k : k + 256])).softmax(1).numpy())
    shares = np.concatenate(said)
    labels = data["labels"][chosen]
    known = np.array([c != NO_HAND and not c.startswith("irrelevant") for c in classes])
    winner, sure = shares.argmax(1), shares.max(1)
    posture = known[np.searchsorted(classes, labels)]
    named = known[winner]
    right = classes[winner] == labels
    sure6 = sure > 0.6
    return (
        f"postures right {right[posture].mean():.3f}, surely {(right & sure6)[posture].mean():.3f}, "
        f"surely wrong {(named & ~right & sure6)[posture].mean():.3f}; "
        f"others surely named {(named & sure6)[~posture].mean():.3f}"
    )


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", type=Path, nargs="+")
    parser.add_argument("--epochs", type=int, default=24)
    parser.add_argument("--rate", type=float, default=3e-3)
    parser.add_argument("--kept-out", type=int, default=20, help="persons on whom it is reported on the way")
    parser.add_argument("--out", type=Path, default=Path("recognizer/postures/person") / FILE)
    asked = parser.parse_args()
    data = windows(asked.folders)
    classes, target = np.unique(data["labels"], return_inverse=True)
    names = np.unique(data["persons"][data["persons"] != "drawn"])
    out = np.isin(data["persons"], names[len(names) - asked.kept_out :])
    train, kept_out = np.flatnonzero(~out), np.flatnonzero(out & data["spots"])
    torch.manual_seed(0)
    rng = np.random.default_rng(0)
    net = Net(len(classes)).to(memory_format=torch.channels_last)
    print(f"{len(train)} windows, {sum(p.numel() for p in net.parameters())} weights", flush=True)
    best = torch.optim.AdamW(net.parameters(), lr=asked.rate, weight_decay=0.02)
    steps = max(1, min(EPOCH, len(train)) // BATCH)
    plan = torch.optim.lr_scheduler.OneCycleLR(best, asked.rate, total_steps=asked.epochs * steps)
    loss_of = nn.CrossEntropyLoss(label_smoothing=SMOOTHED)
    with ThreadPoolExecutor(2) as pool:
        for epoch in range(asked.epochs):
            net.train()
            order, losses = rng.permutation(train), []
            for k in range(steps):
                chosen = order[k * BATCH : (k + 1) * BATCH]
                with torch.autocast("cpu", torch.bfloat16):
                    named = net(batch(data, chosen, epoch, pool))
                loss = loss_of(named.float(), torch.from_numpy(target[chosen]))
                best.zero_grad()
                loss.backward()
                best.step()
                plan.step()
                losses.append(float(loss.detach()))
            np.savez_compressed(asked.out, classes=classes, **net.folded())
            said = report(net, data, kept_out, classes) if asked.kept_out else ""
            print(f"epoch {epoch + 1}: loss {np.mean(losses):.3f}; {said}", flush=True)


if __name__ == "__main__":
    main()
