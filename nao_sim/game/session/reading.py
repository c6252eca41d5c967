"""A session file in TOML, read and checked as a whole before anything is played."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from nao_sim.errors import did_you_mean
from nao_sim.game.errors import GameError
from nao_sim.game.session.keys import Keys
from nao_sim.game.session.possible import check_possible
from nao_sim.game.session.session import Orientation, Participant, Prompting, Scoring, SessionFile
from nao_sim.game.session.source_keys import read_source
from nao_sim.game.session.sources import Robot, Source
from nao_sim.game.tables.words import CONDITIONS, DESIGNS, OUTCOMES, PROMPT_LEVELS, ROLES, RULES, SCALES
from nao_sim.game.words import words_table
from nao_sim.gestures import library, vocabulary

_NAME = re.compile(r"[^\W_][\w.-]{0,39}")


def read_session(path: str | Path, films: Path | None = None) -> SessionFile:
    """Read a session file.

    Args:
        path: the TOML file.
        films: the folder that films in it are relative to; None: the one it stands in.

    Raises:
        GameError: missing, no TOML, or impossible; one line with the key and the mend.
    """
    path = Path(path)
    top, folder = Keys(_parse(path), "", path.name), films or path.parent
    study, game = top.table("study"), top.table("game")
    orientation, prompting, scoring = _orientation(top), _prompting(top), _scoring(top)
    circle = tuple(_participant(row, k, path, folder) for k, row in enumerate(top.tables("participant"), 1))
    words = top.table("words")
    said = {key: words.text(key) for key in words_table() if key in words}
    words.raw("", None)
    for key in words_table():
        words.raw(key)
    words.nothing_else()
    gestures = game.names("gestures")
    session = SessionFile(
        path=path,
        name=_name(top, "session", path.stem),
        note=top.text("note"),
        circle=circle,
        condition=study.choice("condition", CONDITIONS),
        design=study.choice("design", DESIGNS),
        assignment=study.text("assignment"),
        randomised=study.flag("randomised"),
        stratum=study.text("stratum") or None,
        number=study.whole("number", None, 1, 1000),
        primary_outcome=study.choice("primary_outcome", tuple(OUTCOMES), "independent"),
        margin=study.number("margin", None, 0.0, 1.0),
        primary_rater=study.text("primary_rater") or None,
        gestures=gestures,
        order=game.choice("order", ("fixed", "drawn"), "drawn"),
        seed=game.whole("seed", None, 0, 2**63 - 1),
        direction=game.choice("direction", ("clockwise", "counterclockwise"), "clockwise"),
        turns=game.whole("turns", None, 0, 1000),
        minutes=game.number("minutes", None, 0.1, 120, " minutes"),
        baseline=game.whole("baseline", 0, 0, 200) or 0,
        timeout_s=game.number("timeout_s", 10.0, 1, 120, " seconds") or 10.0,
        among=_among(game, gestures),
        mirror=game.flag("mirror"),
        orientation=orientation,
        prompting=prompting,
        scoring=scoring,
        words=said,
    )
    for keys in (study, game, top):
        keys.nothing_else()
    check_possible(session, top, study, game)
    return session


def _parse(path: Path) -> dict[str, Any]:
    if not path.is_file():
        what = "is a folder; give the session file" if path.is_dir() else "is not there; nao-sim game --new writes one"
        raise GameError(f"{path} {what}")
    try:
        return tomllib.loads(path.read_bytes().decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise GameError(f"{path} is not UTF-8 text (byte {error.start}); save it as UTF-8") from None
    except tomllib.TOMLDecodeError as error:
        raise GameError(f"{path} is not TOML: {error}; texts need quotes, lists need [ ]") from None


def _name(keys: Keys, key: str, default: str) -> str:
    name = keys.text(key, default)
    if not _NAME.fullmatch(name):
        raise keys.error(key, f"is '{name}'; write a short word of letters, digits, '-', '_' and '.', no real name")
    return name


def _participant(row: dict[str, Any], number: int, path: Path, folder: Path) -> Participant:
    shown = row.get("id") if isinstance(row.get("id"), str) else number
    keys = Keys(row, f"participant {shown}", path.name)
    keys.required("id", 'write a pseudonym, as id = "C07"')
    name = _name(keys, "id", "")
    role = keys.choice("role", ROLES)
    turns: Source = read_source(keys, "turns", folder, Robot() if role == "robot" else None)
    models = read_source(keys, "models", folder) if "models" in keys else None
    if (role == "robot") != isinstance(turns, Robot) or (isinstance(models, Robot) and role != "robot"):
        mend = "leave turns out" if role == "robot" else 'give role = "robot" to the robot alone'
        raise keys.error("turns", f"does not suit role '{role}'; {mend}")
    own = keys.flag("own_choice")
    keys.nothing_else()
    return Participant(name, role, turns, models, own)


def _orientation(top: Keys) -> Orientation:
    keys = top.table("orientation")
    made = Orientation(
        still_s=keys.number("still_s", 3.0, 0, 900, " seconds") or 0.0,
        gestures=playable(keys.names("gestures", ()), keys, "gestures"),
    )
    keys.nothing_else()
    return made


def _prompting(top: Keys) -> Prompting:
    keys = top.table("prompts")
    highest = keys.whole("highest", 2, 0, max(PROMPT_LEVELS))
    made = Prompting(2 if highest is None else highest, keys.flag("praise", True))
    keys.nothing_else()
    return made


def _scoring(top: Keys) -> Scoring:
    keys = top.table("score")
    rule = keys.choice("rule", tuple(RULES), "same_class")
    text = keys.text("text")
    table = keys.table("related")
    rows = keys.raw("related", {})
    related = {target: playable(table.names(target), table, target) for target in playable(rows, keys, "related")}
    if rule == "custom" and (not text or not related):
        raise keys.error("text" if not text else "related", "is missing; a custom rule needs its text and its table")
    if rule != "custom" and related:
        raise keys.error("related", f'is only read with rule = "custom", not "{rule}"; leave one of them out')
    scale = keys.choice("scale", SCALES, "0/1")
    success = keys.whole("success_at", 1, 1, 2 if scale == "0/1/2" else 1)
    keys.nothing_else()
    return Scoring(rule, text or RULES[rule], related, scale, success or 1)


def _among(game: Keys, gestures: tuple[str, ...]) -> tuple[str, ...] | None:
    """Return what the recogniser decides between: by default what is in play, on either side.

    An intermediate gesture, which could carry a message or none, is decided by the context (thesis, appendix 2): what
    is in play is what may be meant.
    """
    value = game.raw("among", "in play")
    if value == "all":
        return None
    if value == "in play":
        known = library()
        return tuple(sorted({name for g in gestures for name in (g, known[g].mirror if g in known else g)}))
    if not isinstance(value, list):
        raise game.error("among", f'is {value!r}; write "in play", "all", or a list of gestures')
    return game.names("among")


def playable(names: Iterable[str], keys: Keys, key: str) -> tuple[str, ...]:
    """Return the names, or refuse the first that is no communicative gesture (thesis, appendix 2).

    Raises:
        GameError: an unknown gesture, or one that carries no message.
    """
    words, gestures = vocabulary(), library()
    names = tuple(names)
    for name in names:
        if name not in words and (name not in gestures or gestures[name].family == "game"):
            raise keys.error(key, f"names an unknown gesture '{name}'{did_you_mean(name, _playable_names())}")
        entry = words[name] if name in words else words.get(gestures[name].mirror)
        if entry is None or not entry.playable:
            raise keys.error(
                key,
                f"names '{name}', which carries no message: it exists to test features (thesis, appendix 2); "
                "only communicative gestures are played, take it out",
            )
    return names


def _playable_names() -> list[str]:
    return [name for name, entry in vocabulary().items() if entry.playable]


def checked_among(text: str) -> tuple[str, ...] | None:
    """Read ``NAME,NAME,…`` or ``all``, as the command line has it.

    Raises:
        GameError: an unknown gesture, or one that carries no message.
    """
    if text.strip() == "all":
        return None
    names = [name.strip() for name in text.split(",") if name.strip()]
    return playable(names, Keys({}, "", "--among"), "it")
