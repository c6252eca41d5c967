"""What people did in ELAN comes back: ratings are added, events added or corrected, and nothing is taken away.

An annotation that no column can hold becomes an event of kind ``mark`` with its tier as origin.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from xml.etree import ElementTree

from nao_sim.exchange.elan.event import event_from
from nao_sim.exchange.elan.layout import NO_TRIAL, event_tiers, plan_tiers
from nao_sim.exchange.elan.reading import ReadAnnotation, ReadTier, read_tiers, with_times
from nao_sim.exchange.errors import ExchangeError
from nao_sim.exchange.merged import Merged
from nao_sim.game.tables import Event, Rating, Tables
from nao_sim.game.tables.scores import AUTO, latest_ratings
from nao_sim.game.tables.words import EVENT_KINDS

_FACTS = ("turn_id", "prompt_level", "side", "seen", "excluded", "auto")
_SPANS = ("turn", "model", "movement")
_MOVED_MS = 2
"""ELAN keeps whole milliseconds; what moved no further did not move."""


def merge_eaf(tables: Tables, root: ElementTree.Element, when: str) -> Merged:
    """Merge an EAF into the tables of its session.

    Args:
        tables: of one session.
        root: the EAF.
        when: when it is merged, ISO 8601 with a zone; new ratings bear it.

    Raises:
        ExchangeError: the tables hold another number of sessions than one.
    """
    if len(tables.sessions) != 1:
        raise ExchangeError(f"an EAF holds one session, these tables {len(tables.sessions)}; name one session's folder")
    return _Merge(tables, root, when).done()


class _Merge:
    def __init__(self, tables: Tables, root: ElementTree.Element, when: str) -> None:
        self.tables, self.when = tables, when
        self.session = tables.sessions[0]
        self.tiers = read_tiers(root)
        self.turn_of = _turn_keys(self.tiers, {t.turn_id for t in tables.turns})
        self.planned = {tier.name: tier for tier in plan_tiers(tables)[0]}
        self.ratings = list(tables.ratings)
        self.events = list(tables.events)
        self.news: list[str] = []
        self.notes: list[str] = []

    def done(self) -> Merged:
        latest = latest_ratings(self.tables.ratings)
        placed = list(with_times(self.tiers))
        words = {a.parent: a.value for tier in self.tiers if tier.kind == "function" for a in tier.annotations}
        by_tier: dict[str, list[tuple[ReadTier, ReadAnnotation]]] = {}
        for tier, a, root in placed:
            turn = self.turn_of.get(root.key)
            if tier.kind == "score" and turn is not None:
                self._score(tier, a, turn, latest.get(turn, {}))
            elif tier.kind in _FACTS and turn is not None:
                self._fact(tier, a, turn)
            elif tier.kind == "turn" and turn is not None:
                continue
            elif tier.kind == "function" and root.parent is None and a.parent is not None:
                continue  # read with the utterance it belongs to
            elif a.start_s is None or a.end_s is None:
                self.notes.append(f"{tier.name}: {a.value!r} has no time and is not taken over; align it in ELAN")
            else:
                by_tier.setdefault(tier.name, []).append((tier, a))
        self._events(by_tier, words)
        self._missing(latest)
        return Merged(
            replace(self.tables, ratings=tuple(self.ratings), events=tuple(self.events)),
            tuple(self.news),
            tuple(self.notes),
        )

    def _score(self, tier: ReadTier, a: ReadAnnotation, turn: str, known: Mapping[str, Rating]) -> None:
        rater = tier.annotator or tier.name.rpartition("@")[2]
        if rater == AUTO or (tier.name.count("@") < 2 and tier.annotator is None):
            self._keep(tier, a, turn, f"{tier.name}: whose scores these are is not said; set the tier's annotator")
            return
        value = a.value.strip()
        if value != NO_TRIAL and value not in self.session.scale.split("/"):
            self._keep(tier, a, turn, f"{tier.name}, turn {turn}: {value!r} is no score of {self.session.scale}")
            return
        score = None if value == NO_TRIAL else int(value)
        old = known.get(rater)
        if old is not None and old.score == score:
            return
        self.ratings.append(
            Rating(
                turn, rater, self.when, score, self.session.scale, self.session.rule,
                excluded="other" if score is None else None, note="scored in ELAN",
            )
        )  # fmt: skip
        self.news.append(f"{rater} scored {turn}: {value}" + ("" if old is None else " (before: another score, kept)"))

    def _fact(self, tier: ReadTier, a: ReadAnnotation, turn: str) -> None:
        if tier.kind == "turn_id":
            return
        row = next(t for t in self.tables.turns if t.turn_id == turn)
        value = getattr(row, "auto_score" if tier.kind == "auto" else tier.kind)
        if a.value.strip() != ("" if value is None else str(value)):
            self._keep(
                tier,
                a,
                turn,
                f"turn {turn}: {tier.kind} is {value} in the table and {a.value!r} in ELAN; kept as a mark",
            )

    def _keep(self, tier: ReadTier, a: ReadAnnotation, turn: str | None, note: str) -> None:
        """Keep an annotation as a mark beside what the tables say."""
        event = event_from(self.session.session, tier, a, "mark", None, f"{tier.name} (changed)", turn)
        if event is not None and not any(_same(event, e) for e in self.events):
            self.events.append(event)
            self.notes.append(note)

    def _events(self, found: dict[str, list[tuple[ReadTier, ReadAnnotation]]], words: Mapping[str | None, str]) -> None:
        ours = event_tiers(self.tables.events)
        for name, here in found.items():
            left = list(ours.get(name, []))
            spans = list(self.planned[name].stretches) if here[0][0].kind in _SPANS and name in self.planned else []
            rest = []
            for tier, a in here:
                stretch = (round(1000 * (a.start_s or 0)), round(1000 * (a.end_s or 0)), a.value)
                exact = next((pair for pair in left if _unmoved(pair[0], stretch)), None)
                span = next((s for s in spans if _unmoved(s, stretch)), None)
                if exact is not None:
                    left.remove(exact)
                    self._relabel(exact[1], words.get(a.key))
                elif span is not None:
                    spans.remove(span)
                else:
                    rest.append((tier, a, stretch))
            for tier, a, stretch in rest:
                near = next((pair for pair in left if _overlap(pair[0], stretch)), None)
                if near is not None:
                    left.remove(near)
                self._new(tier, a, words.get(a.key), None if near is None else near[1])
            self.notes += [f"{name}: {pair[0][2]!r} is no longer in the file; kept" for pair in left]
        for name in ours.keys() - found.keys():
            self.notes.append(f"{name}: {len(ours[name])} events are not in the file; kept")

    def _relabel(self, event: Event, label: str | None) -> None:
        if event.kind == "speech" and label is not None and label != event.label:
            self.events[self.events.index(event)] = replace(event, label=label)
            self.news.append(f"{event.text!r} at {event.start_s:.3f} s is now: {label}")

    def _new(self, tier: ReadTier, a: ReadAnnotation, label: str | None, old: Event | None) -> None:
        changed = tier.kind in _SPANS
        kind = tier.kind if tier.kind in EVENT_KINDS else "mark"
        event = event_from(
            self.session.session, tier, a, kind, label, f"{tier.name} (changed)" if changed else tier.name, None
        )
        if event is None or any(_same(event, e) for e in self.events):
            return
        if old is None:
            self.events.append(event)
            self.news.append(f"{tier.name}: {a.value!r} at {event.start_s:.3f} s")
        else:
            corrected = replace(event, turn_id=old.turn_id, label=event.label or old.label, who=event.who or old.who)
            self.events[self.events.index(old)] = corrected
            self.news.append(f"{tier.name} at {event.start_s:.3f} s: {old.text!r} is now {event.text!r}")

    def _missing(self, latest: Mapping[str, Mapping[str, Rating]]) -> None:
        there = {(self.turn_of.get(a.parent or ""), t.annotator or t.name.rpartition("@")[2])
                 for t in self.tiers if t.kind == "score" for a in t.annotations}  # fmt: skip
        gone = sum((turn, rater) not in there for turn, mine in latest.items() for rater in mine)
        if gone:
            self.notes.append(f"{gone} ratings are not in the file; kept")


def _turn_keys(tiers: Sequence[ReadTier], turns: set[str]) -> dict[str, str]:
    """Return the turn of each annotation on a ``turn@`` tier, by the key written below it."""
    below = [a for tier in tiers if tier.kind == "turn_id" for a in tier.annotations]
    return {a.parent: a.value for a in below if a.parent is not None and a.value in turns}


def _unmoved(a: tuple[int, int, str], b: tuple[int, int, str]) -> bool:
    return abs(a[0] - b[0]) <= _MOVED_MS and abs(a[1] - b[1]) <= _MOVED_MS and a[2] == b[2]


def _overlap(a: tuple[int, int, str], b: tuple[int, int, str]) -> bool:
    return 2 * (min(a[1], b[1]) - max(a[0], b[0])) > min(a[1] - a[0], b[1] - b[0])


def _same(a: Event, b: Event) -> bool:
    return (a.origin, a.kind, a.start_s, a.end_s, a.text, a.label) == (
        b.origin,
        b.kind,
        b.start_s,
        b.end_s,
        b.text,
        b.label,
    )
