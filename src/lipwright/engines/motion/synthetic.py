"""The database that comes with Lipwright, and how databases are named.

It is synthetic: its takes are spoken by a synthesiser and moved by the bigram engine, each in
a speaking style of its own. ``python -m tools.synthetic_motion`` makes it.
"""

from __future__ import annotations

from pathlib import Path

NAME = "synthetic"
FOLDER = Path(__file__).parents[2] / "data" / "motion" / NAME
ABOUT = (
    "the database is synthetic: made by the bigram engine; build one from recordings with "
    "'lipwright motion build'"
)


def database_folder(database: str | Path | None) -> Path:
    """Return the folder of a database: what exists by that name, else the built-in one.

    Examples
    --------
    >>> database_folder(None) == database_folder("synthetic") == FOLDER
    True
    >>> database_folder("faces").name
    'faces'
    """
    if database is None:
        return FOLDER
    given = Path(database)
    return FOLDER if str(database) == NAME and not given.exists() else given
