"""An EAF that grows: tiers, types and annotations are added, and what was there stays as it was."""

from __future__ import annotations

import re
from xml.etree import ElementTree

from nao_sim.exchange.elan.rules import ORDER
from nao_sim.exchange.elan.xml_text import xml_text

_STEREOTYPES = {
    "Time_Subdivision": "Time subdivision of parent annotation's time interval, no time gaps allowed",
    "Symbolic_Subdivision": "Symbolic subdivision of a parent annotation. Annotations refering to the same parent "
    "are ordered",
    "Symbolic_Association": "1-1 association with a parent annotation",
    "Included_In": "Time alignable annotations within the parent annotation's time interval, gaps are allowed",
}
_LANGUAGE = {"LANG_ID": "eng", "LANG_DEF": "http://cdb.iso.org/lg/CDB-00138502-001", "LANG_LABEL": "English (eng)"}


class Document:
    """A document being written.

    Args:
        root: an empty one, or one that people have worked on.
    """

    def __init__(self, root: ElementTree.Element) -> None:
        self.root = root
        self._last = {"a": self._highest("ANNOTATION_ID", "a"), "ts": self._highest("TIME_SLOT_ID", "ts")}
        for name, words in _STEREOTYPES.items():
            self._once("CONSTRAINT", "STEREOTYPE", name, {"DESCRIPTION": words})

    def _highest(self, attribute: str, prefix: str) -> int:
        found = (re.fullmatch(rf"{prefix}(\d+)", e.get(attribute, "")) for e in self.root.iter())
        return max((int(match[1]) for match in found if match), default=0)

    def _next(self, prefix: str) -> str:
        self._last[prefix] += 1
        return f"{prefix}{self._last[prefix]}"

    def _insert(self, element: ElementTree.Element) -> ElementTree.Element:
        """Put an element where ELAN's order wants it: after the last of its kind or of an earlier one."""
        rank = ORDER.index(element.tag)
        place = sum(1 for child in self.root if child.tag not in ORDER or ORDER.index(child.tag) <= rank)
        self.root.insert(place, element)
        return element

    def _once(self, tag: str, key: str, value: str, more: dict[str, str]) -> tuple[ElementTree.Element, bool]:
        """Return the element of a name, and whether it had to be made."""
        for element in self.root.findall(tag):
            if element.get(key) == value:
                return element, False
        return self._insert(ElementTree.Element(tag, {key: value} | more)), True

    def media(self, url: str, relative: str, mime: str, origin_ms: int) -> None:
        """Link a film, unless one is linked already."""
        header = self.root.find("HEADER")
        if header is not None and header.find("MEDIA_DESCRIPTOR") is None:
            values = {"MEDIA_URL": url, "MIME_TYPE": mime, "RELATIVE_MEDIA_URL": relative}
            if origin_ms > 0:
                values["TIME_ORIGIN"] = str(origin_ms)
            header.insert(0, ElementTree.Element("MEDIA_DESCRIPTOR", values))

    def set_property(self, name: str, value: str) -> None:
        """Set one of the header's properties."""
        header = self.root.find("HEADER")
        if header is None:
            return
        for element in header.findall("PROPERTY"):
            if element.get("NAME") == name:
                element.text = value
                return
        ElementTree.SubElement(header, "PROPERTY", {"NAME": name}).text = value

    def type(self, name: str, constraint: str | None, vocabulary: str | None) -> None:
        """Have a tier type."""
        values = {"GRAPHIC_REFERENCES": "false", "TIME_ALIGNABLE": "true" if constraint is None else "false"}
        if constraint is not None:
            values["CONSTRAINTS"] = constraint
        if vocabulary is not None:
            values["CONTROLLED_VOCABULARY_REF"] = vocabulary
        self._once("LINGUISTIC_TYPE", "LINGUISTIC_TYPE_ID", name, values)

    def vocabulary(self, name: str, words: dict[str, str]) -> None:
        """Have a controlled vocabulary: each word and what it means."""
        self._once("LANGUAGE", "LANG_ID", _LANGUAGE["LANG_ID"], {k: v for k, v in _LANGUAGE.items() if k != "LANG_ID"})
        cv, fresh = self._once("CONTROLLED_VOCABULARY", "CV_ID", name, {})
        if not fresh:
            return
        ElementTree.SubElement(cv, "DESCRIPTION", {"LANG_REF": "eng"}).text = name
        for number, (word, meaning) in enumerate(words.items()):
            entry = ElementTree.SubElement(cv, "CV_ENTRY_ML", {"CVE_ID": f"cve_{_plain(name)}_{number}"})
            ElementTree.SubElement(entry, "CVE_VALUE", {"LANG_REF": "eng", "DESCRIPTION": meaning}).text = word

    def entry(self, vocabulary: str | None, word: str) -> str | None:
        """Return the id of a word of a vocabulary; None for a word that is not in it."""
        for cv in self.root.findall("CONTROLLED_VOCABULARY"):
            if cv.get("CV_ID") == vocabulary:
                for entry in cv.iter("CV_ENTRY_ML"):
                    if any(value.text == word for value in entry.iter("CVE_VALUE")):
                        return entry.get("CVE_ID")
        return None

    def tier(
        self, name: str, kind: str, participant: str | None, annotator: str | None, parent: str | None
    ) -> ElementTree.Element:
        """Have a tier."""
        more = {"LINGUISTIC_TYPE_REF": kind}
        for key, value in (("PARTICIPANT", participant), ("ANNOTATOR", annotator), ("PARENT_REF", parent)):
            if value is not None:
                more[key] = xml_text(value)
        return self._once("TIER", "TIER_ID", xml_text(name), more)[0]

    def aligned(self, tier: ElementTree.Element, start_ms: int, end_ms: int, value: str) -> str:
        """Add an annotation with its own times; return its id."""
        order = self.root.find("TIME_ORDER")
        if order is None:
            order = self._insert(ElementTree.Element("TIME_ORDER"))
        slots = []
        for time in (start_ms, end_ms):
            slots.append(self._next("ts"))
            ElementTree.SubElement(order, "TIME_SLOT", {"TIME_SLOT_ID": slots[-1], "TIME_VALUE": str(time)})
        values = {"TIME_SLOT_REF1": slots[0], "TIME_SLOT_REF2": slots[1]}
        return self._annotation(tier, "ALIGNABLE_ANNOTATION", values, value, None)

    def referring(self, tier: ElementTree.Element, parent: str, value: str, entry: str | None = None) -> str:
        """Add an annotation that refers to another; return its id."""
        return self._annotation(tier, "REF_ANNOTATION", {"ANNOTATION_REF": parent}, value, entry)

    def _annotation(
        self, tier: ElementTree.Element, tag: str, values: dict[str, str], value: str, entry: str | None
    ) -> str:
        key = self._next("a")
        more = {} if entry is None else {"CVE_REF": entry}
        holder = ElementTree.SubElement(tier, "ANNOTATION")
        element = ElementTree.SubElement(holder, tag, {"ANNOTATION_ID": key} | values | more)
        ElementTree.SubElement(element, "ANNOTATION_VALUE").text = xml_text(value)
        return key

    def finish(self) -> None:
        """Put the time slots in order and note the last id used."""
        order = self.root.find("TIME_ORDER")
        if order is not None:
            at, ranked = 0, []
            for slot in order:
                at = int(slot.get("TIME_VALUE", at))
                ranked.append((at, slot))
            order[:] = [slot for _, slot in sorted(ranked, key=lambda pair: pair[0])]
        self.set_property("lastUsedAnnotationId", str(self._last["a"]))


def _plain(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9]", "_", name)
