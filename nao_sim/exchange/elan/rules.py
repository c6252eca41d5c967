"""What ELAN expects beyond its schema; files that break these rules open, and are damaged at the next save."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from xml.etree import ElementTree

from nao_sim.exchange.elan.reading import ReadTier, read_tiers

ORDER = (
    "LICENSE", "HEADER", "TIME_ORDER", "TIER", "LINGUISTIC_TYPE", "LOCALE", "LANGUAGE", "CONSTRAINT",
    "CONTROLLED_VOCABULARY", "LEXICON_REF", "REF_LINK_SET", "EXTERNAL_REF",
)  # fmt: skip
"""The order of a document's parts; the schema reports a wrong one as a missing key."""

_SYMBOLIC = ("Symbolic_Association", "Symbolic_Subdivision")


def eaf_faults(root: ElementTree.Element) -> Iterator[str]:
    """Yield what is wrong with a document: order, names that lead nowhere, and the constraints of tier types."""
    places = [ORDER.index(child.tag) if child.tag in ORDER else -1 for child in root]
    if -1 in places or places != sorted(places):
        yield "the parts of the document do not stand in ELAN's order"
    ids = [e.get("ANNOTATION_ID") for e in root.iter() if e.get("ANNOTATION_ID") is not None]
    ids += [e.get("TIME_SLOT_ID") for e in root.iter("TIME_SLOT")]
    yield from (f"the id {key} stands there twice" for key in {i for i in ids if ids.count(i) > 1})
    slots = {e.get("TIME_SLOT_ID") for e in root.iter("TIME_SLOT")}
    for a in root.iter("ALIGNABLE_ANNOTATION"):
        for name in ("TIME_SLOT_REF1", "TIME_SLOT_REF2"):
            if a.get(name) not in slots:
                yield f"annotation {a.get('ANNOTATION_ID')} points to the time slot {a.get(name)}, which is not there"
    values = [int(v) for v in (e.get("TIME_VALUE") for e in root.iter("TIME_SLOT")) if v is not None]
    if values != sorted(values):
        yield "time slots are not in the order of time"
    types = {e.get("LINGUISTIC_TYPE_ID"): e for e in root.iter("LINGUISTIC_TYPE")}
    tiers = {tier.name: tier for tier in read_tiers(root)}
    for tier in tiers.values():
        if tier.type not in types:
            yield f"tier {tier.name} is of the type {tier.type}, which is not there"
        elif tier.parent is not None and tier.parent not in tiers:
            yield f"tier {tier.name} hangs below {tier.parent}, which is not there"
        else:
            yield from _tier_faults(tier, types[tier.type], tiers)
    yield from _vocabulary_faults(root)


def _tier_faults(tier: ReadTier, kind: ElementTree.Element, tiers: dict[str, ReadTier]) -> Iterator[str]:
    constraint = kind.get("CONSTRAINTS")
    if (constraint is None) != (tier.parent is None):
        yield f"tier {tier.name}: a type with a constraint needs a parent tier, and one without has none"
    parents = {a.key: a for a in tiers[tier.parent].annotations} if tier.parent else {}
    referred: set[str] = set()
    for a in tier.annotations:
        if (a.parent is not None) != (constraint in _SYMBOLIC):
            yield f"tier {tier.name}: annotation {a.key} is aligned where its type refers, or the reverse"
        elif a.parent is not None:
            if a.parent not in parents:
                yield f"tier {tier.name}: annotation {a.key} refers to {a.parent}, not on the parent tier"
            elif constraint == "Symbolic_Association" and a.parent in referred:
                yield f"tier {tier.name}: two annotations refer to {a.parent}"
            referred.add(a.parent)
        elif a.start_s is None or a.end_s is None or a.end_s <= a.start_s:
            yield f"tier {tier.name}: annotation {a.key} does not end after it starts"
        elif constraint and not any(_inside(a.start_s, a.end_s, p.start_s, p.end_s) for p in parents.values()):
            yield f"tier {tier.name}: annotation {a.key} lies outside its parent"
    aligned = sorted((a.start_s, a.end_s) for a in tier.annotations if a.parent is None and a.start_s is not None)
    if any(first[1] > second[0] for first, second in pairwise(aligned) if first[1] is not None):
        yield f"tier {tier.name}: annotations overlap"
    if constraint == "Time_Subdivision":
        for p in parents.values():
            inside = [s for s in aligned if _inside(s[0], s[1], p.start_s, p.end_s)]
            edges = [p.start_s, *(t for s in inside for t in s), p.end_s]
            if inside and any(a != b for a, b in zip(edges[::2], edges[1::2], strict=True)):
                yield f"tier {tier.name}: annotations leave gaps in {p.key}"


def _inside(start: float | None, end: float | None, first: float | None, last: float | None) -> bool:
    if start is None or end is None or first is None or last is None:
        return False
    return first <= start and end <= last


def _vocabulary_faults(root: ElementTree.Element) -> Iterator[str]:
    entries: dict[str | None, dict[str | None, set[str | None]]] = {}
    for cv in root.iter("CONTROLLED_VOCABULARY"):
        entries[cv.get("CV_ID")] = {
            e.get("CVE_ID"): {v.text for v in e.iter("CVE_VALUE")} for e in cv.iter("CV_ENTRY_ML")
        }
    types = {e.get("LINGUISTIC_TYPE_ID"): e.get("CONTROLLED_VOCABULARY_REF") for e in root.iter("LINGUISTIC_TYPE")}
    for tier in root.iter("TIER"):
        words = entries.get(types.get(tier.get("LINGUISTIC_TYPE_REF")), {})
        for a in tier.iter():
            reference = a.get("CVE_REF")
            if reference is None:
                continue
            if reference not in words:
                yield f"annotation {a.get('ANNOTATION_ID')} points to the word {reference}, which no vocabulary holds"
            elif a.findtext("ANNOTATION_VALUE") not in words[reference]:
                yield f"annotation {a.get('ANNOTATION_ID')} does not say what its word of the vocabulary says"
