"""``nao-sim imitate``: a gesture video in, the simulated NAO's imitation and its recording out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from nao_sim.episodes import Episode


def imitate(
    video: Annotated[Path, typer.Argument(help="A video, or a photo of a hand posture.", show_default=False)],
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for the episode.  [default: the video's name + -episode]", show_default=False),
    ] = None,
    mirror: Annotated[bool, typer.Option("--mirror", help="Answer as a mirror would: left for right.")] = False,
    frames: Annotated[
        str | None, typer.Option(help="Watch only these frames: FIRST:LAST, both included.", show_default=False)
    ] = None,
    among: Annotated[
        str | None, typer.Option(help="Only these gestures are possible: NAME,NAME,…", show_default=False)
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the episode as JSON.")] = False,
) -> None:
    """Watch VIDEO, let the simulated NAO answer, and write one folder: episode.json, .parquet and .rrd."""
    from nao_sim.cli.progress import stages
    from nao_sim.episodes import imitate as run
    from nao_sim.episodes import save_episode
    from nao_sim.episodes.folder import check_place
    from recognizer import parse_frame_range

    folder = out or Path(f"{video.stem}-episode")
    check_place(folder)
    chosen = parse_frame_range(frames) if frames else None
    names = [name.strip() for name in among.split(",")] if among else None
    with stages(hidden=as_json) as progress:
        episode, nao = run(video, frames=chosen, mirror=mirror, among=names, progress=progress)
        save_episode(folder, episode, nao, lambda done: progress("Recording", done, episode.frame_count))
    if as_json:
        typer.echo(json.dumps({**episode.to_dict(), "folder": str(folder)}, indent=2, ensure_ascii=False))
    else:
        _print(episode, folder)


def _print(episode: Episode, folder: Path) -> None:
    from rich.console import Console
    from rich.table import Table

    seen, outcome = episode.recognition, episode.outcome
    table = Table(show_header=False, box=None, pad_edge=False)
    what = f"[bold]{seen.label}[/]" if seen.label else f"[bold]none of these[/] ({seen.reason})"
    how_sure = f"  {seen.family}, distance {seen.distance:.2f} of at most {seen.threshold:.2f}" if seen.nearest else ""
    table.add_row("seen", what + how_sure)
    if episode.answer.gesture:
        upright = f"[red]fell after {outcome.fell_at_s:.1f} s[/]" if outcome.fell_at_s is not None else "stayed upright"
        table.add_row("answered", f"[bold]{episode.answer.gesture}[/], {outcome.duration_s:.1f} s")
        table.add_row("done", f"{upright}, joints {outcome.tracking_rms_deg:.1f}° RMS from their targets")
    else:
        table.add_row("answered", "nothing; the robot stands still")
    for warning in seen.warnings:
        table.add_row("note", warning)
    table.add_row("written", f"{folder}/episode.json, episode.parquet, episode.rrd")
    table.add_row("look", f"rerun {folder}/episode.rrd")
    Console(soft_wrap=True).print(table)
