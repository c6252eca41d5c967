"""A cardboard puppet on a patterned wall, drawn with OpenCV: quick clips of known gestures for tests."""

from __future__ import annotations

import dataclasses

import cv2
import numpy as np

GESTURES = (
    "bye_two_hands", "bye_right", "bye_left", "stop", "yes", "no",
    "kowtow", "walk_left_to_right", "walk_right_to_left", "right_arm_up", "right_arm_down",
    "right_arm_rotation_cw", "right_arm_rotation_ccw", "right_arm_pointing_right", "left_arm_pointing_left",
)  # fmt: skip
IRRELEVANT = ("stand", "scratch_head", "arms_overhead", "left_arm_up", "clap", "step_aside", "left_stop")


@dataclasses.dataclass
class Pose:
    """Right and left arm (raise from hanging outwards, forearm's own raise [deg], reach 0…1), head, body."""

    right: tuple[float, float, float] = (8.0, 6.0, 1.0)
    left: tuple[float, float, float] = (8.0, 6.0, 1.0)
    nod: float = 0.0  # head heights, face down
    shake: float = 0.0  # head heights, face to image right
    bow: float = 0.0  # 0 upright … 1 horizontal
    shift: float = 0.0  # stature units, image right


def _ramp(t: float, begin: float, end: float) -> float:
    """Minimum-jerk course from 0 before ``begin`` to 1 after ``end``."""
    s = min(1.0, max(0.0, (t - begin) / (end - begin)))
    return s**3 * (10 - 15 * s + 6 * s * s)


def _mix(a: tuple[float, ...], b: tuple[float, ...], s: float) -> tuple[float, float, float]:
    return tuple(x + (y - x) * s for x, y in zip(a, b, strict=True))  # type: ignore[return-value]


def pose(gesture: str, t: float, cycles: int, size: float) -> Pose:
    """Pose at the moment t (0…1) of a gesture."""
    rest = (8.0, 6.0, 1.0)
    there_and_back = _ramp(t, 0.05, 0.25) - _ramp(t, 0.78, 0.95)
    swing = np.sin(2 * np.pi * cycles * (t - 0.2) / 0.6) * (0.2 < t < 0.8)
    wave = _mix(rest, (35.0, 160.0 + 25 * size * swing, 1.0), there_and_back)
    out = Pose()
    if gesture in ("bye_right", "bye_two_hands"):
        out.right = wave
    if gesture in ("bye_left", "bye_two_hands"):
        out.left = wave
    if gesture == "stop":
        out.right = _mix(rest, (20.0, 150.0, 0.45), _ramp(t, 0.1, 0.4))
    if gesture == "left_stop":
        out.left = _mix(rest, (20.0, 150.0, 0.45), _ramp(t, 0.1, 0.4))
    if gesture == "yes":
        out.nod = 0.22 * size * abs(np.sin(np.pi * cycles * t))
    if gesture == "no":
        out.shake = 0.26 * size * np.sin(2 * np.pi * cycles * t)
    if gesture == "kowtow":
        out.bow = _ramp(t, 0.05, 0.45) - _ramp(t, 0.55, 0.95)
    if gesture.startswith("walk"):
        out.shift = (t - 0.5) * 3.2 * (1 if gesture == "walk_left_to_right" else -1)
    up = _ramp(t, 0.1, 0.8)
    if gesture == "right_arm_up":
        out.right = _mix(rest, (172.0, 172.0, 1.0), up)
    if gesture == "right_arm_down":
        out.right = _mix((172.0, 172.0, 1.0), rest, up)
    if gesture == "left_arm_up":
        out.left = _mix(rest, (172.0, 172.0, 1.0), up)
    if gesture == "right_arm_rotation_cw":  # the camera's clock: outwards on the image's left, up, over, down
        out.right = _mix(rest, (368.0, 368.0, 1.0), up)
    if gesture == "right_arm_rotation_ccw":
        out.right = _mix(rest, (-352.0, -352.0, 1.0), up)
    if gesture == "right_arm_pointing_right":
        out.right = _mix(rest, (90.0, 90.0, 1.0), _ramp(t, 0.1, 0.5))
    if gesture == "left_arm_pointing_left":
        out.left = _mix(rest, (90.0, 90.0, 1.0), _ramp(t, 0.1, 0.5))
    if gesture == "scratch_head":
        out.left = _mix(rest, (75.0, 225.0 + 8 * swing, 0.9), there_and_back)
    if gesture == "arms_overhead":
        out.right = out.left = _mix(rest, (170.0, 185.0, 1.0), there_and_back)
    if gesture == "clap":
        out.right = out.left = _mix(rest, (25.0, -75.0 - 20 * swing, 0.8), there_and_back)
    if gesture == "step_aside":
        out.shift = 0.25 * _ramp(t, 0.2, 0.7)
    return out


