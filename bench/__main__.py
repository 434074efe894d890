"""Run every measure, one after the other, each in a process of its own."""

import subprocess
import sys

MEASURES = ("startup", "speaking", "stages", "models", "aligning", "robustness", "quality")

if __name__ == "__main__":
    chosen = sys.argv[1:] or MEASURES
    sys.exit(max(subprocess.call([sys.executable, "-m", f"bench.{name}"]) for name in chosen))
