"""Layout of the viewer for the recording of a run.

Several robots share one cell; each has its tab of program, joints and speed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import zip_longest

import rerun.blueprint as rrb

from rapidsim.recording import palette
from rapidsim.recording.layout.camera import Viewpoint, cell_camera, near_camera
from rapidsim.recording.panels import belts, log, plots, program_listing, state_lanes
from rapidsim.recording.panels.legend import emptiest_corner
from rapidsim.recording.samples import RecordedRobot
from rapidsim.recording.scene import failed_moves, paths, speed_path, targets
from rapidsim.recording.scene.targets import Targets
from rapidsim.recording.timelines import SIM_TIME
from rapidsim.recording.transforms import WORLD

_ALL = "+ /**"
_WIDE = 1.7
"""Aspect ratio of a picture for which the cell has the whole width."""
_OPEN_AXIS = 130.0
"""End [%] of an axis of shares unless values exceed it: the limits are visible, with room for the
legend."""


def blueprint(runs: Sequence[RecordedRobot], shown: Targets) -> rrb.Blueprint:
    """Return the layout: cell and program above, plots and lanes below.

    Args:
        runs: Recorded run of each robot.
        shown: The targets of the first robot.
    """
    return laid_out(
        rrb.Vertical(
            rrb.Horizontal(
                _spaces(runs, shown),
                rrb.Vertical(_each(runs, _listing), _log(), row_shares=[3, 2]),
                column_shares=[64, 36],
            ),
            rrb.Horizontal(
                _each(runs, _joints), _each(runs, _speed), _lanes(runs), column_shares=[1, 1, 1]
            ),
            row_shares=[8, 5],
        ),
    )


def laid_out(views: rrb.Container) -> rrb.Blueprint:
    """Return views with collapsed viewer panels and the time paused."""
    return rrb.Blueprint(
        views,
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(
            state="collapsed",
            timeline=SIM_TIME,
            play_state="paused",
            loop_mode="off",
            playback_speed=1.0,
        ),
        auto_layout=False,
        auto_views=False,
    )


def _each(
    runs: Sequence[RecordedRobot], views: Callable[[RecordedRobot], list[rrb.View]]
) -> rrb.View | rrb.Container:
    """Return the views of all robots as tabs; the first views of each robot are first."""
    found = [view for alike in zip_longest(*map(views, runs)) for view in alike if view]
    return found[0] if len(found) == 1 else rrb.Tabs(*found, active_tab=0)


def _titled(run: RecordedRobot, title: str) -> str:
    return f"{run.name}: {title}" if run.name else title


def _spaces(runs: Sequence[RecordedRobot], shown: Targets) -> rrb.Container:
    """Return views of the whole cell and, for a single robot, of its targets from near."""
    by_speed = [f"- /{run.entity(speed_path.ENTITY)}/**" for run in runs]
    near = targets.near_targets(shown)
    if len(runs) > 1 or targets.extent(near) == 0.0:
        return rrb.Horizontal(space("Cell", cell_camera(runs, wide=_WIDE), 0.1, [_ALL, *by_speed]))
    (run,) = runs
    # From a distance the names of neighbours overlap.
    names = f"- /{run.entity(targets.NAMES_NEAR)}"
    codes = f"- /{run.entity(failed_moves.CODES)}"
    pins = [f"- /{run.entity(entity)}" for entity in (failed_moves.REASONS, failed_moves.PINS)]
    by_move = f"- /{run.entity(paths.TRAVELLED)}/**"
    camera = near_camera(run, near)
    fastest = f"{1000.0 * speed_path.top_speed(run):.0f}"
    return rrb.Horizontal(
        space("Cell", cell_camera(runs), 0.1, [_ALL, names, codes, *by_speed]),
        rrb.Tabs(
            space("Path", camera, 0.01, [_ALL, *pins, *by_speed]),
            space(f"Speed: blue 0, red {fastest} mm/s", camera, 0.01, [_ALL, *pins, by_move]),
            active_tab=0,
        ),
        column_shares=[5, 4],
    )


def space(name: str, camera: Viewpoint, grid_m: float, contents: list[str]) -> rrb.Spatial3DView:
    """Return a view of the world from a camera."""
    return rrb.Spatial3DView(
        origin="/",
        name=name,
        contents=contents,
        spatial_information=rrb.SpatialInformation(target_frame=WORLD, show_axes=False),
        eye_controls=rrb.EyeControls3D(
            kind=rrb.Eye3DKind.Orbital,
            position=camera.eye,
            look_target=camera.target,
            eye_up=[0.0, 0.0, 1.0],
        ),
        line_grid=rrb.LineGrid3D(
            visible=True, spacing=grid_m, color=palette.rgba(palette.GRID), stroke_width=0.6
        ),
        background=rrb.Background(color=palette.rgba(palette.BACKGROUND)),
    )


def _listing(run: RecordedRobot) -> list[rrb.View]:
    title = (
        f"Program  ({program_listing.PROGRAM_POINTER} program  "
        f"{program_listing.MOTION_POINTER} robot)"
    )
    origin = f"/{run.entity(program_listing.ENTITY)}"
    return [rrb.TextDocumentView(origin=origin, name=_titled(run, title))]


def _log() -> rrb.View:
    return rrb.TextLogView(
        origin=f"/{log.ENTITY}",
        name="FlexPendant, events, findings",
        columns=rrb.TextLogColumns(
            timeline_columns=[SIM_TIME], text_log_columns=["LogLevel", "Body"]
        ),
        rows=rrb.TextLogRows(filter_by_log_level=log.SHOWN_LEVELS),
    )


def _joints(run: RecordedRobot) -> list[rrb.View]:
    time = rrb.TimeAxis(link="LinkToGlobal")
    angles = rrb.TimeSeriesView(
        origin=f"/{run.entity(plots.ANGLES)}",
        name=_titled(run, f"Joint angle [{run.robot.units()}]"),
        axis_x=time,
        plot_legend=emptiest_corner(run.samples.times, run.samples.joints, 0.14, 0.5),
    )
    external = rrb.TimeSeriesView(
        origin=f"/{run.entity(plots.EXTERNAL)}", name=_titled(run, "external axes"), axis_x=time
    )
    shares = [_shares(run, entity, time) for entity in plots.SHARES]
    more = [external] if run.robot.external else []
    if run.sampled.simulation.belts:
        more.append(rrb.TimeSeriesView(origin=f"/{belts.ENTITY}", name="Belts", axis_x=time))
    return [angles, *more, *shares]


def _shares(run: RecordedRobot, entity: str, time: rrb.TimeAxis) -> rrb.View:
    share = plots.shares(run, entity)
    # Keep the limits and any values beyond them visible.
    end = max(_OPEN_AXIS, 1.1 * float(abs(share).max()))
    return rrb.TimeSeriesView(
        origin=f"/{run.entity('joints')}",
        contents=[f"+ /{run.entity(entity)}", f"+ /{run.entity(plots.LIMITS)}"],
        name=_titled(run, plots.SHARES[entity]),
        axis_x=time,
        axis_y=rrb.ScalarAxis(range=(-end, end)),
        plot_legend=emptiest_corner(run.samples.times, share, 0.17, 0.5),
    )


def _speed(run: RecordedRobot) -> list[rrb.View]:
    return [
        rrb.TimeSeriesView(
            origin=f"/{run.entity('tcp')}",
            contents=[
                f"+ /{run.entity(plots.PROGRAMMED_SPEED)}",
                f"+ /{run.entity(plots.SPEED)}",
            ],
            name=_titled(run, "TCP speed [mm/s]"),
            axis_x=rrb.TimeAxis(link="LinkToGlobal"),
            axis_y=rrb.ScalarAxis(range=(0.0, _speed_axis_end(run))),
            plot_legend=rrb.Corner2D.RightTop,
        )
    ]


def _speed_axis_end(run: RecordedRobot) -> float:
    """Return the upper end [mm/s] of the speed axis, with room for the legend.

    A programmed speed far above the speed of the arm, as with `vmax`, would compress the curve; it
    may exceed the plot.
    """
    reached = 1000.0 * speed_path.top_speed(run)
    programmed = float(run.robot_run.moves.columns.speed_mm_s.max(initial=0.0))
    return 1.3 * max(reached, min(programmed, 2.0 * reached), 1.0)


def _lanes(runs: Sequence[RecordedRobot]) -> rrb.View:
    return rrb.StateTimelineView(
        origin="/",
        name="Moves, signals, errors" if runs[0].sampled.simulation.errors else "Moves and signals",
        contents=[
            *(f"+ /{run.entity(state_lanes.MOVE_LANE)}" for run in runs),
            *(f"+ /{run.entity(state_lanes.LIMIT_LANE)}" for run in runs),
            *(f"+ /{run.entity(state_lanes.CLEARANCE_LANE)}" for run in runs),
            f"+ /{state_lanes.SIGNALS}/**",
            f"+ /{state_lanes.ERRORS}/**",
        ],
    )
