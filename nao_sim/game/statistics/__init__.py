"""Statistics of few children with few turns each: the child is the unit, turns are never pooled for a test."""

from nao_sim.game.statistics.comparison import ALPHA, Comparison, compare_groups, compare_pairs
from nao_sim.game.statistics.latency import LatencySummary, summarise_latency
from nao_sim.game.statistics.mixed_model import MixedModel, fit_mixed_model
from nao_sim.game.statistics.proportion import wilson_interval
from nao_sim.game.statistics.rearrangement import Rearrangements, exchanged_groups, flipped_signs
from nao_sim.game.statistics.single_case import PhasePair, nap, theil_sen_slope, trend_tau
from nao_sim.game.statistics.verdict import Verdicts, verdicts_of

__all__ = [
    "ALPHA",
    "Comparison",
    "LatencySummary",
    "MixedModel",
    "PhasePair",
    "Rearrangements",
    "Verdicts",
    "compare_groups",
    "compare_pairs",
    "exchanged_groups",
    "fit_mixed_model",
    "flipped_signs",
    "nap",
    "summarise_latency",
    "theil_sen_slope",
    "trend_tau",
    "verdicts_of",
    "wilson_interval",
]
