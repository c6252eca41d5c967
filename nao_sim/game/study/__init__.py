"""Sessions gathered into studies: trials, children's results, and what a design lets one say."""

from nao_sim.game.study.children import ChildResult, child_results
from nao_sim.game.study.gather import Gathered, gather
from nao_sim.game.study.result import StudyResult, study_results
from nao_sim.game.study.single_case import CasePhase, CasePoint, ChildCase, child_cases
from nao_sim.game.study.trials import Trial, trials_of

__all__ = [
    "CasePhase",
    "CasePoint",
    "ChildCase",
    "ChildResult",
    "Gathered",
    "StudyResult",
    "Trial",
    "child_cases",
    "child_results",
    "gather",
    "study_results",
    "trials_of",
]
