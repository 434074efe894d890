"""CSV: a header and a row per frame that any spreadsheet reads."""

import csv
import io

import numpy as np

from lipwright.export import encode
from tests.export.performances import performance


def test_a_row_per_frame_under_a_header() -> None:
    assert encode(performance(), ".csv").decode() == (
        "time,open,PBM\r\n-0.04,0.25,1\r\n0,0.5,0.123457\r\n"
    )


def test_names_with_commas_quotes_and_letters_survive() -> None:
    controls = ('a,"b"', "Mund\nweit", "ö 🦁")
    text = encode(performance(controls=controls), ".csv").decode()
    rows = list(csv.reader(io.StringIO(text, newline="")))
    assert tuple(rows[0]) == ("time", *controls)
    assert len(rows) == 3


def test_numbers_are_those_of_the_animation_to_six_decimals() -> None:
    made = performance()
    table = np.loadtxt(
        io.BytesIO(encode(made, ".csv")), delimiter=",", skiprows=1, dtype=np.float64
    )
    np.testing.assert_allclose(table[:, 0], made.animation.times, atol=5e-7)
    np.testing.assert_allclose(table[:, 1:], made.animation.values, atol=6e-7)
