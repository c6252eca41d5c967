"""How the viewer lays an episode out at first sight."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from nao_sim.recording.moments import TIMELINE
from nao_sim.recording.video import VIDEO

if TYPE_CHECKING:
    import rerun.blueprint as rrb

_LIMBS = {
    "Head": ("Head",),
    "Left arm": ("LShoulder", "LElbow", "LWrist", "LHand"),
    "Right arm": ("RShoulder", "RElbow", "RWrist", "RHand"),
    "Left leg": ("LHip", "LKnee", "LAnkle"),
    "Right leg": ("RHip", "RKnee", "RAnkle"),
}


def _joint_view(name: str) -> rrb.TimeSeriesView:
    import rerun.blueprint as rrb

    unit = "% open" if name.endswith("Hand") else "degrees"
    # One look for all joints (blue measured, orange target, red limits) needs no legend that hides the curves.
    return rrb.TimeSeriesView(
        origin=f"joints/{name}", name=f"{name} [{unit}]", plot_legend=rrb.PlotLegend(visible=False)
    )


def robot_view() -> rrb.Spatial3DView:
    """The robot from its front, a little aside."""
    import rerun.blueprint as rrb

    return rrb.Spatial3DView(
        origin="world",
        name="NAO",
        eye_controls=rrb.EyeControls3D(position=(1.15, 0.25, 0.55), look_target=(0.0, 0.0, 0.30), eye_up=(0, 0, 1)),
        line_grid=rrb.LineGrid3D(spacing=0.1),
        background=[236, 238, 242],
    )


def joint_tabs(names: Sequence[str], moving: Sequence[str]) -> rrb.Tabs:
    """A tab of those that move, then a tab a limb, torques and balance; arguments as :func:`layout`."""
    import rerun.blueprint as rrb

    tabs: list[rrb.View | rrb.Container] = []
    if moving:
        tabs.append(rrb.Grid(*map(_joint_view, moving), grid_columns=2, name="Moving joints"))
    for limb, starts in _LIMBS.items():
        members = [name for name in names if name.startswith(starts)]
        tabs.append(rrb.Grid(*map(_joint_view, members), grid_columns=2, name=limb))
    tabs.append(rrb.TimeSeriesView(origin="torques", name="Torques [Nm]"))
    balance = rrb.Vertical(
        rrb.TimeSeriesView(origin="balance", name="Torso [degrees]"),
        rrb.TimeSeriesView(origin="load", name="Load on the feet [N]"),
        name="Balance",
    )
    tabs.append(balance)
    return rrb.Tabs(*tabs, active_tab=0)


def layout(names: Sequence[str], moving: Sequence[str]) -> rrb.Blueprint:
    """Robot and video side by side, decision and joint angles beside them, phases below.

    Args:
        names: all joints logged.
        moving: the joints to show first, the most active ones.
    """
    import rerun.blueprint as rrb

    evidence = rrb.Tabs(
        rrb.Spatial2DView(origin=VIDEO, name="The person, and what moved"),
        rrb.Spatial2DView(origin="evidence/first_key_frame", name="Key frame 1"),
        rrb.Spatial2DView(origin="evidence/second_key_frame", name="Key frame 2"),
        rrb.Spatial2DView(origin="evidence/difference", name="Difference image"),
        active_tab=0,
    )
    return rrb.Blueprint(
        rrb.Vertical(
            rrb.Horizontal(
                rrb.Vertical(evidence, rrb.TextDocumentView(origin="decision", name="Decision"), row_shares=[3, 2]),
                robot_view(),
                joint_tabs(names, moving),
                column_shares=[3, 4, 4],
            ),
            rrb.StateTimelineView(origin="phase", name="Phases"),
            row_shares=[6, 1],
        ),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed", timeline=TIMELINE),
    )
