"""The neural engine: sound in, controls out, by a small net; from files and live.

Follows T. Frank, M. Hoch, G. Trogemann, *Automated Lip-Sync for 3D-Character Animation*
(DESIGN section 6), and goes past it: models that come with Lipwright, a stream, doubts. It
hears sound alone: no words, no phones.
"""

from lipwright.engines.neural.built_in import LIVE, WHOLE, load_model
from lipwright.engines.neural.live_model import LiveModel
from lipwright.engines.neural.stream import Frames, Stream

__all__ = ["LIVE", "WHOLE", "Frames", "LiveModel", "Stream", "load_model"]
