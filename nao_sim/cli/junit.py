"""Results of ``nao-sim validate`` as JUnit XML, which continuous integration shows."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

if TYPE_CHECKING:
    from nao_sim.cli.gesture_report import Result


def write_junit(results: Sequence[Result], limits: str, path: Path) -> None:
    """Write one test case a gesture: failed with a line a fault, an error where it could not be read.

    Raises:
        GestureFileError: the place cannot be written.
    """
    from nao_sim import __version__
    from nao_sim.gestures.formats.text_file import write_whole

    suite = Element("testsuite", name="nao-sim validate")
    properties = SubElement(suite, "properties")
    for name, value in (("limits", limits), ("nao-sim", __version__)):
        SubElement(properties, "property", name=name, value=value)
    for result in results:
        case = SubElement(suite, "testcase", classname=f"limits.{limits}", name=_plain(result.name))
        case.set("time", f"{result.seconds:.3f}")
        if result.validation is None:
            SubElement(case, "error", message=_plain(result.error or "")).text = _plain(result.error or "")
        elif result.validation.faults:
            faults = result.validation.faults
            message = f"{len(faults)} faults; first: {faults[0]}" if len(faults) > 1 else faults[0]
            SubElement(case, "failure", message=_plain(message)).text = _plain("\n".join(faults))
    failures = sum(result.validation is not None and bool(result.validation.faults) for result in results)
    suite.set("tests", str(len(results)))
    suite.set("failures", str(failures))
    suite.set("errors", str(sum(result.validation is None for result in results)))
    suite.set("time", f"{sum(result.seconds for result in results):.3f}")
    ElementTree.indent(suite)
    text = ElementTree.tostring(suite, encoding="unicode")
    write_whole(path, f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n')


def _plain(text: str) -> str:
    """Return text without the control signs that XML cannot hold."""
    return "".join(sign for sign in text if sign.isprintable() or sign in "\n\t")
