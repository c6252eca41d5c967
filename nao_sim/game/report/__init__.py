"""From sessions' folders to one HTML file that needs no network, and the tables beside it."""

from nao_sim.game.report.write import Report, make_report, write_report

__all__ = ["Report", "make_report", "write_report"]
