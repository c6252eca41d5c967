"""How far raters agree, turn by turn: percent, kappa, alpha and the table itself.

The unit is the turn, aligned by its key. The kappas of ELAN and BORIS compare states in slices of time, in which
agreed silence counts as agreement; they answer another question and are not comparable with these.
"""

from nao_sim.game.agreement.alpha import nominal_alpha
from nao_sim.game.agreement.kappa import cohen_kappa
from nao_sim.game.agreement.measure import Measure
from nao_sim.game.agreement.pairs import PairAgreement, pair_agreement
from nao_sim.game.agreement.panel import Panel, panel_of

__all__ = ["Measure", "PairAgreement", "Panel", "cohen_kappa", "nominal_alpha", "pair_agreement", "panel_of"]
