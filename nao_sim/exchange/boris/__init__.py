"""BORIS projects (``.boris``, format 7.0): sessions out as observations, coded events in."""

from nao_sim.exchange.boris.export import export_boris
from nao_sim.exchange.boris.merge import merge_boris
from nao_sim.exchange.boris.project import boris_faults, parse_boris

__all__ = ["boris_faults", "export_boris", "merge_boris", "parse_boris"]
