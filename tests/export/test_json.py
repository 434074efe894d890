"""JSON: the lossless file, as the animation writes it itself."""

from lipwright.animation import Animation
from lipwright.export import encode
from tests.export.performances import performance


def test_it_is_the_animations_own_file() -> None:
    animation = performance().animation
    written = encode(performance(), ".json")
    assert written == animation.to_bytes()
    assert Animation.from_bytes(written).controls == animation.controls
