"""The whole way: a typed line, the built-in head, the page, Chromium."""

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lipwright import pipeline
from lipwright.character.head import landmarks
from lipwright.performance import Performance
from tests.chromium import Opened, chromium, opened

LINE = "Papa, father, my map."
PATIENCE = 100
PERIOD = 0.1


@pytest.fixture(scope="module")
def performance() -> Performance:
    return pipeline.animate(pipeline.say(LINE))


def lip_gap(page: Opened) -> float:
    """Metres between the middles of the inner lips, as drawn now."""
    heights = page.heights("skin")
    marks = landmarks()
    return heights[marks.upper_inner_lip] - heights[marks.lower_inner_lip]


def dark_share(page: Opened, middle: tuple[float, float]) -> float:
    """Share of dark pixels around the mouth in the close-up, from the picture itself."""
    box = page.page.locator("canvas").first.bounding_box()
    assert box is not None
    data = page.page.screenshot(clip={**box})
    picture = np.asarray(Image.open(io.BytesIO(data)).convert("L"), dtype=float)
    height, width = picture.shape
    x, y = round(middle[0] * width), round(middle[1] * height)
    around = picture[y - height // 8 : y + height // 8, x - width // 24 : x + width // 24]
    return float(np.mean(around < 60))


def test_the_head_closes_on_every_p_and_m_and_opens_in_father(
    performance: Performance, tmp_path: Path
) -> None:
    path = tmp_path / "a page.html"
    pipeline.save(performance, path)
    phones = performance.animation.phones
    closed = [phone.middle for phone in phones if phone.label in ("p", "m")]
    opened_at = [phone.middle for phone in phones if phone.label in ("ɑː", "aɪ", "æ")]
    assert len(closed) == 5
    assert len(opened_at) >= 3
    with chromium() as browser, opened(browser, path) as page:
        page.ask("lipwright.setIdle(false)")
        for time in closed:
            page.at(time)
            assert abs(lip_gap(page)) < 0.0012, time  # behind it the lip's inner side seals
        for time in opened_at:
            page.at(time)
            assert lip_gap(page) > 0.003, time
        assert page.complaints == []


def test_the_picture_shows_it_and_the_page_plays(performance: Performance, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    pipeline.save(performance, path)
    phones = {phone.label: phone.middle for phone in performance.animation.phones}
    with (
        chromium() as browser,
        opened(browser, path, viewport={"width": 900, "height": 700}) as page,
    ):
        page.ask("lipwright.setIdle(false)")
        page.ask("lipwright.setView('mouth')")
        shares = {}
        for label in ("p", "ɑː"):
            page.at(phones[label])
            shares[label] = dark_share(page, (0.5, 0.55))
        assert shares["ɑː"] > shares["p"] + 0.05, shares
        page.at(0.0)
        page.ask("lipwright.setLooping(true)")  # a busy machine draws few frames of one round
        page.ask("lipwright.play()")
        morphs, times = [page.ask("lipwright.morphs().open")], [0.0]
        for _ in range(PATIENCE):
            if max(times) > 0.3 and max(morphs) > min(morphs) + 0.1:
                break
            page.page.wait_for_timeout(1000 * PERIOD)
            times.append(page.ask("lipwright.time()"))
            morphs.append(page.ask("lipwright.morphs().open"))
        assert max(times) > 0.3
        assert max(morphs) > min(morphs) + 0.1  # the mouth moves
        assert page.requests[1:] == [
            r for r in page.requests[1:] if r.startswith(("data:", "blob:"))
        ]
        assert page.complaints == []
