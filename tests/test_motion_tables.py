"""The page of the publication's tables: its tool on made takes, and what it prints of theirs."""

from __future__ import annotations

from pathlib import Path

import pytest
from tools.motion_tables.__main__ import PAGE, TEMPLATE
from tools.motion_tables.lines import line
from tools.motion_tables.published import CLUSTERED, SEARCHES
from tools.motion_tables.tables import clustered, every_take, searches

from lipwright.engines.motion.database import Database, open_database
from lipwright.motion_takes import build_motion
from tests.engines.motion.takes import record


@pytest.fixture(scope="module")
def database(tmp_path_factory: pytest.TempPathFactory) -> Database:
    folder = tmp_path_factory.mktemp("a b")
    build_motion(record(folder / "takes"), folder / "db", workers=1)
    return open_database(folder / "db")


def quiet(what: str) -> None:
    """Hear nothing of what is being measured."""


def rows(table: str) -> dict[str, list[str]]:
    found = [[cell.strip() for cell in row.strip("|").split("|")] for row in table.splitlines()[2:]]
    return {cells[0]: cells[1:] for cells in found}


def test_searches_stand_beside_the_printed_ones(database: Database) -> None:
    tables = searches(database, database, quiet)
    assert set(tables) == {22, 37, 38}
    for count, table in tables.items():
        found = rows(table)
        assert found["greedy"][1] == found["optimal"][1]  # jumps
        assert int(found["pq(6)"][1]) >= int(found["greedy"][1])
        assert found["greedy"][3:] == [f"{SEARCHES[count]['greedy'][0]:.2f}", *map(
            str, SEARCHES[count]["greedy"][1:]
        )]  # fmt: skip


def test_what_was_learnt_comes_back(database: Database) -> None:
    found = rows(every_take(database, database, quiet))
    for name in ("greedy", "optimal"):
        time, jumps, rms = map(float, found[name])
        assert jumps == 0
        assert rms < 0.2
        assert time > 0


def test_clusters_stand_beside_the_printed_ones(database: Database, tmp_path: Path) -> None:
    few = {0: CLUSTERED[0], 20: CLUSTERED[200]}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("tools.motion_tables.tables.CLUSTERED", few)
        found = rows(clustered(database, tmp_path, line(database, 0, 12), quiet))
    assert list(found) == ["none", "20"]
    assert found["none"][3:] == ["53.87", "0.015", "3,591"]


def test_the_page_holds_every_table() -> None:
    page = PAGE.read_text("utf-8")
    headings = [row for row in TEMPLATE.read_text("utf-8").splitlines() if row.startswith("#")]
    assert all(heading in page for heading in headings)
    assert "<TABLE" not in page
    for table in SEARCHES.values():
        for time, jumps, rms in table.values():
            assert f"| {time:.2f} | {jumps} | {rms:.2f} |" in page
