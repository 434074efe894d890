"""What it costs to begin: imports and ``--help``."""

import sys

from bench.measure import command, lipwright, peak_mb, say

if __name__ == "__main__":
    say("python alone", **command([sys.executable, "-c", "pass"]))
    say("import lipwright", **command([sys.executable, "-c", "import lipwright"]))
    say("lipwright --help", **command(lipwright("--help")))
    everything = "import lipwright; [getattr(lipwright, name) for name in lipwright.__all__]"
    say("import every public name", **command([sys.executable, "-c", everything]))
    say("memory of import lipwright", peak_mb=peak_mb("import lipwright"))
    say("memory of every public name", peak_mb=peak_mb(everything))
