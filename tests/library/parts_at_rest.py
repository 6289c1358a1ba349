"""What a controller of these tests answers about counters, test signals and grippers."""

from rapidsim.language.equipment import AxisQuantity, MechanicalUnitFacts

_WHERE = "programs of the book of the language test it"


class PartsAtRest:
    """Implements `PathLength`, `AxisSignals` and `SmartGripper`, which no routine here may use."""

    object_mm: float | None = None
    limit_mm: float = 25.0

    def switch_on(self) -> None:
        raise AssertionError(_WHERE)

    def switch_off(self) -> None:
        raise AssertionError(_WHERE)

    def reset(self) -> None:
        raise AssertionError(_WHERE)

    def length(self) -> float:
        raise AssertionError(_WHERE)

    def sample_axis(
        self,
        channel: int,
        unit: MechanicalUnitFacts,
        at: int,
        quantity: AxisQuantity,
        sample_s: float,
    ) -> None:
        raise AssertionError(_WHERE)

    def stop_sampling(self, channel: int) -> None:
        raise AssertionError(_WHERE)

    def last_sample(self, channel: int) -> float | None:
        raise AssertionError(_WHERE)

    def stop_all_sampling(self) -> None:
        raise AssertionError(_WHERE)

    def adjust(
        self,
        *,
        speed_mm_s: float | None = None,
        force_n: float | None = None,
        limit_mm: float | None = None,
    ) -> None:
        raise AssertionError(_WHERE)

    def move_fingers(self, to_mm: float) -> None:
        raise AssertionError(_WHERE)

    def stop_fingers(self) -> None:
        raise AssertionError(_WHERE)

    def await_fingers(self) -> None:
        raise AssertionError(_WHERE)

    def finger_position(self) -> float:
        raise AssertionError(_WHERE)

    def finger_speed(self) -> float:
        raise AssertionError(_WHERE)
