"""EAF as text: read without running anything that a stranger's XML may ask for, written as ELAN writes it."""

from __future__ import annotations

import re
from typing import NoReturn
from xml.etree import ElementTree
from xml.parsers import expat

from nao_sim.exchange.errors import ExchangeError

_FORBIDDEN = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
SCHEMA = "http://www.mpi.nl/tools/elan/EAFv3.0.xsd"
_XSI = "http://www.w3.org/2001/XMLSchema-instance"


def xml_text(text: str) -> str:
    """Leave out what XML cannot hold, such as the bells of a speech recogniser; lines end as XML ends them."""
    return _FORBIDDEN.sub("", text.replace("\r\n", "\n").replace("\r", "\n"))


def parse_eaf(where: str, content: bytes) -> ElementTree.Element:
    """Read a file; document types, and with them entities of any kind, are refused.

    Raises:
        ExchangeError: it is no XML, has a document type, or is no EAF.
    """
    guard = expat.ParserCreate()
    guard.StartDoctypeDeclHandler = lambda *_: _refuse(where)
    try:
        guard.Parse(content, True)
        root = ElementTree.fromstring(content)
    except (expat.ExpatError, ElementTree.ParseError, LookupError, ValueError) as error:
        raise ExchangeError(f"{where} is no readable XML ({error}); save it anew in ELAN") from None
    if root.tag != "ANNOTATION_DOCUMENT":
        raise ExchangeError(f"{where} is XML of {root.tag!r}, not an ELAN file (ANNOTATION_DOCUMENT)")
    return root


def _refuse(where: str) -> NoReturn:
    raise ExchangeError(f"{where} declares a document type, which no ELAN file does; it is not read")


def new_document(author: str, date: str) -> ElementTree.Element:
    """Return an EAF without tiers."""
    root = ElementTree.Element(
        "ANNOTATION_DOCUMENT", {"AUTHOR": xml_text(author), "DATE": date, "FORMAT": "3.0", "VERSION": "3.0"}
    )
    root.set(f"{{{_XSI}}}noNamespaceSchemaLocation", SCHEMA)
    ElementTree.SubElement(root, "HEADER", {"MEDIA_FILE": "", "TIME_UNITS": "milliseconds"})
    ElementTree.SubElement(root, "TIME_ORDER")
    return root


def to_bytes(root: ElementTree.Element) -> bytes:
    """Return the file's bytes."""
    ElementTree.register_namespace("xsi", _XSI)
    ElementTree.indent(root, "    ")
    return ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"
