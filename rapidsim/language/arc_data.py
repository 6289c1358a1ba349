"""Records of arc welding, an option: known so that programs with them are checked and run.

None of them affects the robot: a weld is a move of `speeddata` like any other.

Source: Application manual Arc and Arc Sensor, "Data types"; the numbers of components were compared
with declarations of programs from controllers.
"""

from __future__ import annotations

from typing import NamedTuple


class ArcData(NamedTuple):
    """Settings of the power source."""

    sched: float
    mode: float
    voltage: float
    wirefeed: float
    control: float
    current: float
    voltage2: float
    wirefeed2: float
    control2: float


class SeamData(NamedTuple):
    """Begin and end of a weld; times [s]."""

    purge_time: float
    preflow_time: float
    ign_arc: ArcData
    ign_move_delay: float
    scrape_start: float
    heat_speed: float
    heat_time: float
    heat_distance: float
    heat_arc: ArcData
    cool_time: float
    fill_time: float
    fill_arc: ArcData
    bback_time: float
    rback_time: float
    bback_arc: ArcData
    postflow_time: float


class WeldData(NamedTuple):
    """Data of the weld; speeds in the configured unit of the controller, mostly mm/s."""

    weld_speed: float
    org_weld_speed: float
    main_arc: ArcData
    org_arc: ArcData


class WeaveData(NamedTuple):
    """Weaving of the torch across the seam; lengths [mm], angles [deg]."""

    weave_shape: float
    weave_type: float
    weave_length: float
    weave_width: float
    weave_height: float
    dwell_left: float
    dwell_center: float
    dwell_right: float
    weave_dir: float
    weave_tilt: float
    weave_ori: float
    weave_bias: float
    org_weave_width: float
    org_weave_height: float
    org_weave_bias: float


class ArcTrackData(NamedTuple):
    """Seam tracking by the current of the arc."""

    track_type: float
    gain_y: float
    gain_z: float
    weld_penetration: float
    track_bias: float
    min_weave: float
    max_weave: float
    max_speed: float
    min_speed: float


class OptTrackData(NamedTuple):
    """Seam tracking with an optical sensor."""

    joint_no: float
    filter: float
    seamoffs_y: float
    seamoffs_z: float
    seamadapt_y: float
    seamadapt_z: float
    track_mode: float


class TrackData(NamedTuple):
    """Seam tracking."""

    track_system: float
    store_path: bool
    max_corr: float
    arctrack: ArcTrackData
    opttrack: OptTrackData
