"""The keys ``turns`` and ``models`` of a participant: where what they do comes from."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from nao_sim.errors import did_you_mean
from nao_sim.game.errors import GameError
from nao_sim.game.session.keys import Keys
from nao_sim.game.session.sources import Actor, Camera, Cut, Films, LongFilm, Robot, Source, Try, Unseen
from nao_sim.game.tables.words import EXCLUSIONS, PROMPT_LEVELS
from recognizer import RecognizerError, open_clip

_KINDS = ("films", "film", "camera", "actor")
_WRITE = (
    'write { films = "C07_*.mp4" }, { film = "session.mp4", cuts = "auto" }, { camera = 0 }, { actor = 7 }, "robot" '
    'or "unseen"'
)


def read_source(keys: Keys, key: str, folder: Path, default: Source | None = None) -> Source:
    """Read where turns come from.

    Args:
        keys: the participant's table.
        key: ``turns`` or ``models``.
        folder: that films are relative to.
        default: where the key may be left out.

    Raises:
        GameError: no such source, or a film that cannot be opened.
    """
    if key not in keys:
        if default is None:
            raise keys.error(key, f"is missing; {_WRITE}")
        return default
    value = keys.raw(key)
    if value == "robot":
        return Robot()
    if value == "unseen":
        return Unseen()
    if not isinstance(value, dict):
        raise keys.error(key, f"is {value!r}; {_WRITE}")
    table = keys.table(key)
    kinds = [kind for kind in _KINDS if kind in value]
    if len(kinds) != 1:
        odd = next((name for name in value if name not in _KINDS), None)
        hint = did_you_mean(odd, _KINDS) if odd and not kinds else ""
        raise keys.error(key, f"names {len(kinds)} of films, film, camera, actor{hint}; {_WRITE}")
    readers: dict[str, Callable[[Keys, Path], Source]] = {
        "films": _films, "film": _long_film, "camera": _camera, "actor": _actor,
    }  # fmt: skip
    source = readers[kinds[0]](table, folder)
    table.nothing_else()
    return source


def _films(keys: Keys, folder: Path) -> Films:
    value = keys.raw("films")
    if isinstance(value, str):
        found = sorted(folder.glob(value)) if not Path(value).is_absolute() else []
        if not found:
            raise keys.error("films", f"'{value}' matches no file in {folder or '.'}; check the pattern")
        value = [str(path.relative_to(folder)) for path in found]
    if not isinstance(value, list) or not value:
        raise keys.error("films", 'is no list; write films = ["turn1.mp4", "turn2.mp4"] or films = "C07_*.mp4"')
    turns = [_tries(item, f"films[{k}]", keys, lambda row: _file(row, folder)) for k, item in enumerate(value, 1)]
    return Films(tuple(turns), keys.flag("starts_at_model_end"))


def _long_film(keys: Keys, folder: Path) -> Source:
    film = folder / keys.text("film")
    _check_film(film, keys, "film")
    cuts = keys.raw("cuts", "auto")
    flag = keys.flag("starts_at_model_end")
    if cuts == "auto":
        return LongFilm(film, flag)
    if not isinstance(cuts, list) or not cuts:
        raise keys.error("cuts", 'is no list; write cuts = [[12.0, 16.5], [20.1, 24.0]] in seconds, or "auto"')
    turns = [_tries(item, f"cuts[{k}]", keys, lambda row: _piece(row, film)) for k, item in enumerate(cuts, 1)]
    return Films(tuple(turns), flag)


def _tries(item: Any, where: str, keys: Keys, cut_of: Callable[[Keys], Cut | None]) -> tuple[Try, ...]:
    """Read one turn: a film or a piece of one, a table with more about it, or a list of tries after rising prompts."""
    if isinstance(item, dict) and "tries" in item:
        rows = Keys(item, "", "").tables("tries")
        if not rows or len(item) > 1:
            raise keys.error(where, "has tries beside other keys or none; write { tries = [{ … }, { … }] }")
    else:
        rows = [item if isinstance(item, dict) else {"cut": item}]
    tries = tuple(_try(row, where, keys, cut_of) for row in rows)
    levels = [attempt.prompt for attempt in tries]
    if levels != sorted(set(levels)):
        raise keys.error(where, f"has tries with prompts {levels}; each needs more help than the one before")
    return tries


def _try(row: dict[str, Any], where: str, keys: Keys, cut_of: Callable[[Keys], Cut | None]) -> Try:
    inner = keys.below(row, where)
    cut = cut_of(inner)
    prompt = inner.whole("prompt", 0, 0, max(PROMPT_LEVELS)) or 0
    excluded = inner.choice("excluded", tuple(EXCLUSIONS)) if "excluded" in inner else None
    inner.nothing_else()
    return Try(cut, prompt, excluded)


def _file(row: Keys, folder: Path) -> Cut | None:
    """Read ``"turn1.mp4"``, ``"none"``, or a table with ``film`` and perhaps ``from`` and ``to``."""
    key = "film" if "film" in row else "cut"
    value = row.raw(key, "none" if "excluded" in row else None)
    if value == "none":
        return None
    if not isinstance(value, str) or not value:
        raise row.error(key, f'is {value!r}; write the name of a film, or "none" where nobody moved')
    _check_film(folder / value, row, key)
    span = (row.number("from", None, 0, 1e6, " s"), row.number("to", None, 0, 1e6, " s"))
    return _ordered(Cut(folder / value, *span), row)


def _piece(row: Keys, film: Path) -> Cut | None:
    """Read ``[from, to]``, ``"none"``, or a table with ``from`` and ``to``."""
    value = row.raw("cut", "none" if "excluded" in row and "from" not in row else None)
    if value == "none":
        return None
    if value is None and "from" in row and "to" in row:
        value = [row.raw("from"), row.raw("to")]
    numbers = isinstance(value, list) and all(isinstance(v, int | float) and not isinstance(v, bool) for v in value)
    if not isinstance(value, list) or len(value) != 2 or not numbers:
        raise row.error("cut", f'is {value!r}; write [from, to] in seconds, or "none" where nobody moved')
    return _ordered(Cut(film, float(value[0]), float(value[1])), row)


def _ordered(cut: Cut, row: Keys) -> Cut:
    if cut.from_s is not None and cut.to_s is not None and not 0 <= cut.from_s < cut.to_s:
        raise row.error("to", f"is {cut.to_s:g} s, not after {cut.from_s:g} s; write the start first")
    return cut


def _check_film(path: Path, keys: Keys, key: str) -> None:
    try:
        open_clip(path)
    except RecognizerError as error:
        raise keys.error(key, f"cannot be used: {error}") from None


def _camera(keys: Keys, folder: Path) -> Camera:
    value = keys.raw("camera")
    if isinstance(value, bool) or not isinstance(value, int | str) or value == "":
        raise keys.error("camera", f'is {value!r}; write the device\'s number, as 0, or an address, as "rtsp://…"')
    return Camera(value)


def _actor(keys: Keys, folder: Path) -> Actor:
    seed = keys.whole("actor", None, 0, 2**31 - 1)
    if seed is None:
        raise GameError("an actor needs a seed")  # the caller has seen the key
    shares = {
        name: keys.number(name, getattr(Actor, name), 0, 1) for name in ("follows", "helped", "unrelated", "mirrors")
    }
    return Actor(seed, keys.flag("child", True), **{name: float(value or 0) for name, value in shares.items()})
