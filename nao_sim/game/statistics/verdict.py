"""Three separate verdicts; "not different" is none of them."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.statistics.comparison import ALPHA, FEWEST, Comparison


@dataclass(frozen=True)
class Verdicts:
    """What a comparison lets one say.

    Attributes:
        different: whether a difference is shown; None where no test was made.
        equivalent: whether equivalence within the margin is shown; None where none was set beforehand, or no test.
        too_few: whether the children are too few to say.
        sentences: each verdict in words.
    """

    different: bool | None
    equivalent: bool | None
    too_few: bool
    sentences: tuple[str, str, str]


def verdicts_of(found: Comparison | None) -> Verdicts:
    """Judge a comparison; None (fewer than ``FEWEST`` children) is judged too."""
    if found is None:
        few = f"Too few children to say: with fewer than {FEWEST} a group there are pictures only."
        return Verdicts(None, None, True, ("Difference: not tested.", "Equivalence: not tested.", few))
    reachable = found.smallest_p <= ALPHA
    different = reachable and found.p <= ALPHA
    equivalent = None if found.equivalence_p is None else reachable and found.equivalence_p <= ALPHA
    decided = different or bool(equivalent)
    return Verdicts(
        different,
        equivalent,
        not decided,
        (_difference(found, different, reachable), _equivalence(found, equivalent), _enough(found, reachable, decided)),
    )


def _difference(found: Comparison, different: bool, reachable: bool) -> str:
    if different:
        return f"Difference: shown (p = {found.p:.3f})."
    can = "" if reachable else ", nor could it be"
    return f"Difference: not shown (p = {found.p:.3f}){can}; that is not the same as no difference."


def _equivalence(found: Comparison, equivalent: bool | None) -> str:
    if found.margin is None or found.equivalence_p is None:
        return "Equivalence: not asked; no margin was set beforehand."
    margin = f"within ±{100 * found.margin:.0f} percentage points, set beforehand"
    return f"Equivalence {margin}: {'shown' if equivalent else 'not shown'} (p = {found.equivalence_p:.3f})."


def _enough(found: Comparison, reachable: bool, decided: bool) -> str:
    reach = f"the smallest p this design can reach is {found.smallest_p:.4f} ({found.smallest} of {found.ways} ways)"
    if not reachable:
        return f"Too few children to say: {reach}, above {ALPHA}."
    if decided:
        return f"Enough children for this verdict: {reach}."
    return f"Too few children to say, neither difference nor equivalence is shown: {reach}, but chance is too wide."
