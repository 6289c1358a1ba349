"""What a controller without traps and without a moving robot does: nothing."""

from __future__ import annotations

from rapidsim.language.error_answers import AnsweredError
from rapidsim.language.errors import RapidError


class Undisturbed:
    """Nothing changes by itself, and what fails does so at once."""

    ticks_left: int = 0
    effect_count: int = 0
    watches: bool = False

    def serve_persistent_changes(self) -> None:
        """Nobody waits for a change of one."""

    def note_unknown(self) -> None:
        """Nobody polls here."""

    def hold_until(self, time_s: float) -> None:
        """All that is told stays so for ever."""

    def has_contact(self, device: str) -> bool:
        """No device is lost."""
        return True

    def error_mark(self) -> object:
        """No statement fails."""
        return None

    def answered(self, mark: object, error: AnsweredError) -> None:
        """No clause answers."""

    def fail(self, error: RapidError) -> None:
        """There is no trap that could wait with it."""
        raise error
