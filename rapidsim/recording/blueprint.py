"""How the viewer lays a run out when it is opened."""

from __future__ import annotations

import rerun.blueprint as rrb

from rapidsim.recording import lanes, listing, log, palette, plots, targets
from rapidsim.recording.camera import Camera, cell_camera, near_camera
from rapidsim.recording.legend import emptiest_corner
from rapidsim.recording.sampled import SampledRun
from rapidsim.recording.targets import Target
from rapidsim.recording.timelines import SIM_TIME
from rapidsim.recording.transforms import WORLD


def blueprint(run: SampledRun, shown: tuple[Target, ...]) -> rrb.Blueprint:
    """The layout: cell and program above, plots and lanes below."""
    return rrb.Blueprint(
        rrb.Vertical(
            rrb.Horizontal(
                _spaces(run, shown),
                rrb.Vertical(_listing(), _log(), row_shares=[3, 2]),
                column_shares=[64, 36],
            ),
            rrb.Horizontal(_joints(run), _speed(run), _lanes(), column_shares=[1, 1, 1]),
            row_shares=[8, 5],
        ),
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


def _spaces(run: SampledRun, shown: tuple[Target, ...]) -> rrb.Container:
    """The whole cell, and the targets from near."""
    near = targets.near_targets(shown)
    if targets.extent(near) == 0.0:
        return rrb.Horizontal(_space("Cell", cell_camera(run), 0.1, []))
    # From afar the names of neighbours cover each other.
    cell = _space("Cell", cell_camera(run), 0.1, [f"- /{targets.NAMES_NEAR}"])
    path = _space("Path", near_camera(run, near), 0.01, [])
    return rrb.Horizontal(cell, path, column_shares=[5, 4])


def _space(name: str, camera: Camera, grid_m: float, hidden: list[str]) -> rrb.Spatial3DView:
    return rrb.Spatial3DView(
        origin="/",
        name=name,
        contents=["+ /**", *hidden],
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


def _listing() -> rrb.View:
    return rrb.TextDocumentView(
        origin=f"/{listing.ENTITY}",
        name=f"Program  ({listing.PROGRAM_POINTER} program  {listing.MOTION_POINTER} robot)",
    )


def _log() -> rrb.View:
    return rrb.TextLogView(
        origin=f"/{log.ENTITY}",
        name="FlexPendant and events",
        columns=rrb.TextLogColumns(
            timeline_columns=[SIM_TIME], text_log_columns=["LogLevel", "Body"]
        ),
        rows=rrb.TextLogRows(filter_by_log_level=log.SHOWN_LEVELS),
    )


def _joints(run: SampledRun) -> rrb.Container:
    time = rrb.TimeAxis(link="LinkToGlobal")
    share = plots.share_of_range(run)
    # The limits are in sight, and what goes beyond them too.
    ends = 1.1 * max(100.0, float(abs(share).max()))
    return rrb.Tabs(
        rrb.TimeSeriesView(
            origin=f"/{plots.ANGLES}",
            name="Joint angles [deg]",
            axis_x=time,
            plot_legend=emptiest_corner(run.samples.times, run.samples.joints, 0.14, 0.5),
        ),
        rrb.TimeSeriesView(
            origin="/joints",
            contents=[f"+ /{plots.RANGE}", f"+ /{plots.RANGE_LIMITS}"],
            name="Joint range [%]",
            axis_x=time,
            axis_y=rrb.ScalarAxis(range=(-ends, ends)),
            plot_legend=emptiest_corner(run.samples.times, share, 0.17, 0.5),
        ),
        active_tab=0,
    )


def _speed(run: SampledRun) -> rrb.View:
    return rrb.TimeSeriesView(
        origin="/tcp",
        contents=[f"+ /{plots.PROGRAMMED_SPEED}", f"+ /{plots.SPEED}"],
        name="TCP speed [mm/s]",
        axis_x=rrb.TimeAxis(link="LinkToGlobal"),
        axis_y=rrb.ScalarAxis(range=(0.0, _speed_axis_end(run))),
        plot_legend=rrb.Corner2D.RightTop,
    )


def _speed_axis_end(run: SampledRun) -> float:
    """Upper end [mm/s] of the speed axis, with air for the legend.

    A speed that is programmed far beyond what the arm reaches, as with `vmax`, would squash what it
    does; it is left to run out of the plot.
    """
    reached = 1000.0 * float(run.samples.tcp_speed.max())
    programmed = max((move.move.speed.v_tcp for move in run.simulation.moves), default=0.0)
    return 1.3 * max(reached, min(programmed, 2.0 * reached), 1.0)


def _lanes() -> rrb.View:
    return rrb.StateTimelineView(
        origin="/",
        name="Moves and signals",
        contents=[f"+ /{lanes.MOVE_LANE}", f"+ /{lanes.SIGNALS}/**"],
    )
