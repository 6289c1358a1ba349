"""What a reader hears that is slower than what happens."""

from rapidsim.server.http.event_queue import EventQueue
from rapidsim.server.messages import ChangeEvent, Item


def _change(resource: str, value: int) -> ChangeEvent:
    return ChangeEvent(1, resource, (Item("ev", resource, {"value": str(value)}),))


def _heard(waiting: EventQueue) -> list[tuple[str, str]]:
    found = []
    while waiting:
        (item,) = waiting.next()
        found.append((item.title, item.fields["value"]))
    return found


def test_a_fast_resource_does_not_drive_out_the_last_value_of_a_quiet_one() -> None:
    waiting = EventQueue(most=4)
    waiting.add(_change("quiet", 1))
    for value in range(100):
        waiting.add(_change("fast", value))
    assert _heard(waiting) == [("quiet", "1"), ("fast", "97"), ("fast", "98"), ("fast", "99")]


def test_below_its_limit_nothing_is_dropped_and_the_order_stays() -> None:
    waiting = EventQueue(most=4)
    for resource, value in (("a", 1), ("b", 1), ("a", 2), ("b", 2)):
        waiting.add(_change(resource, value))
    assert _heard(waiting) == [("a", "1"), ("b", "1"), ("a", "2"), ("b", "2")]
    assert not waiting


def test_with_more_resources_than_room_the_oldest_is_dropped() -> None:
    waiting = EventQueue(most=2)
    for number in range(4):
        waiting.add(_change(str(number), 0))
    assert _heard(waiting) == [("2", "0"), ("3", "0")]
