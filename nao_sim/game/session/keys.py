"""A table of a session file, read key by key; every refusal is one line with the key and the mend."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

from nao_sim.errors import did_you_mean
from nao_sim.game.errors import GameError


class Keys:
    """The keys of one table.

    Args:
        table: what TOML made of it.
        name: the table's own name, as ``game`` or ``participant C07``; empty for the top of the file.
        file: the file, for messages.
    """

    def __init__(self, table: dict[str, Any], name: str, file: str) -> None:
        self._table, self._name, self._file = table, name, file
        self._read: set[str] = set()

    def error(self, key: str, what: str) -> GameError:
        """Return the error that names a key of this table; ``what`` is the fault and the mend."""
        where = f"{self._name}.{key}" if self._name else key
        return GameError(f"{self._file}: {where} {what}")

    def __contains__(self, key: str) -> bool:
        return key in self._table

    def raw(self, key: str, default: Any = None) -> Any:
        """Return a value as it stands."""
        self._read.add(key)
        return self._table.get(key, default)

    def required(self, key: str, mend: str) -> None:
        """Refuse a table without a key."""
        if key not in self._table:
            raise self.error(key, f"is missing; {mend}")

    def text(self, key: str, default: str = "") -> str:
        """Return one line of text."""
        value = self.raw(key, default)
        if not isinstance(value, str) or "\n" in value:
            raise self.error(key, f'is {value!r}; write one line of text in quotes, as {key} = "…"')
        return value.strip()

    def choice(self, key: str, allowed: Sequence[str], default: str | None = None) -> str:
        """Return one of several words."""
        if default is None:
            self.required(key, f"write one of {', '.join(allowed)}")
        value = self.raw(key, default)
        if value not in allowed:
            raise self.error(key, f"is {value!r}{_nearest(value, allowed)}")
        return str(value)

    def number(self, key: str, default: float | None, low: float, high: float, unit: str = "") -> float | None:
        """Return a number within bounds; ``default`` where the key is absent."""
        value = self.raw(key, default)
        if value is None:
            return None
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise self.error(key, f"is {value!r}; write a number from {low:g} to {high:g}{unit}")
        if not low <= value <= high:
            raise self.error(key, f"is {value:g}; choose from {low:g} to {high:g}{unit}")
        return float(value)

    def whole(self, key: str, default: int | None, low: int, high: int) -> int | None:
        """Return a whole number within bounds."""
        value = self.raw(key, default)
        if value is None:
            return None
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise self.error(key, f"is {value!r}; write a whole number from {low} to {high}")
        return value

    def flag(self, key: str, default: bool = False) -> bool:
        """Return true or false."""
        value = self.raw(key, default)
        if not isinstance(value, bool):
            raise self.error(key, f"is {value!r}; write true or false")
        return value

    def names(self, key: str, default: Sequence[str] | None = None) -> tuple[str, ...]:
        """Return a list of words without doubles."""
        if default is None:
            self.required(key, f'write a list, as {key} = ["…", "…"]')
        value = self.raw(key, list(default or ()))
        if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
            raise self.error(key, f'is {value!r}; write a list, as {key} = ["…", "…"]')
        twice = next((item for item in value if value.count(item) > 1), None)
        if twice is not None:
            raise self.error(key, f"names '{twice}' twice; name it once")
        return tuple(value)

    def table(self, key: str) -> Keys:
        """Return a table below this one; an empty one where it is absent."""
        value = self.raw(key, {})
        if not isinstance(value, dict):
            raise self.error(key, f"is {value!r}; write it as a table, [{key}]")
        return Keys(value, f"{self._name}.{key}" if self._name else key, self._file)

    def tables(self, key: str) -> list[dict[str, Any]]:
        """Return a list of tables below this one."""
        value = self.raw(key, [])
        if not isinstance(value, list) or not all(isinstance(item, dict) for item in value):
            raise self.error(key, f"is no list of tables; write [[{key}]] above each")
        return value

    def below(self, table: dict[str, Any], name: str) -> Keys:
        """Return a table that stands inside a list of this one, under the name messages call it by."""
        return Keys(table, f"{self._name}.{name}" if self._name else name, self._file)

    def nothing_else(self) -> None:
        """Refuse keys that nobody has asked for.

        Raises:
            GameError: the first such key, with the nearest known one.
        """
        for key in self._table:
            if key not in self._read:
                raise self.error(key, f"is unknown{did_you_mean(key, sorted(self._read))}")


def _nearest(value: object, allowed: Iterable[str]) -> str:
    if isinstance(value, str):
        return did_you_mean(value, allowed)
    return f"; write one of {', '.join(allowed)}"
