"""How often does a study without any difference say "difference"? At most 7 % may, at a nominal 5 %.

    python benchmarks/null_studies.py [--studies 2000] [--models 400] [--seed 1]

Each study has two groups of 4 to 8 children who differ in ability (SD 1 on the logit scale) and take 10 to 30 turns
each; both groups come from one population. Judged are the verdict that a report prints (exact permutation of children,
``compare_groups`` and ``verdicts_of``), the sensitivity model with t and with z, and, as a warning, Fisher's exact test
on the pooled turns, which no report of ours makes. Exit code 1 if the verdict raises more than 7 % in all studies
together or more than that beyond two standard errors in those of one size.
"""

from __future__ import annotations

import argparse
from fractions import Fraction

import numpy as np
from scipy.stats import fisher_exact, norm

from nao_sim.game.statistics import MixedModel, compare_groups, fit_mixed_model, verdicts_of

SIZES = (4, 5, 6, 7, 8)
ALLOWED = 0.07


def study(children: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return successes, turns and group of each child."""
    ability = rng.normal(0.0, 1.0, 2 * children)
    turns = rng.integers(10, 31, 2 * children)
    return rng.binomial(turns, 1 / (1 + np.exp(-ability))), turns, np.arange(2 * children) < children


def difference_said(k: np.ndarray, n: np.ndarray, first: np.ndarray) -> bool:
    """Whether a report would say that a difference is shown."""
    shares = [Fraction(int(a), int(b)) for a, b in zip(k, n, strict=True)]
    groups = [[s for s, mine in zip(shares, first, strict=True) if mine == group] for group in (True, False)]
    return bool(verdicts_of(compare_groups(groups[0], groups[1])).different)


def pooled(k: np.ndarray, n: np.ndarray, first: np.ndarray) -> bool:
    """Whether Fisher's test on all turns, children forgotten, would."""
    table = [[k[g].sum(), n[g].sum() - k[g].sum()] for g in (first, ~first)]
    return bool(fisher_exact(table).pvalue <= 0.05)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--studies", type=int, default=2000, help="of each size")
    parser.add_argument("--models", type=int, default=400, help="of these, how many also get the mixed model")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    print(f"{'children':>9} {'verdict':>9} {'model t':>9} {'model z':>9} {'no model':>9} {'pooled turns':>13}")
    said = np.zeros(len(SIZES))
    for row, children in enumerate(SIZES):
        rng = np.random.default_rng([args.seed, children])
        t, z, none, fisher = [], [], 0, 0
        for number in range(args.studies):
            data = study(children, rng)
            said[row] += difference_said(*data)
            fisher += pooled(*data)
            if number < args.models:
                model = fit_mixed_model(*data)
                if isinstance(model, MixedModel):
                    t.append(model.p <= 0.05)
                    z.append(2 * norm.sf(abs(model.log_odds_ratio / model.standard_error)) <= 0.05)
                else:
                    none += 1
        shares = (said[row] / args.studies, np.mean(t or [np.nan]), np.mean(z or [np.nan]))
        print(f"{children:>4} v {children:<2} " + " ".join(f"{100 * s:>7.1f} %" for s in shares), end=" ")
        print(f"{none:>9} {100 * fisher / args.studies:>11.1f} %", flush=True)
    total = said.sum() / (args.studies * len(SIZES))
    error = np.sqrt(ALLOWED * (1 - ALLOWED) / args.studies)
    print(f"all sizes: {100 * total:.1f} % of {args.studies * len(SIZES)} studies; allowed {100 * ALLOWED:.0f} %")
    raise SystemExit(int(total > ALLOWED or (said / args.studies).max() > ALLOWED + 2 * error))


if __name__ == "__main__":
    main()
