"""The stages between sound and phones, each on what it promises."""

import itertools

import numpy as np
import pytest

from lipwright.schedule.align.features import cepstra, with_changes
from lipwright.schedule.align.heard import NO_TOKEN, Heard
from lipwright.schedule.align.lexicon import Spoken
from lipwright.schedule.align.model import AcousticModel, load_model
from lipwright.schedule.align.network import PAUSE, build_network, columns, shortest
from lipwright.schedule.align.refine import closures, refine
from lipwright.schedule.align.viterbi import best_path

CAT = ("k", "ae", "t")


@pytest.fixture(scope="module")
def model() -> AcousticModel:
    return load_model()


def word(*ways: tuple[str, ...]) -> Spoken:
    return Spoken("word", ((ways,),))


def test_the_model_is_a_set_of_distributions(model: AcousticModel) -> None:
    np.testing.assert_allclose(np.exp(model.stay) + np.exp(model.leave), 1.0, atol=1e-5)
    assert {"aa", "zh", "sil"} <= set(model.phones)
    assert {model.phones[f] for f in model.triphones.fillers} == {"sil", "+nsn+", "+spn+"}


def test_a_phone_in_context_has_states_of_that_phone(model: AcousticModel) -> None:
    ae, k, t = (model.index(p) for p in ("ae", "k", "t"))
    senones = model.triphones.of(ae, k, t, "internal")
    assert all(model.owner[s] == ae for s in senones)
    assert senones != tuple(model.triphones.senones[ae])


def test_features_do_not_hear_a_change_of_gain() -> None:
    samples = np.random.default_rng(0).normal(0, 0.05, 16000).astype(np.float32)
    soft, loud = (with_changes(cepstra(samples * gain)) for gain in (1.0, 4.0))
    assert soft.shape == (3, 101, 13)
    assert np.abs(soft - loud).max() < 0.5
    assert np.abs(soft).max() > 10


def test_digital_silence_has_features() -> None:
    assert np.isfinite(with_changes(cepstra(np.zeros(8000, np.float32)))).all()


def test_the_shortest_way_counts() -> None:
    assert shortest([word(CAT, ("k", "ae")), word(("ah",), ("ey",))]) == 3


def path_labels(model: AcousticModel, tokens: list[Spoken], truth: list[str]) -> list[str]:
    """Decode frames of which each fits one base phone only; three frames per phone."""
    network = build_network(model, tokens)
    senones, places = columns(network)
    frames = [model.index(label) for label in truth for _ in range(3)]
    scores = np.where(model.owner[senones][None, :] == np.array(frames)[:, None], 0.0, -20.0)
    path = best_path(model, network, scores.astype(np.float32), places)
    return [model.phones[network.nodes[s.node].phone] for s in path]


@pytest.mark.parametrize(
    "truth",
    [
        ["sil", *CAT, "sil", "ah", "sil"],
        [*CAT, "ey"],
        ["k", "aa", "t", "ah", "sil"],
        ["sil", "k", "aa", "t", "sil", "ey"],
    ],
)
def test_the_path_takes_the_pronunciations_and_pauses_that_fit(
    model: AcousticModel, truth: list[str]
) -> None:
    tokens = [word(CAT, ("k", "aa", "t")), word(("ah",), ("ey",))]
    assert path_labels(model, tokens, truth) == truth


def test_of_several_forms_the_one_that_fits_is_taken(model: AcousticModel) -> None:
    two, cat = (("t", "uw"),), (CAT,)
    forms = ((two, two), (two, cat))
    assert path_labels(model, [Spoken("2", forms)], ["t", "uw", *CAT]) == ["t", "uw", *CAT]
    assert path_labels(model, [Spoken("2", forms)], ["t", "uw"] * 2) == ["t", "uw"] * 2


def test_too_few_frames_have_no_path(model: AcousticModel) -> None:
    assert path_labels(model, [word(CAT), word(CAT)], ["k", "ae"]) == []


def test_phones_of_a_network_come_in_the_order_of_the_words(model: AcousticModel) -> None:
    network = build_network(model, [word(CAT), word(("ah",)), word(CAT)])
    order = [node.token for node in network.nodes if node.token != PAUSE]
    assert order == sorted(order)


def phones(*parts: tuple[str, float, float]) -> tuple[Heard, ...]:
    return tuple(
        Heard(label, start, end, NO_TOKEN if label == "sil" else 0, 0.0)
        for label, start, end in parts
    )


def burst(
    start: float, end: float, duration: float
) -> np.ndarray[tuple[int], np.dtype[np.float32]]:
    noise = np.random.default_rng(0).normal(0, 1, int(duration * 16000)).astype(np.float32)
    time = np.arange(len(noise)) / 16000
    return np.asarray(noise * np.where((time >= start) & (time < end), 0.1, 0.001), np.float32)


def test_phrases_begin_and_end_with_the_sound() -> None:
    heard = phones(("sil", 0, 0.26), ("ah", 0.26, 0.5), ("m", 0.5, 0.74), ("sil", 0.74, 1.0))
    refined = refine(heard, burst(0.3, 0.7, 1.0))
    assert refined[1].start == pytest.approx(0.3, abs=0.006)
    assert refined[2].end == pytest.approx(0.7, abs=0.006)


def test_a_short_pause_before_a_stop_is_its_closure() -> None:
    heard = phones(
        ("sil", 0, 0.3), ("ah", 0.3, 0.5), ("sil", 0.5, 0.56), ("p", 0.56, 0.6), ("ah", 0.6, 0.8)
    )
    closed = closures(heard, burst(0.3, 0.8, 1.0))
    assert [phone.label for phone in closed] == ["sil", "ah", "p", "ah"]
    assert closed[2].start == 0.5


def test_refined_phones_stay_in_order_however_short() -> None:
    labels = ["sil", *("s", "w", "eh", "t", "p", "l", "ae", "n") * 4, "sil"]
    edges = np.cumsum([0.1, *(0.03,) * (len(labels) - 2), 0.1])
    starts = [0.0, *edges[:-1]]
    heard = phones(*zip(labels, map(float, starts), map(float, edges), strict=True))
    refined = refine(heard, burst(0.1, float(edges[-2]), float(edges[-1])))
    assert all(a.end == b.start for a, b in itertools.pairwise(refined))
    assert all(phone.end - phone.start > 0.009 for phone in refined)
    assert refined[-1].end == heard[-1].end
