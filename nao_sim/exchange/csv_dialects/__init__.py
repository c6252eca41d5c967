"""CSV as people really have it: semicolons, decimal commas, byte-order marks, ids like 007, times of a clock."""

from nao_sim.exchange.csv_dialects.dialect import Dialect, detect_dialect
from nao_sim.exchange.csv_dialects.reading import Sheet, read_sheet
from nao_sim.exchange.csv_dialects.rows import rows_from
from nao_sim.exchange.csv_dialects.writing import write_sheet

__all__ = ["Dialect", "Sheet", "detect_dialect", "read_sheet", "rows_from", "write_sheet"]
