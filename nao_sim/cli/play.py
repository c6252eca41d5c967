"""``nao-sim play``: a gesture on the simulated robot, free-standing."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from nao_sim.cli.motion_options import FILES, Limits, Longest, Measured, Part, Units, said_of, tell

if TYPE_CHECKING:
    from nao_sim.gestures.act import Performance
    from nao_sim.motion import Change
    from nao_sim.motion.measures import Measures

MARKER = "motion.json"


def play(
    gesture: Annotated[str, typer.Argument(help=f"A gesture's name, or a file ({FILES}).")],
    speed: Annotated[float, typer.Option(help="2 is twice as fast, where the motors allow it.")] = 1.0,
    amplitude: Annotated[float, typer.Option(help="1.2 is a fifth larger.")] = 1.0,
    repetitions: Annotated[int | None, typer.Option(help="Of a cyclic gesture.", show_default=False)] = None,
    mirror: Annotated[bool, typer.Option("--mirror", help="Exchange left and right.")] = False,
    fit: Annotated[bool, typer.Option("--fit", help="Clip what leaves a range instead of refusing it.")] = False,
    limits: Limits = "thesis",
    units: Units = None,
    longest: Longest = None,
    part: Part = None,
    measured: Measured = False,
    out: Annotated[Path | None, typer.Option(help="Folder for motion.json and motion.csv.", show_default=False)] = None,
    video: Annotated[Path | None, typer.Option(help="Film it: FILE.mp4.", show_default=False)] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
) -> None:
    """Play GESTURE on the free-standing robot and say how it went. Exit code 1 if it fell."""
    from nao_sim.cli.progress import stages
    from nao_sim.episodes.folder import check_place
    from nao_sim.gestures import find_gesture, mirrored
    from nao_sim.gestures.act import act
    from nao_sim.motion.measures import measure
    from nao_sim.robot import Nao

    chosen = find_gesture(gesture, fit, limits, said_of(units, longest, part, measured))
    tell(chosen.notes)
    chosen = mirrored(chosen) if mirror else chosen
    if out is not None:
        check_place(out, MARKER)
    nao = Nao(limits)
    with stages(hidden=as_json) as show:
        done = act(
            nao,
            chosen,
            speed=speed,
            amplitude=amplitude,
            repetitions=repetitions,
            progress=lambda at, total: show("Playing", at, total),
        )
    measures = measure(nao.model, done.trajectory, done.log, limits)
    asked = {"speed": speed, "amplitude": amplitude, "repetitions": repetitions, "mirror": mirror, "limits": limits}
    result = _result(chosen.name, asked, done, measures)
    if out is not None:
        _save(out, result, done)
    if video is not None:
        from nao_sim.episodes.film_robot import film_robot

        film_robot(nao.model, done.log, video)
    if as_json:
        typer.echo(json.dumps(result, indent=2, ensure_ascii=False))
    else:
        _print(result, done.changes, out, video)
    if done.log.fallen:
        raise typer.Exit(1)


def _result(name: str, asked: dict[str, Any], done: Performance, measures: Measures) -> dict[str, Any]:
    from nao_sim.cli.motion_table import as_dict

    return {"gesture": name, **asked, "changes": [str(change) for change in done.changes], **as_dict(measures)}


def _save(out: Path, result: dict[str, Any], done: Performance) -> None:
    from nao_sim.episodes.folder import complete_folder
    from nao_sim.gestures import save_trajectory
    from nao_sim.motion import Trajectory

    with complete_folder(out, MARKER) as folder:
        (folder / MARKER).write_text(json.dumps(result, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
        save_trajectory(done.trajectory, folder / "asked.csv")
        save_trajectory(Trajectory(done.log.time, done.log.angles), folder / "motion.csv")


def _print(result: dict[str, Any], changes: list[Change], out: Path | None, video: Path | None) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    table = Table(show_header=False, box=None, pad_edge=False)
    fell = result["fell_at_s"]
    how = f"[red]fell after {fell:.1f} s[/]" if fell is not None else "stayed upright"
    table.add_row("played", f"[bold]{escape(result['gesture'])}[/], {result['duration_s']:.1f} s, {how}")
    tracking, margin = result["tracking_deg"], result["com_margin_mm"]
    table.add_row("tracking", f"{tracking['value']:.1f}° RMS at the worst joint ({tracking['where']})")
    table.add_row("balance", f"centre of mass at least {margin['value']:.0f} mm inside the feet")
    for change in changes:
        table.add_row("slower" if change.takes_time else "smaller", escape(str(change)))
    if out is not None:
        table.add_row("written", escape(f"{out}/motion.json, motion.csv, asked.csv"))
    if video is not None:
        table.add_row("filmed", escape(str(video)))
    Console(soft_wrap=True, emoji=False).print(table)
