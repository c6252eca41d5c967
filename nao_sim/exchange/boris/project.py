"""The structure of a BORIS project: JSON, plain or compressed, and what BORIS's own check does not see."""

from __future__ import annotations

import gzip
import json
import zlib
from collections import Counter
from collections.abc import Iterator
from typing import Any

from nao_sim.exchange.errors import ExchangeError

VERSION = "7.0"
_TOP = (
    "time_format", "project_date", "project_name", "project_description", "project_format_version", "subjects_conf",
    "behaviors_conf", "observations", "behavioral_categories", "independent_variables", "coding_map", "converters",
)  # fmt: skip
_OBSERVATION = ("type", "date", "description", "time offset", "file", "independent_variables", "events")
FORBIDDEN = "(|),`~\\"
"""What a modifier must not hold."""


def parse_boris(where: str, content: bytes) -> dict[str, Any]:
    """Read a project.

    Raises:
        ExchangeError: it is no JSON, no BORIS project, or of a newer format.
    """
    try:
        plain = gzip.decompress(content) if content.startswith(b"\x1f\x8b") else content
        project = json.loads(plain.decode("utf-8-sig"), parse_constant=_no_constant)
    except (ValueError, OSError, EOFError, zlib.error, RecursionError) as error:
        raise ExchangeError(f"{where} is no readable BORIS project ({error}); save it anew in BORIS") from None
    if not isinstance(project, dict) or not isinstance(project.get("observations"), dict):
        raise ExchangeError(f"{where} is JSON, but no BORIS project: it has no observations")
    version = str(project.get("project_format_version", VERSION))
    if not version.partition(".")[0].isdecimal() or int(version.partition(".")[0]) > int(VERSION.partition(".")[0]):
        raise ExchangeError(f"{where} has project format {version}, known is up to {VERSION}")
    return project


def _no_constant(name: str) -> None:
    raise ValueError(f"{name} is no JSON number")


def boris_faults(project: dict[str, Any]) -> Iterator[str]:
    """Yield what BORIS would stumble over, silently or not, when it opens or exports the project."""
    yield from (f"the project lacks {key}" for key in _TOP if key not in project)
    subjects = {s["name"] for s in project.get("subjects_conf", {}).values()} | {""}
    behaviors = {b["code"]: b for b in project.get("behaviors_conf", {}).values()}
    for name, observation in project.get("observations", {}).items():
        yield from (f"{name} lacks {key}" for key in _OBSERVATION if key not in observation)
        states: Counter[tuple[Any, ...]] = Counter()
        width = 6 if observation.get("type") == "MEDIA" else 5
        for event in observation.get("events", []):
            if len(event) != width:
                yield f"{name}: an event of {len(event)} items, not {width}"
                continue
            _, subject, code, modifier = event[:4]
            if subject not in subjects or code not in behaviors:
                yield f"{name}: {subject!r} or {code!r} is not defined"
                continue
            sets = behaviors[code]["modifiers"]
            if not isinstance(modifier, str) or (modifier and len(modifier.split("|")) != len(sets)):
                yield f"{name}: modifier {modifier!r} of {code}, which has {len(sets)} sets"
            if behaviors[code]["type"] == "State event":
                states[(subject, code, modifier)] += 1
        yield from (f"{name}: {key} is not paired" for key, count in states.items() if count % 2)
