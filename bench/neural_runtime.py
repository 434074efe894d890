"""Which runtime for the live net: numpy or onnxruntime? Time, size, start; and the same bits?

The same convolutions as an ONNX graph, in single precision as nets are usually served. Needs
``pip install onnx onnxruntime``; without them nothing is measured.
"""

import importlib.util
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.measure import milliseconds, say
from lipwright.engines.neural.built_in import live_model
from lipwright.engines.neural.convolution import Affine, on_grid
from lipwright.engines.neural.live_model import LiveModel

FRAMES = 3000
Singles = NDArray[np.float32]


def graph(model: LiveModel) -> bytes:
    """The convolutions as ONNX: (1, 160, T) to (1, C, T)."""
    from onnx import TensorProto, helper, numpy_helper

    nodes: list[Any] = []
    weights: list[Any] = []

    def convolution(layer: Affine, taps: int, dilation: int, source: str, to: str) -> None:
        inputs, units = len(layer.weights) // taps, len(layer.bias)
        kernel = layer.weights.reshape(taps, inputs, units).transpose(2, 1, 0)
        for name, value in ((f"{to}w", kernel), (f"{to}b", layer.bias)):
            weights.append(numpy_helper.from_array(value.astype(np.float32), name))
        back = dilation * (taps - 1)
        nodes.append(
            helper.make_node(
                "Conv", [source, f"{to}w", f"{to}b"], [to], dilations=[dilation], pads=[back, 0]
            )
        )

    convolution(model.net.first, 1, 1, "heard", "a")
    nodes.append(helper.make_node("Relu", ["a"], ["x0"]))
    for number, block in enumerate(model.net.blocks):
        convolution(block.taps, 3, block.dilation, f"x{number}", f"t{number}")
        nodes.append(helper.make_node("Relu", [f"t{number}"], [f"r{number}"]))
        convolution(block.back, 1, 1, f"r{number}", f"k{number}")
        nodes.append(helper.make_node("Add", [f"x{number}", f"k{number}"], [f"x{number + 1}"]))
    nodes.append(helper.make_node("Relu", [f"x{len(model.net.blocks)}"], ["made"]))
    inputs = len(model.net.first.weights)
    heard = helper.make_tensor_value_info("heard", TensorProto.FLOAT, [1, inputs, "T"])
    made = helper.make_tensor_value_info("made", TensorProto.FLOAT, [1, model.net.units, "T"])
    whole = helper.make_graph(nodes, "net", [heard], [made], weights)
    opset = [helper.make_opsetid("", 17)]
    return bytes(helper.make_model(whole, opset_imports=opset, ir_version=8).SerializeToString())


def size_mb(package: str) -> float:
    """Size of an installed package's folder."""
    found = importlib.util.find_spec(package)
    assert found is not None
    assert found.origin is not None
    folder = Path(found.origin).parent
    files = [path for path in folder.rglob("*") if path.is_file()]
    return round(sum(path.stat().st_size for path in files) / 1e6, 1)


def start_ms(statement: str) -> float:
    """How long an import takes in a fresh Python, over that of an empty one."""

    def run(code: str) -> float:
        times = []
        for _ in range(7):
            before = time.perf_counter()
            subprocess.run([sys.executable, "-c", code], check=True)
            times.append(time.perf_counter() - before)
        return 1e3 * float(np.median(times))

    return round(run(statement) - run("pass"), 1)


def main() -> None:
    """Print both."""
    import onnxruntime

    model = live_model()
    rng = np.random.default_rng(0)
    heard = on_grid(rng.random((FRAMES, len(model.net.first.weights))))
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    session = onnxruntime.InferenceSession(
        graph(model), options, providers=["CPUExecutionProvider"]
    )
    given = np.ascontiguousarray(heard.astype(np.float32).T[None])

    def ours(rows: NDArray[np.float64]) -> NDArray[np.float64]:
        return model.net(rows, model.net.rest())

    def theirs(rows: Singles) -> Singles:
        made: Singles = session.run(None, {"heard": rows})[0]
        return made

    memory, reach = model.net.rest(), model.net.reach
    window = given[:, :, : reach + 1].copy()
    whole = theirs(given)[0].T
    last = theirs(window)[0, :, -1]
    say(
        "numpy, exact sums",
        minute_ms=milliseconds(lambda: ours(heard), 9)["median_ms"],
        frame_ms=milliseconds(lambda: model.net(heard[:1], memory), 200)["median_ms"],
        import_ms=start_ms("import numpy"),
        package_mb=size_mb("numpy"),
    )
    say(
        "onnxruntime, one thread",
        minute_ms=milliseconds(lambda: theirs(given), 9)["median_ms"],
        frame_ms_from_a_window=milliseconds(lambda: theirs(window), 200)["median_ms"],
        import_ms=start_ms("import onnxruntime"),
        package_mb=size_mb("onnxruntime"),
        farthest_off=float(np.abs(whole - ours(heard)).max()),
        streamed_as_whole=bool(np.array_equal(last, whole[reach])),
    )


if __name__ == "__main__":
    if all(map(importlib.util.find_spec, ("onnx", "onnxruntime"))):
        main()
