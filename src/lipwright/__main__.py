"""``python -m lipwright``, and the console script: the command line.

Nothing else is imported before an interrupt can be answered.
"""

import sys


def run() -> None:
    """Run the command line and leave with its exit status."""
    try:
        from lipwright.cli import run_and_leave

        run_and_leave()
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    run()
