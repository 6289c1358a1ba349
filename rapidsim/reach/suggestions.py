"""Suggestions that make unreachable targets reachable: a shift of the work object, a turn."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import has_branches
from rapidsim.motion.configurations.reach_suggestions import least_turn, nearest_shift, reachable
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.arm_configurations import EndSolutions
from rapidsim.reach.target_poses import PosedMoves
from rapidsim.reach.wording import data_of
from rapidsim.repeated_rows import Index

MOST_SEARCHES = 24
"""Largest number of searches for one program; a shift of a whole work object is searched once."""
_MINOR = 0.35
"""Share of a shift below which a direction is not mentioned."""


@dataclass(eq=False)
class ReachSuggestions:
    """Suggestions, searched on demand; if possible, one for all targets of a work object."""

    program: Program
    posed: PosedMoves
    ends: EndSolutions
    robot: Robot
    base_from_world: Transform
    _shifts: dict[object, tuple[Array | None, int]] = field(default_factory=dict)
    """By work object: the shift that makes all its targets reachable, and their number."""
    _searched: int = 0

    def of(self, row: int) -> str | None:
        """Return the suggestion for a move with an unreachable end; None if none was found."""
        if not has_branches(self.robot.kinematics) or self.posed.carried[row]:
            return None
        parts = [part for part in (self._shift(row), self._turn(row)) if part is not None]
        return ", or ".join(parts) if parts else None

    def _shift(self, row: int) -> str | None:
        known = self.posed.moves[row]
        wobj = data_of(self.program, known, "wobj")
        if wobj is not None and wobj.node is not None:
            key = known.move.wobj
            if key not in self._shifts:
                same = self.posed.moves.each(lambda known: known.move.wobj == key)
                same &= self.ends.looked_at & ~self.posed.to_axes
                self._shifts[key] = self._searched_shift(np.flatnonzero(same)), int(same.sum())
            shift, count = self._shifts[key]
            if shift is not None:
                every = "all its targets are" if count > 1 else "it is"
                return f"{every} in reach with `{wobj.name}` moved {self._words(row, shift)}"
        shift = self._searched_shift(np.array([row]))
        if shift is None:
            return None
        return f"it is in reach if moved {self._words(row, shift)}"

    def _searched_shift(self, rows: Index) -> Array | None:
        self._searched += 1
        if self._searched > MOST_SEARCHES:
            return None
        return nearest_shift(self.robot, self.posed.base_from_flange[rows])

    def _turn(self, row: int) -> str | None:
        posed = self.posed
        if self._searched > MOST_SEARCHES:
            return None
        tcp_from_flange = posed.placed(row).tcp_from_flange
        turn = least_turn(self.robot, posed.curve_from_tcp[row], tcp_from_flange)
        if turn is not None:
            return f"with the tool turned {turn.degrees:+.0f} deg about its {turn.axis}"
        flange = posed.curve_from_tcp[row : row + 1]
        if np.any(tcp_from_flange.translation) and reachable(self.robot, flange)[0]:
            return "with tool0"
        return None

    def _words(self, row: int, shift: Array) -> str:
        """Describe a shift (3,) [m] in base: distance, directions, world coordinates."""
        size = float(np.linalg.norm(shift))
        numbers = (self.base_from_world.rotation.T @ shift) * 1e3
        text = ",".join(f"{number:g}" for number in np.round(numbers, 1) + 0.0)
        return f"{1e3 * size:.0f} mm {self._directions(row, shift / size)} by [{text}]"

    def _directions(self, row: int, unit: Array) -> str:
        """Return the main directions of a unit vector (3,) in base, seen from the target."""
        at = self.posed.base_from_flange.translation[row].copy()
        at[2] = 0.0
        outward = at / max(float(np.linalg.norm(at)), 1e-9)
        left = np.cross([0.0, 0.0, 1.0], outward)
        shares = [
            (float(unit @ outward), "away from the base", "toward the base"),
            (float(unit[2]), "up", "down"),
            (float(unit @ left), "to the left", "to the right"),
        ]
        shares.sort(key=lambda share: -abs(share[0]))
        words = [
            plus if size > 0.0 else minus for size, plus, minus in shares if abs(size) > _MINOR
        ]
        return " and ".join(words)
