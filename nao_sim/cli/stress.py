"""``nao-sim stress``: one motion on many robots that are not quite as documented."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from nao_sim.cli.motion_options import FILES, Limits, Longest, Measured, Part, Units, said_of, tell

if TYPE_CHECKING:
    from nao_sim.gestures import Gesture
    from nao_sim.motion.players import Motion
    from nao_sim.motion.stress import StressReport


def stress(
    gesture: Annotated[str, typer.Argument(help=f"A gesture's name, or a file ({FILES}).")],
    trials: Annotated[int, typer.Option(min=1, max=100_000, help="How many robots.")] = 1000,
    seed: Annotated[int, typer.Option(min=0, help="The same seed gives the same trials.")] = 0,
    at_least: Annotated[
        float | None,
        typer.Option(help="Exit code 1 if a smaller share stays up.  [default: 0.99, a walk 0.95]", show_default=False),
    ] = None,
    sweep: Annotated[bool, typer.Option(help="Also look for the factor that breaks it first.")] = True,
    threads: Annotated[int, typer.Option(min=0, help="0 for all cores.")] = 0,
    replay: Annotated[
        int | None, typer.Option(min=0, help="Play this trial alone and tell about it.", show_default=False)
    ] = None,
    video: Annotated[Path | None, typer.Option(help="Film the replayed trial: FILE.mp4.", show_default=False)] = None,
    limits: Limits = "thesis",
    units: Units = None,
    longest: Longest = None,
    part: Part = None,
    measured: Measured = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
) -> None:
    """Play GESTURE under random mass, centre of mass, friction, motor strength, play, delay, slope, tilt and push."""
    from nao_sim.cli.progress import stages
    from nao_sim.gestures import find_gesture
    from nao_sim.gestures.act import motion_of
    from nao_sim.motion.stress import stress as run

    if at_least is not None and not 0.0 <= at_least <= 1.0:
        raise typer.BadParameter(f"{at_least:g} is no share; write one from 0 to 1", param_hint="--at-least")
    if video is not None and replay is None:
        raise typer.BadParameter("films one trial; say which with --replay", param_hint="--video")
    if replay is not None and at_least is not None:
        raise typer.BadParameter("judges all trials, and --replay plays one; leave one out", param_hint="--at-least")
    chosen = find_gesture(gesture, limits=limits, said=said_of(units, longest, part, measured))
    tell(chosen.notes)
    motion = motion_of(chosen, limits)
    if replay is not None:
        _replay(chosen, motion, seed, replay, video, as_json, limits)
        return
    with stages(hidden=as_json) as progress:
        report = run(motion, trials, seed, sweep=sweep, threads=threads, progress=progress, limits=limits)
    if as_json:
        typer.echo(
            json.dumps(
                {"gesture": chosen.name, "limits": limits, **asdict(report), "weakest": report.weakest}, indent=2
            )
        )
    else:
        _print(gesture, chosen, report, "" if limits == "thesis" else f" --limits {limits}")
    if at_least is None:
        at_least = 0.99 if chosen.walk is None else 0.95
    if report.upright_share < at_least:
        raise typer.Exit(1)


def _replay(
    gesture: Gesture, motion: Motion, seed: int, index: int, video: Path | None, as_json: bool, limits: str
) -> None:
    from nao_sim.motion.stress import describe_trial, replay_trial
    from nao_sim.robot import Nao

    log = replay_trial(motion, seed, index, limits=limits)
    if video is not None:
        from nao_sim.episodes.film_robot import film_robot

        with Nao(limits, fingers=False) as nao:
            film_robot(nao.model, log, video)
    told: dict[str, Any] = {
        "gesture": gesture.name,
        "limits": limits,
        "seed": seed,
        "trial": index,
        "fell_at_s": log.fell_at,
    }
    told |= describe_trial(seed, index)
    if as_json:
        typer.echo(json.dumps(told, indent=2))
        return
    for name, value in told.items():
        typer.echo(f"{name:20s} {value}")


def _print(asked: str, gesture: Gesture, report: StressReport, more: str) -> None:
    import shlex

    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_row("gesture", f"[bold]{escape(gesture.name)}[/], {report.trials} trials of seed {report.seed}")
    table.add_row("stay up", f"[bold]{100 * report.upright_share:.1f} %[/]")
    table.add_row(
        "lean", f"{report.lean_deg[0]:.1f}° beyond the plan in the median trial, 95 % below {report.lean_deg[1]:.1f}°"
    )
    if report.breaking_size:
        table.add_row("breaks first", _weakest(report))
    if report.fell:
        shown = ", ".join(str(index) for index in report.fell[:8]) + (", …" if len(report.fell) > 8 else "")
        table.add_row("fell", f"trials {shown}")
        table.add_row(
            "look",
            escape(
                f"nao-sim stress {shlex.quote(asked)} --seed {report.seed} --replay {report.fell[0]} "
                f"--video trial.mp4{more}"
            ),
        )
    Console(soft_wrap=True, emoji=False).print(table)


def _weakest(report: StressReport) -> str:
    from nao_sim.motion.stress import SWEEP_SIZES

    if report.weakest is None:
        return f"nothing alone, up to {SWEEP_SIZES[-1]:g} times its size"
    size = report.breaking_size[report.weakest]
    others = [name for name, other in report.breaking_size.items() if other == size and name != report.weakest]
    also = f" (as do {', '.join(others)})" if others else ""
    return f"{report.weakest}, alone at {size:g} times its size{also}"
