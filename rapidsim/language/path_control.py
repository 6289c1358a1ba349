"""What a running task may ask of its robot besides moving it: stopping, searching, world zones."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from rapidsim.language.data import JointTarget, Pos, Pose, RobTarget, SpeedData
from rapidsim.language.errors import RapidError
from rapidsim.language.moves import Flank, Move, SearchStop
from rapidsim.language.path_events import ZoneShape


class PathControl(Protocol):
    """Stopping the robot on its path, and travelling other paths meanwhile."""

    @property
    def path_level(self) -> float:
        """How many paths are stored, counted from 1: the value of PathLevel."""
        ...

    def stop_move(self, *, quick: bool = False) -> None:
        """Stop the robot on its path, or as fast as it can; returns when it stands."""
        ...

    def fail(self, error: RapidError) -> None:
        """Stop the robot; the error is raised where the program waits for it."""
        ...

    def start_move(self) -> None:
        """Let the robot go on.

        Raises:
            RapidError: ERR_PATHDIST, when it stands too far from where it left its path.
        """
        ...

    def is_stopped(self) -> bool:
        """Whether StopMove keeps the robot where it is."""
        ...

    def clear_path(self) -> None:
        """Forget the rest of the path of a robot that was stopped."""
        ...

    def store_path(self, *, keep_sync: bool = False) -> None:
        """Store the rest of the path and begin another.

        In a team, `keep_sync` begins it together with the team; otherwise the robot moves alone.
        """
        ...

    def restore_path(self) -> None:
        """Take up the path that was kept; the robot goes on with it after `start_move`."""
        ...


class PathRecorder(Protocol):
    """Going back along recorded moves and forward again; places have identifiers."""

    def start_recording(self) -> int:
        """Record the moves from here on; the number of the identifier of this place."""
        ...

    def stop_recording(self, *, clear: bool) -> None:
        """Record no further moves; with `clear`, forget all."""
        ...

    def can_move_backward(self, identifier: int | None) -> bool:
        """Whether there is a recorded way back to a place, None for the first."""
        ...

    def can_move_forward(self, identifier: int | None) -> bool:
        """Whether the robot has gone back and can go forward to a place."""
        ...

    def move_backward(
        self, identifier: int | None, offset: Pos | None, speed: SpeedData | None
    ) -> None:
        """Go back on the recorded path to a place.

        Args:
            identifier: Of the place; None for the first.
            offset: Of the TCP from the path [mm], in the tool's frame.
            speed: None for the recorded speeds.

        Raises:
            RapidError: ERR_PATH, where no such path is recorded.
        """
        ...

    def move_forward(
        self, identifier: int | None, offset: Pos | None, speed: SpeedData | None
    ) -> None:
        """Go forward again to a place; None for where the way back began.

        Raises:
            RapidError: ERR_PATH, where the robot has not gone back.
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
    """Moves on which a signal or a persistent is watched."""

    def search(
        self,
        move: Move,
        stop_condition: Callable[[], float] | str,
        flank: Flank,
        stop: SearchStop,
    ) -> RobTarget:
        """Make a move to a stop point and watch a signal, or a persistent, on the way.

        Returns:
            Where the TCP was at the first hit.

        Raises:
            RapidError: ERR_WHLSEARCH without a hit or with too many, ERR_SIGSUPSEARCH or
                ERR_PERSSUPSEARCH if the value was there at the start.
        """
        ...

    def search_joints(
        self,
        move: Move,
        stop_condition: Callable[[], float] | str,
        flank: Flank,
        stop: SearchStop,
    ) -> JointTarget:
        """As `search`, but tell where all axes were at the first hit."""
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
            signal: An output and the value it has while the TCP is there; None stops the robot.
            before: The output is set before the TCP gets there, not when it is there.

        Returns:
            The number of the zone.
        """
        ...

    def enable_zone(self, zone: float, *, enabled: bool) -> None:
        """Switch a zone on or off."""
        ...

    def free_zone(self, zone: float) -> None:
        """Forget a zone."""
        ...
