"""System parameters, networks and devices, as clients read them when they begin."""

from pathlib import Path

import pytest
from served_controller import Served, serve

from rapidsim.controller.cell.description import GROUP_WIDTH, mapped_bits
from rapidsim.language.equipment import Attributes
from rapidsim.server.messages import Request
from rapidsim.simulation.live import signals

PROGRAM = """MODULE Still
    PROC main()
        SetDO doThird, 1;
        WaitTime 1;
    ENDPROC
ENDMODULE
"""
LACKS = ("rapidsim.toml", "[check]\nassume-missing = true\n")
"""For a signal that only the program knows."""
EIO = """EIO:CFG_1.0:6:1::
#
INDUSTRIAL_NETWORK:

      -Name "DeviceNet" -Label "Master"
#
DEVICENET_DEVICE:

      -Name "d651" -Address "12"
#
EIO_SIGNAL:

      -Name "doOpen" -SignalType "DO" -Device "d651" -Access "All"
      -Name "doShut" -SignalType "DO" -Device "d651"
      -Name "diOwn" -SignalType "DI"
"""


def test_attributes_keep_their_spelling_and_are_found_in_any_case() -> None:
    written = Attributes({"MechanicalUnit_1": "A", "name": "rob1"})
    changed = written.with_value("NAME", "rob2").with_value("Robot", "ROB_1")
    assert (written["mechanicalunit_1"], "Name" in written) == ("A", True)
    assert dict(changed) == {"MechanicalUnit_1": "A", "name": "rob2", "Robot": "ROB_1"}