def draw(canvas: np.ndarray, p: Pose, x: float, top: float, stature: float, colours: np.ndarray) -> None:
    """Draw the puppet into a BGR image; x of the body axis, top of the head and stature in pixels."""
    skin, shirt, trousers, hair = (tuple(int(c) for c in colour) for colour in colours)
    head = stature / 7.5
    x += p.shift * stature
    drop = p.bow * 1.9 * head
    neck_y, hip_y = top + 1.25 * head + drop, top + 3.9 * head
    shoulder_y, half = neck_y + 0.3 * head, 0.85 * head
    width = max(1, round(0.42 * head))

    def at(px: float, py: float) -> tuple[int, int]:
        return round(px * 16), round(py * 16)

    def line(a: tuple[float, float], b: tuple[float, float], colour: tuple[int, ...], w: int) -> None:
        cv2.line(canvas, at(*a), at(*b), colour, w, cv2.LINE_AA, 4)

    stride = np.sin(p.shift * 14) * 0.5 * head if abs(p.shift) > 0 else 0.0
    for side in (-1, 1):
        line(
            (x + side * 0.4 * head, hip_y),
            (x + side * (0.4 * head + stride), top + stature),
            trousers,
            round(0.6 * head),
        )
    body = np.array(
        [at(x - half, shoulder_y), at(x + half, shoulder_y), at(x + 0.65 * head, hip_y), at(x - 0.65 * head, hip_y)]
    )
    cv2.fillPoly(canvas, [body], shirt, cv2.LINE_AA, 4)
    for side, arm in ((-1, p.right), (1, p.left)):
        raise_, fore, reach = np.radians(arm[0]), np.radians(arm[1]), arm[2]
        joint = (x + side * half, shoulder_y + 0.15 * head)
        elbow = (
            joint[0] + side * np.sin(raise_) * 1.45 * head * reach,
            joint[1] + np.cos(raise_) * 1.45 * head * reach,
        )
        hand = (elbow[0] + side * np.sin(fore) * 1.5 * head, elbow[1] + np.cos(fore) * 1.5 * head)
        line(joint, elbow, shirt, width)
        line(elbow, hand, skin, max(1, round(0.8 * width)))
        cv2.circle(canvas, at(*hand), round(0.3 * head * 16), skin, -1, cv2.LINE_AA, 4)
    centre = (x, neck_y - 0.75 * head)
    axes = (round(0.38 * head * 16), round(0.5 * head * 16))
    cv2.ellipse(canvas, at(*centre), axes, 0, 0, 360, skin, -1, cv2.LINE_AA, 4)
    cv2.ellipse(canvas, at(centre[0], centre[1] - 0.12 * head), axes, 0, 180, 360, hair, -1, cv2.LINE_AA, 4)
    for eye in (-0.14, 0.14):
        spot = at(centre[0] + (eye + p.shake) * head, centre[1] + (0.05 + p.nod) * head)
        cv2.circle(canvas, spot, max(8, round(0.06 * head * 16)), hair, -1, cv2.LINE_AA, 4)
    line((centre[0] + (p.shake - 0.1) * head, centre[1] + (0.27 + p.nod) * head),
         (centre[0] + (p.shake + 0.1) * head, centre[1] + (0.27 + p.nod) * head), (60, 60, 150), max(1, round(0.05 * head)))  # fmt: skip


def film(
    gesture: str,
    seed: int,
    fps: float = 15.0,
    size: tuple[int, int] = (160, 120),
    noise: float = 2.0,
    rest: float = 0.4,
    truth: dict[str, float] | None = None,
) -> np.ndarray:
    """Film one gesture by one puppet; person, clothes, room, framing and tempo are drawn from the seed.

    Args:
        gesture: one of GESTURES or IRRELEVANT.
        seed: of everything drawn at random.
        fps: frames per second.
        size: width and height [px].
        noise: standard deviation of the sensor's noise [grey levels].
        rest: seconds of rest before and after.
        truth: filled with the head's centre x, y and height [px] at rest.

    Returns:
        (n, height, width, 3) uint8 BGR.
    """
    rng = np.random.default_rng(seed)
    width, height = size
    wall = cv2.resize(rng.integers(60, 200, (5, 7, 3), dtype=np.uint8), size, interpolation=cv2.INTER_CUBIC)
    for _ in range(6):
        corner = rng.integers(0, [width, height])
        cv2.rectangle(
            wall, corner.tolist(), (corner + rng.integers(8, 50, 2)).tolist(), rng.integers(0, 255, 3).tolist(), -1
        )
    stature = height * rng.uniform(0.7, 1.6)
    head_top = height * rng.uniform(0.24, 0.30) if stature > height else (height - stature) * rng.uniform(0.5, 0.9)
    head_top = max(head_top, 0.17 * stature)
    x = width * rng.uniform(0.42, 0.58)
    if truth is not None:
        truth.update(x=x, y=head_top + stature / 15, head=stature / 7.5)
    colours = np.array([[110, 150, 210], *rng.integers(0, 255, (2, 3)), [30, 30, 40]])
    colours[0] = colours[0] * rng.uniform(0.5, 1.1)
    cycles, amplitude = int(rng.integers(2, 5)), rng.uniform(0.8, 1.2)
    seconds = {"yes": 0.55, "no": 0.7}.get(gesture, 0.5) * cycles + (0.9 if "bye" in gesture else 0)
    seconds = (seconds if gesture in ("yes", "no") or "bye" in gesture else 2.0) * rng.uniform(0.8, 1.3)
    frames = []
    for i in range(round((seconds + 2 * rest) * fps)):
        t = min(1.0, max(0.0, (i / fps - rest) / seconds))
        p = pose(gesture, t, cycles, amplitude)
        canvas = wall.copy()
        sway = 0.004 * stature * np.sin(1.3 * i / fps + seed)
        draw(canvas, p, x + sway, head_top, stature, colours)
        frames.append(canvas)
    stack = np.array(frames, np.float32)
    if noise:
        stack += rng.normal(0, noise, stack.shape).astype(np.float32)
    return stack.clip(0, 255).astype(np.uint8)
