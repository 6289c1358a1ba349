"""Services of the robot other than moves: stopping, searching, world zones."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from rapidsim.language.data import JointTarget, Pos, Pose, RobTarget, SpeedData
from rapidsim.language.errors import RapidError
from rapidsim.language.moves import Flank, Move, SearchStop
from rapidsim.language.path_events import ZoneShape


class PathControl(Protocol):
    """Stopping the robot on its path, and travelling other paths in between."""

    @property
    def path_level(self) -> float:
        """The path level, 1 plus the number of stored paths: the value of PathLevel."""
        ...

    def stop_move(self, *, quick: bool = False) -> None:
        """Stop the robot on its path, or as fast as it can; returns when it is at rest."""
        ...

    def fail(self, error: RapidError) -> None:
        """Stop the robot and raise an error where the program waits for it."""
        ...

    def start_move(self) -> None:
        """Restart the robot.

        Raises:
            RapidError: ERR_PATHDIST, when it is too far from where it left its path.
        """
        ...

    def is_stopped(self) -> bool:
        """Whether StopMove keeps the robot where it is."""
        ...

    def clear_path(self) -> None:
        """Discard the rest of the path of a stopped robot."""
        ...

    def store_path(self, *, keep_sync: bool = False) -> None:
        """Store the rest of the path and begin another.

        In a team, `keep_sync` begins it together with the team; otherwise the robot moves alone.
        """
        ...

    def restore_path(self) -> None:
        """Restore the path stored last; the robot continues on it after `start_move`."""
        ...


class PathRecorder(Protocol):
    """Moving back along recorded moves and forward again; places have identifiers."""

    def start_recording(self) -> int:
        """Record the moves from here on; return the number of the identifier of this place."""
        ...

    def stop_recording(self, *, clear: bool) -> None:
        """Stop recording; with `clear`, discard the record."""
        ...

    def can_move_backward(self, identifier: int | None) -> bool:
        """Whether there is a recorded path back to a place, None for the first."""
        ...

    def can_move_forward(self, identifier: int | None) -> bool:
        """Whether the robot has moved back and can move forward to a place."""
        ...

    def move_backward(
        self, identifier: int | None, offset: Pos | None, speed: SpeedData | None
    ) -> None:
        """Move back along the recorded path to a place.

        Args:
            identifier: Of the place; None for the first.
            offset: Of the TCP from the path [mm], in the tool's frame.
            speed: None for the recorded speeds.

        Raises:
            RapidError: ERR_PATH, if no such path is recorded.
        """
        ...

    def move_forward(
        self, identifier: int | None, offset: Pos | None, speed: SpeedData | None
    ) -> None:
        """Move forward again to a place; None for the start of the backward motion.

        Raises:
            RapidError: ERR_PATH, if the robot has not moved back.
        """
        ...


class PathLength(Protocol):
    """The counter of the path that the TCP travels."""

    def switch_on(self) -> None:
        """Count from here on, in addition to what was counted before."""
        ...

    def switch_off(self) -> None:
        """Stop counting and keep the value."""
        ...

    def reset(self) -> None:
        """Set the counter to 0; it stays on or off."""
        ...

    def length(self) -> float:
        """Value [mm] of the counter."""
        ...


class Searches(Protocol):
    """Moves during which a signal or a persistent is watched."""

    def search(
        self,
        move: Move,
        stop_condition: Callable[[], float] | str,
        flank: Flank,
        stop: SearchStop,
    ) -> RobTarget:
        """Make a move to a stop point and watch a signal, or a persistent, during it.

        Returns:
            Robtarget of the TCP at the first hit.

        Raises:
            RapidError: ERR_WHLSEARCH without a hit or with too many, ERR_SIGSUPSEARCH or
                ERR_PERSSUPSEARCH if the value is active at the start.
        """
        ...

    def search_joints(
        self,
        move: Move,
        stop_condition: Callable[[], float] | str,
        flank: Flank,
        stop: SearchStop,
    ) -> JointTarget:
        """Make a move as `search` does, but return the positions of all axes at the first hit."""
        ...

    def part_pose(self, search: str) -> Pose | None:
        """Pose of the part that a torch searches, in the work object in which it was taught.

        None if the station does not specify it.

        Args:
            search: Name of the search; empty if it has none.
        """
        ...


class WorldZones(Protocol):
    """Zones of space that are watched while the robot moves."""

    def watch_zone(
        self, shape: ZoneShape, signal: tuple[str, float] | None, *, before: bool = False
    ) -> float:
        """Watch a zone, from now on.

        Args:
            shape: The zone.
            signal: An output and its value while the TCP is in the zone; None stops the robot.
            before: Whether the output is set before the TCP is in the zone, not when it is.

        Returns:
            The number of the zone.
        """
        ...

    def enable_zone(self, zone: float, *, enabled: bool) -> None:
        """Switch a zone on or off."""
        ...

    def free_zone(self, zone: float) -> None:
        """Remove a zone."""
        ...
