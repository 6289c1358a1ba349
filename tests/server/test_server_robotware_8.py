"""RobotWare 8: control stations in place of masterships, as recorded on 8.1.1."""

from pathlib import Path
from typing import Any

from served_controller import Served, serve

from rapidsim.language.robotware import RobotWare
from rapidsim.server.messages import Answer, Reply, Request, SessionEnded
from rapidsim.server.versions import served_versions

IDLE = "MODULE Idle\nPERS num n := 0;\nPROC main()\nWaitTime 1;\nENDPROC\nENDMODULE\n"
STATION = {"control-station-name": "a", "pincode": "1234"}
ONE, OTHER = (f"{{{digit * 8}-2222-3333-4444-555555555555}}" for digit in "12")
ACCESS = "/rw/controlstation/writeaccess"
NUMBER = "/rw/rapid/symbol/RAPID/T_ROB1/n/data"


def test_write_access_is_requested_written_with_and_outlives_its_session(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        engine = served.engine
        engine.context.versions = served_versions(None, 8)

        def ask(method: str, path: str, session: int, **form: str) -> Reply:
            return engine.reply(Request(method, path, {}, form, session, 2))

        def code(reply: Reply) -> tuple[int, int]:
            return reply.status, getattr(reply, "code", 0)

        def post(path: str, session: int, **form: str) -> tuple[int, int]:
            return code(ask("POST", path, session, **form))

        def shown(path: str, session: int = 1) -> dict[str, Any]:
            reply = ask("GET", f"/rw/controlstation/{path}", session)
            assert isinstance(reply, Answer)
            return dict(reply.items[0].fields)

        def register(identity: str, session: int, **more: str) -> tuple[int, int]:
            form = {**STATION, "control-station-id": identity, **more}
            return post("/rw/controlstation/register/remote", session, **form)

        for path in ("", "/edit"):
            assert code(ask("GET", f"/rw/mastership{path}", 1))[0] == 410
        assert post("/rw/mastership/edit/request", 1)[0] == 410
        no_access, taken = (403, -1073435873), (403, -1073435870)
        assert post(f"{ACCESS}/request", 1) == no_access
        assert register("1111", 1)[0] == 400
        assert (register(ONE, 1), register(OTHER, 2)) == ((204, 0), (204, 0))
        assert post(NUMBER, 1, value="1") == no_access
        for _ in range(2):
            assert post(f"{ACCESS}/request", 1) == (204, 0)
        status = shown("writeaccess/status")
        assert status["control-station-write-access-held"] == "true"
        assert status["held-by-control-station-Id"] == ONE
        assert post(f"{ACCESS}/request", 2) == taken
        assert (post(NUMBER, 2, value="1"), post(f"{ACCESS}/release", 2)) == (no_access, no_access)
        assert post("/rw/rapid/execution/start", 2) == no_access
        # A write clears the mark, but the station goes on writing.
        for value in ("1", "2"):
            assert post(NUMBER, 1, value=value) == (204, 0)
        assert shown("writeaccess/status")["held-by-control-station-name"] == "none"
        assert post(f"{ACCESS}/release", 1) == no_access
        assert post(f"{ACCESS}/request", 1) == (204, 0)
        # The end of its session keeps others out, until its station comes back.
        engine.reply(SessionEnded(1))
        assert post(f"{ACCESS}/request", 2) == taken
        assert post(f"{ACCESS}/release/appeal", 2) == (204, 0)
        assert shown("writeaccess/release/appeal/changecount") == {"changecount": "1"}
        assert register(ONE, 3) == (204, 0)
        assert post(f"{ACCESS}/release", 3) == (204, 0)
        assert post(f"{ACCESS}/request", 2) == (204, 0)
        assert shown("id", 2) == {"control-station-Id": OTHER}
        assert shown("type", 2) == {"control-station-type": "Remote"}
        # A station may register so that the access goes with its session.
        assert register(OTHER, 2, **{"release-write-access-when-lost": "true"}) == (204, 0)
        assert post(f"{ACCESS}/request", 2) == (204, 0)
        engine.reply(SessionEnded(2))
        assert post(f"{ACCESS}/request", 3) == (204, 0)
        assert shown("type", 4) == {"control-station-type": "none"}
        reply = ask("GET", "/rw/system", 1)
        assert isinstance(reply, Answer)
        fields = reply.items[0].fields
        assert (fields["major"], fields["rwversion"]) == ("8", "8.1.1+614")
        assert list(fields)[-1] == "rwversionname"

    serve(tmp_path, IDLE, use)


def test_versions_follow_the_backup_unless_one_is_chosen() -> None:
    def texts(station: RobotWare | None, major: int | None = None) -> list[str]:
        versions = served_versions(station, major)
        return [versions[generation].text for generation in (1, 2)]

    recorded = ["6.16.2027", "7.21.0+229"]
    assert texts(None) == recorded
    assert texts(RobotWare(6, 8)) == ["6.8.0", "7.21.0+229"]
    assert texts(RobotWare(7, 13)) == ["6.16.2027", "7.13.0"]
    assert texts(RobotWare(7, 13), 8) == ["6.16.2027", "8.1.1+614"]
    assert texts(RobotWare(8, 1)) == ["6.16.2027", "8.1.1+614"]
    assert texts(RobotWare(6, 8), 7) == recorded
