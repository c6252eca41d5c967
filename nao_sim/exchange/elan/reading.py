"""The tiers of an EAF with the times of their annotations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from xml.etree import ElementTree


@dataclass(frozen=True)
class ReadAnnotation:
    """An annotation: its key, value, times [s] where it is aligned, and the annotation it refers to where it is not."""

    key: str
    value: str
    start_s: float | None
    end_s: float | None
    parent: str | None


@dataclass(frozen=True)
class ReadTier:
    """A tier."""

    name: str
    type: str
    participant: str | None
    annotator: str | None
    parent: str | None
    annotations: tuple[ReadAnnotation, ...]

    @property
    def kind(self) -> str:
        """The name's part before the first @."""
        return self.name.partition("@")[0]


def read_tiers(root: ElementTree.Element) -> tuple[ReadTier, ...]:
    """Return the tiers of a document.

    Time slots may lack their time: such a slot is set between its neighbours of the tier, at equal steps.
    """
    slots = {e.get("TIME_SLOT_ID", ""): e.get("TIME_VALUE") for e in root.iter("TIME_SLOT")}
    times = {key: None if value is None else int(value) / 1000 for key, value in slots.items()}
    return tuple(_tier(tier, times) for tier in root.iter("TIER"))


def _tier(tier: ElementTree.Element, times: dict[str, float | None]) -> ReadTier:
    aligned = list(tier.iter("ALIGNABLE_ANNOTATION"))
    chain = [slot for a in aligned for slot in (a.get("TIME_SLOT_REF1", ""), a.get("TIME_SLOT_REF2", ""))]
    filled = _filled([times.get(slot) for slot in chain], chain)
    found = [
        ReadAnnotation(a.get("ANNOTATION_ID", ""), a.findtext("ANNOTATION_VALUE") or "", start, end, None)
        for a, start, end in zip(aligned, filled[::2], filled[1::2], strict=True)
    ]
    found += [
        ReadAnnotation(
            a.get("ANNOTATION_ID", ""), a.findtext("ANNOTATION_VALUE") or "", None, None, a.get("ANNOTATION_REF", "")
        )
        for a in tier.iter("REF_ANNOTATION")
    ]
    return ReadTier(
        tier.get("TIER_ID", ""),
        tier.get("LINGUISTIC_TYPE_REF", ""),
        tier.get("PARTICIPANT") or None,
        tier.get("ANNOTATOR") or None,
        tier.get("PARENT_REF"),
        tuple(found),
    )


def _filled(times: Sequence[float | None], slots: Sequence[str]) -> list[float | None]:
    """Set slots without a time between their neighbours; a slot that two annotations share is one step."""
    order = list(dict.fromkeys(slots))
    known = dict(zip(slots, times, strict=True))
    values = [known[slot] for slot in order]
    for i, value in enumerate(values):
        if value is not None:
            continue
        before = values[i - 1] if i else None
        after = next((j for j in range(i + 1, len(values)) if values[j] is not None), None)
        if before is not None and after is not None:
            values[i] = before + ((values[after] or 0.0) - before) / (after - i + 1)
    at = dict(zip(order, values, strict=True))
    return [at[slot] for slot in slots]


def with_times(tiers: Sequence[ReadTier]) -> Iterator[tuple[ReadTier, ReadAnnotation, ReadAnnotation]]:
    """Yield each annotation with its tier, given the times of what it refers to; and the aligned one that has them."""
    by_key = {a.key: a for tier in tiers for a in tier.annotations}
    for tier in tiers:
        for a in tier.annotations:
            root, steps = a, 0
            while root.parent in by_key and steps < len(by_key):
                root, steps = by_key[root.parent], steps + 1
            yield tier, replace(a, start_s=root.start_s, end_s=root.end_s), root
