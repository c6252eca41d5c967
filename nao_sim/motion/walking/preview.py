"""Preview control of the zero moment point: the cart-table model (Kajita et al. 2003; Katayama et al. 1985).

The robot is a point mass at a constant height z; the zero moment point is p = x - (z / g) x''. The controller chooses
the mass's jerk so that p follows a reference whose future is known. It minimises

    Σ  Q (p - p_ref)² + (Δstate)ᵀ Qx (Δstate) + R Δjerk²

which is a linear-quadratic problem with integral action: gains on the summed error, on the state and on the preview.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_discrete_are

from nao_sim.motion.walking.gait import Preview

GRAVITY = 9.81


@dataclass(frozen=True)
class CartTable:
    """The discrete model and its preview gains.

    Attributes:
        transition: (3, 3), of the state position, velocity, acceleration.
        effect: (3,), of the jerk.
        output: (3,), zero moment point of a state.
        on_error: gain on the summed error.
        on_state: (3,), gains on the state.
        on_preview: (n,), gains on the next n references.
    """

    transition: NDArray[np.float64]
    effect: NDArray[np.float64]
    output: NDArray[np.float64]
    on_error: float
    on_state: NDArray[np.float64]
    on_preview: NDArray[np.float64]


def cart_table(height: float, period: float, weights: Preview) -> CartTable:
    """Return the model of a mass at ``height`` m, controlled every ``period`` s, and its gains."""
    t = period
    transition = np.array([[1, t, t * t / 2], [0, 1, t], [0, 0, 1]])
    effect = np.array([t**3 / 6, t * t / 2, t])
    output = np.array([1.0, 0.0, -height / GRAVITY])
    # The augmented state is the error and the change of the state.
    a = np.zeros((4, 4))
    a[0, 0] = 1.0
    a[0, 1:] = output @ transition
    a[1:, 1:] = transition
    b = np.concatenate([[output @ effect], effect])
    q = np.diag([weights.zmp_error, *([weights.state_change] * 3)])
    p = solve_discrete_are(a, b[:, None], q, np.array([[weights.jerk]]))
    scale = 1.0 / (weights.jerk + b @ p @ b)
    gain = scale * (b @ p @ a)
    closed = a - np.outer(b, gain)
    steps = round(weights.horizon_s / period)
    preview = np.empty(steps)
    carried = closed.T @ p @ np.array([1.0, 0.0, 0.0, 0.0])
    preview[0] = gain[0]
    for step in range(1, steps):
        preview[step] = scale * (b @ carried)
        carried = closed.T @ carried
    return CartTable(transition, effect, output, float(gain[0]), gain[1:], preview)


def follow(model: CartTable, reference: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return how the mass moves so that its zero moment point follows a reference.

    Args:
        model: from :func:`cart_table`.
        reference: zero moment points, m, shape (n, d); the mass starts at rest over the first one, and the last one is
            held beyond the end.

    Returns:
        The mass's position, velocity and acceleration, shape (n, 3, d), and its zero moment point, shape (n, d).
    """
    ahead = len(model.on_preview)
    padded = np.concatenate([reference, np.repeat(reference[-1:], ahead, axis=0)])
    state = np.zeros((3, reference.shape[1]))
    state[0] = reference[0]
    summed = np.zeros(reference.shape[1])
    # Positions count from the start: the gains on state and preview are for a mass that starts at zero.
    states = np.empty((len(reference), 3, reference.shape[1]))
    for k in range(len(reference)):
        states[k] = state
        summed += model.output @ state - reference[k]
        offset = state.copy()
        offset[0] -= reference[0]
        future = padded[k + 1 : k + 1 + ahead] - reference[0]
        jerk = -model.on_error * summed - model.on_state @ offset + model.on_preview @ future
        state = model.transition @ state + np.outer(model.effect, jerk)
    return states, np.einsum("s,ksd->kd", model.output, states)
