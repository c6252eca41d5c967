"""The tidy tables of a session: what was agreed, every turn, every rating, every other event.

``sessions``, ``turns``, ``ratings`` and ``events`` are frozen dataclasses, one instance a row; each is stored as
Parquet and as CSV (``docs/turns.md`` lists the columns). A rating never touches a turn and a turn never a rating:
they meet by ``turn_id`` alone.
"""

from nao_sim.game.tables.checks import check_tables
from nao_sim.game.tables.csv_text import from_csv, to_csv
from nao_sim.game.tables.event import Event
from nao_sim.game.tables.folder import Tables, is_folder_of_tables, read_tables, write_tables
from nao_sim.game.tables.rating import Rating
from nao_sim.game.tables.session import Session
from nao_sim.game.tables.turn import Turn

__all__ = [
    "Event",
    "Rating",
    "Session",
    "Tables",
    "Turn",
    "check_tables",
    "from_csv",
    "is_folder_of_tables",
    "read_tables",
    "to_csv",
    "write_tables",
]
