"""RASTA-PLP against its definition, written out slowly below, and its promises."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright.engines.motion import rasta_plp as fast
from lipwright.errors import SoundError
from lipwright.sound import Sound

Floats = NDArray[np.float64]


def bark(hertz: float) -> float:
    """Hermansky 1990, equation 3, with the angular frequency as printed."""
    x = 2 * math.pi * hertz / (1200 * math.pi)
    return 6 * math.log(x + math.sqrt(x * x + 1))


def masking(z: float) -> float:
    """Equation 4: the critical-band curve."""
    if z < -1.3 or z > 2.5:
        return 0.0
    if z <= -0.5:
        return float(10 ** (2.5 * (z + 0.5)))
    if z < 0.5:
        return 1.0
    return float(10 ** (-1.0 * (z - 0.5)))


def loudness(hertz: float) -> float:
    """Equation 7."""
    w = 2 * math.pi * hertz
    above = (w**2 + 56.8e6) * w**4
    return above / ((w**2 + 6.3e6) ** 2 * (w**2 + 0.38e9))


def slow(samples: Floats, rate: int = 16000) -> Floats:
    """The published equations one after the other, frame by frame and band by band."""
    highest = bark(rate / 2)
    count = math.ceil(highest) + 1
    centres = [highest * i / (count - 1) for i in range(count)]
    padded = np.concatenate((samples[:200][::-1], samples, samples[::-1][:200]))
    rows = []
    for first in range(0, len(padded) - 400 + 1, 160):
        window = [
            padded[first + n] * (0.54 - 0.46 * math.cos(2 * math.pi * n / 399)) for n in range(400)
        ]
        power = np.abs(np.fft.fft(window, 512)) ** 2
        barks = [bark(k * rate / 512) for k in range(257)]
        rows.append([sum(power[k] * masking(c - barks[k]) for k in range(257)) for c in centres])
    bands = np.array(rows)
    log = np.log(bands + 1e-6 * bands.max(axis=0))
    return slow_model(slow_rasta(log), centres)


def slow_rasta(log: Floats) -> Floats:
    """Hermansky and Morgan 1994, equation 1; z^2 for its z^4, which only shifts time."""
    frames, count = log.shape
    out = np.zeros_like(log)
    for b in range(count):

        def x(t: int, b: int = b) -> float:
            return float(log[min(max(t, 0), frames - 1), b])

        y = 0.0
        for t in range(frames):
            y = 0.98 * y + 0.1 * (2 * x(t + 2) + x(t + 1) - x(t - 1) - 2 * x(t - 2))
            out[t, b] = y
    return out


def slow_model(filtered: Floats, centres: list[float]) -> Floats:
    """Loudness, cube root, autocorrelation, normal equations, cepstra of the spectrum."""
    result = []
    for frame in filtered:
        heard = [
            (math.exp(v) * loudness(600 * math.sinh(c / 6))) ** (1 / 3)
            for v, c in zip(frame, centres, strict=True)
        ]
        heard[0], heard[-1] = heard[1], heard[-2]
        n = len(heard)
        r = []
        for lag in range(9):
            inner = sum(
                2 * heard[i] * math.cos(math.pi * i * lag / (n - 1)) for i in range(1, n - 1)
            )
            total = heard[0] + inner + heard[-1] * math.cos(math.pi * lag)
            r.append(total / (2 * (n - 1)))
        matrix = np.array([[r[abs(i - j)] for j in range(8)] for i in range(8)])
        a = np.linalg.solve(matrix, -np.array(r[1:]))
        gain = r[0] + sum(a[i] * r[i + 1] for i in range(8))
        # The cepstrum is the inverse transform of the model's log spectrum.
        spectrum = gain / np.abs(np.fft.fft(np.concatenate(([1.0], a)), 4096)) ** 2
        cepstrum = np.fft.ifft(np.log(spectrum)).real
        row = [cepstrum[0]] + [cepstrum[m] * m**0.6 for m in range(1, 9)]
        result.append(row)
    return np.array(result)


def speechlike(seconds: float = 0.4, seed: int = 0) -> Floats:
    """Noise and a moving buzz."""
    rng = np.random.default_rng(seed)
    t = np.arange(int(16000 * seconds)) / 16000
    buzz = sum(np.sin(2 * np.pi * h * 120 * t) / h for h in range(1, 20))
    return np.asarray(0.1 * buzz * (1 + np.sin(2 * np.pi * 4 * t)) + 0.02 * rng.normal(size=len(t)))


def test_agrees_with_the_published_equations() -> None:
    samples = speechlike().astype(np.float32)
    wanted = slow(samples.astype(np.float64))
    ours = fast.from_bands(fast.band_power(samples))
    assert ours.shape == wanted.shape == (41, 9)
    np.testing.assert_allclose(ours, wanted, atol=1e-7)


def test_a_fixed_gain_in_a_band_changes_nothing() -> None:
    power = fast.band_power(speechlike().astype(np.float32))
    gains = 10 ** np.random.default_rng(1).uniform(-4, 4, power.shape[1])
    np.testing.assert_allclose(fast.from_bands(power * gains), fast.from_bands(power), atol=1e-9)


def test_an_equaliser_between_speaker_and_microphone_hardly_matters() -> None:
    samples = speechlike(1.0)
    coloured = np.convolve(samples, [0.3, 0.15])[: len(samples)]
    plain, other = (
        fast.rasta_plp(Sound(s.astype(np.float32), 16000)).values for s in (samples, coloured)
    )
    assert np.abs(plain - other).mean() < 0.03 * plain.std()


@pytest.mark.parametrize("hertz", [0.5, 2.0, 4.0, 10.0, 20.0, 40.0])
def test_filter_has_the_published_response_without_delay(hertz: float) -> None:
    frames = np.arange(6000)
    tone = np.exp(2j * np.pi * hertz * frames / 100)
    real, imaginary = (fast.rasta(part[:, None])[:, 0] for part in (tone.real, tone.imag))
    seen = ((real + 1j * imaginary) / tone)[3000]
    z = np.exp(2j * np.pi * hertz / 100)
    published = 0.1 * z**4 * (2 + 1 / z - z**-3 - 2 * z**-4) / (1 - 0.98 / z)
    assert seen == pytest.approx(published * z**-2, abs=1e-6)


def test_filter_passes_syllables_and_stops_constants_and_28_9_hertz() -> None:
    frames = np.arange(4000)[:, None]

    def through(hertz: float) -> float:
        tone = np.cos(2 * np.pi * hertz * frames / 100)
        return float(np.abs(fast.rasta(tone)[2000:3000]).max())

    assert np.abs(fast.rasta(np.full((50, 3), 7.0))).max() == 0.0
    assert through(28.9) < 0.01
    assert through(4) > 10 * through(0.02)
    assert through(4) > 10 * through(45)


def test_frames_are_where_the_sound_is() -> None:
    samples = np.zeros(16000, np.float32)
    samples[8000:8800] = np.random.default_rng(2).normal(0, 0.1, 800)
    for rate in (25.0, 60.0, 120.0, 300.0):
        found = fast.rasta_plp(Sound(samples, 16000), rate)
        assert found.values.shape == (rate, 9)
        assert found.values.dtype == np.float32
        loudest = (int(found.values[:, 0].argmax()) + 0.5) / rate
        assert loudest == pytest.approx(0.525, abs=0.04)


def test_start_and_count_pick_frames() -> None:
    sound = Sound(speechlike(1.0).astype(np.float32), 16000)
    whole = fast.rasta_plp(sound, 60.0)
    part = fast.rasta_plp(sound, 60.0, start=0.5, count=20)
    np.testing.assert_array_equal(part.values, whole.values[30:50])
    beyond = fast.rasta_plp(sound, 60.0, start=-0.1, count=80).values
    np.testing.assert_array_equal(beyond[0], beyond[5])


@pytest.mark.parametrize("length", [1, 100, 16000])
def test_silence_and_the_shortest_sounds_have_features(length: int) -> None:
    found = fast.rasta_plp(Sound(np.zeros(length, np.float32), 16000), 60.0)
    assert np.isfinite(found.values).all()
    assert np.abs(found.values - found.values[0]).max() < 1e-5


def test_a_sound_of_another_rate_means_the_same() -> None:
    low = Sound(speechlike(1.0).astype(np.float32), 16000)
    high = low.resampled(48000)
    apart = fast.rasta_plp(low, 60.0).values - fast.rasta_plp(high, 60.0).values
    assert np.abs(apart).mean() < 0.05


def test_no_samples_are_refused() -> None:
    with pytest.raises(SoundError, match="without samples"):
        fast.rasta_plp(Sound(np.zeros(0, np.float32), 16000))
