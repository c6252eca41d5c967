"""How the viewer lays a session out at first sight."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from nao_sim.game.store.lanes import STORY
from nao_sim.recording.layout import joint_tabs, robot_view
from nao_sim.recording.moments import TIMELINE
from nao_sim.recording.video import VIDEO
from nao_sim.robot import ACTUATED

if TYPE_CHECKING:
    import rerun.blueprint as rrb

_ARMS = ("HeadYaw", "HeadPitch", "RShoulderPitch", "RShoulderRoll", "LShoulderPitch", "LShoulderRoll")


def session_layout(with_robot: bool, moving: Sequence[str] = _ARMS) -> rrb.Blueprint:
    """Film and robot side by side, the decision under the film, joints beside, the story below on one time line.

    Args:
        with_robot: whether a robot takes part.
        moving: joints to show first.
    """
    import rerun.blueprint as rrb

    person = rrb.Vertical(
        rrb.Spatial2DView(origin=VIDEO, name="Who is on film"),
        rrb.TextDocumentView(origin="decision", name="This turn"),
        row_shares=[3, 2],
    )
    parts: list[rrb.View | rrb.Container] = [person]
    if with_robot:
        parts += [robot_view(), joint_tabs(ACTUATED, moving)]
    shares = [3, 4, 4] if with_robot else [1]
    return rrb.Blueprint(
        rrb.Vertical(
            rrb.Horizontal(*parts, column_shares=shares),
            rrb.StateTimelineView(origin=STORY, name="The session"),
            row_shares=[5, 2],
        ),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed", timeline=TIMELINE),
    )
