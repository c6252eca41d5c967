"""ELAN's annotation files (EAF 3.0): a session out, and what people added in ELAN back in."""

from nao_sim.exchange.elan.export import export_eaf
from nao_sim.exchange.elan.merge import merge_eaf
from nao_sim.exchange.elan.rules import eaf_faults
from nao_sim.exchange.elan.xml_text import parse_eaf

__all__ = ["eaf_faults", "export_eaf", "merge_eaf", "parse_eaf"]