def test_axes_and_groups_are_there_for_every_station(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        assert [one["_title"] for one in await served.get("rw/cfg")] == ["MOC", "SYS", "EIO"]
        arms = await served.get("rw/cfg/moc/arm/instances")
        assert [one["_title"] for one in arms] == [f"rob1_{axis}" for axis in range(1, 7)]
        first = {one["_title"]: one["value"] for one in arms[0]["attrib"]}
        assert float(first["upper_joint_bound"]) == pytest.approx(3.1416, abs=1e-4)
        (robot,) = await served.get("rw/cfg/MOC/ROBOT/instances/rob_1")
        attributes = {one["_title"]: one["value"] for one in robot["attrib"]}
        assert (attributes["use_joint_5"], attributes["base_frame_orient_u0"]) == ("rob1_6", "1")
        (group,) = await served.get("rw/cfg/sys/MECHANICAL_UNIT_GROUP/instances")
        assert {"_type": "cfg-ia-t-li", "_title": "Name", "value": "rob1"} in group["attrib"]
        async with served.client.get(f"{served.base}/rw/cfg/moc/transmission/instances") as found:
            text = await found.text()
        assert '<li class="cfg-ia-t-li" title="rotating_move"><span class="value">true<' in text
        for unknown in ("nothing", "moc/nothing/instances", "moc/robot/instances/rob_2"):
            assert await served.status(f"rw/cfg/{unknown}") == (404, -1073414146)

    serve(tmp_path, PROGRAM, use)


def test_a_cell_that_uses_sensors_has_the_option_for_them(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        _, listed = await served.get("rw/system")
        names = [one["option"] for one in listed["options"]]
        assert names == ["616-1 PC Interface", "689-1 Externally Guided Motion"]

    serve(tmp_path, PROGRAM.replace("PROC", "VAR egmident sensor;\nPROC", 1), use)


def test_attributes_are_set_all_or_none(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        arm = "rw/cfg/MOC/ARM/instances/rob1_1"
        form, url = {"upper_joint_bound": "[1.5,1]"}, f"{served.base}/{arm}?action=set"
        wrong = ({"colour": "[red,1]"}, {"lower_joint_bound": "0"})
        for more, status in (*((one, 400) for one in wrong), ({}, 204)):
            async with served.client.post(url, data={**form, **more}) as done:
                assert done.status == status
        (found,) = await served.get(arm)
        assert {"_type": "cfg-ia-t-li", "_title": "upper_joint_bound", "value": "1.5"} in found[
            "attrib"
        ]

    serve(tmp_path, PROGRAM, use)


def test_signals_stand_behind_their_devices_and_are_written_where_that_is_configured(
    tmp_path: Path,
) -> None:
    for name, text in (("RAPID/TASK1/PROGMOD/Still.mod", PROGRAM), ("SYSPAR/EIO.cfg", EIO), LACKS):
        (tmp_path / "cell" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "cell" / name).write_text(text)

    async def use(served: Served) -> None:
        signals = "rw/iosystem/signals"
        titles = [one["_title"] for one in await served.get(signals)]
        assert titles == ["DeviceNet/d651/doOpen", "DeviceNet/d651/doShut", "diOwn", "doThird"]
        place = f"{signals}/DeviceNet/d651"
        assert await served.post(f"{place}/doOpen?action=set", lvalue="1") == (204, 0)
        assert await served.post(f"{place}/doShut?action=set", lvalue="1") == (403, -1073445881)
        # Nobody else drives inputs, and what a program alone knows has no access level.
        for free in ("diOwn", "doThird"):
            assert await served.post(f"{signals}/{free}?action=set", lvalue="1") == (204, 0)
        networks = await served.get("rw/iosystem/networks")
        assert [one["name"] for one in networks] == ["Local", "DeviceNet"]
        (device,) = await served.get("rw/iosystem/devices?network=devicenet")
        assert (device["_title"], device["lstate"]) == ("DeviceNet/d651", "enabled")
        # A backup's own types count, and what it lacks is derived.
        assert "ROBOT" in [one["_title"] for one in await served.get("rw/cfg/MOC")]

    serve(tmp_path, None, use)


@pytest.mark.parametrize(
    ("text", "bits"),
    [("7", (7,)), ("2-4", (2, 3, 4)), ("1-0, 8", (1, 0, 8)), ("", ()), ("-", ()), ("9" * 5000, ())],
)
def test_the_bits_of_a_group_stand_lowest_first(text: str, bits: tuple[int, ...]) -> None:
    assert mapped_bits(text) == bits


def test_a_group_has_no_more_bits_than_a_group_can_have() -> None:
    assert mapped_bits("8-999999999,3") == tuple(range(8, 8 + GROUP_WIDTH))


def test_the_inputs_of_a_device_are_set_at_once(tmp_path: Path) -> None:
    more = """
      -Name "diNear" -SignalType "DI" -Device "d651" -DeviceMap "7"

      -Name "giPart" -SignalType "GI" -Device "d651" -DeviceMap "2-5"

      -Name "giApart" -SignalType "GI" -Device "d651" -DeviceMap "16-17, 33-32"

      -Name "giWide" -SignalType "GI" -Device "d651" -DeviceMap "64-87"

      -Name "diNowhere" -SignalType "DI" -Device "d651" -DeviceMap "-"
"""
    for name, text in (
        ("RAPID/TASK1/PROGMOD/Still.mod", PROGRAM),
        ("SYSPAR/EIO.cfg", EIO + more),
        LACKS,
    ):
        (tmp_path / "cell" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "cell" / name).write_text(text)

    async def use(served: Served) -> None:
        def put(device: str, **form: str) -> int:
            path = f"/rw/iosystem/devices/127.0.0.1/{device}/set-inputdata"
            return served.engine.reply(Request("POST", path, {}, form, generation=2)).status

        live = served.engine.live
        assert put("d651", startbyte="0", signaldata="10110100", datamask="255") == 204
        assert (signals.value_of(live, "diNear"), signals.value_of(live, "giPart")) == (1.0, 13.0)
        # What the mask leaves out stays.
        assert put("d651", startbyte="0", signaldata="00000000", datamask="132") == 204
        assert (signals.value_of(live, "diNear"), signals.value_of(live, "giPart")) == (0.0, 12.0)
        # A group need not lie in one stretch, nor end in the bytes that are set.
        assert put("d651", startbyte="2", signaldata="00000010") == 204
        assert put("d651", startbyte="4", signaldata="00000010") == 204
        assert signals.value_of(live, "giApart") == 6.0
        assert put("d651", startbyte="9", signaldata="00000001") == 204
        assert signals.value_of(live, "giWide") == 256.0
        assert put("none", startbyte="0", signaldata="00000000", datamask="1") == 404
        assert put("d651", startbyte="0", signaldata="12", datamask="1") == 400

    serve(tmp_path, None, use)
