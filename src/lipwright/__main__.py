"""``python -m lipwright`` is the command line."""

from lipwright.cli import run

run()
