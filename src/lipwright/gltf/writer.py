"""Adding to a model: buffer views, accessors and objects behind those that are there.

Nothing that a model holds is changed or moved: the old bytes stay at their offsets, the
old objects at their indices.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.gltf.accessors import COMPONENTS
from lipwright.gltf.container import Gltf

VERTICES, TRIANGLES = 34962, 34963
"""What a buffer view of vertex attributes, and one of triangles' indices, is marked with."""

_CODES = {dtype: code for code, dtype in COMPONENTS.items()}
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


class GltfWriter:
    """Collects additions to a model.

    Parameters
    ----------
    model : Gltf, optional
        What to add to; None starts an empty one.

    Examples
    --------
    >>> import numpy as np
    >>> from lipwright.gltf import read_accessor
    >>> writer = GltfWriter()
    >>> index = writer.accessor(np.array([0, 0.5, 1], np.float32), limits=True)
    >>> writer.json["accessors"][index]["max"]
    [1.0]
    >>> read_accessor(writer.finish(), index).tolist()
    [0.0, 0.5, 1.0]
    """

    def __init__(self, model: Gltf | None = None) -> None:
        self._model = model or Gltf({"asset": {"version": "2.0", "generator": "Lipwright"}}, b"")
        self.json: dict[str, Any] = json.loads(json.dumps(self._model.json))
        self._parts = [self._model.binary]
        self._size = len(self._model.binary)

    def add(self, kind: str, item: dict[str, Any]) -> int:
        """Put an object behind those of its kind (``"nodes"``); return its index."""
        items = self.json.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def view(self, data: bytes, target: int | None = None) -> int:
        """Put bytes behind those of buffer 0, at a multiple of 4; return the view's index."""
        fill = -self._size % 4
        view = {"buffer": 0, "byteOffset": self._size + fill, "byteLength": len(data)}
        if target is not None:
            view["target"] = target
        self._parts += [b"\0" * fill, data]
        self._size += fill + len(data)
        return self.add("bufferViews", view)

    def accessor(
        self, values: NDArray[Any], *, limits: bool = False, target: int | None = None
    ) -> int:
        """Add an array as an accessor.

        Parameters
        ----------
        values : (N,) or (N, width) array
            Of a type that glTF knows.
        limits : bool
            Whether to state the least and greatest values.
        target : int, optional
            :data:`VERTICES` or :data:`TRIANGLES` for what is drawn from.

        Returns
        -------
        int
            The accessor's index.
        """
        accessor = _describe(values, limits)
        accessor["bufferView"] = self.view(_bytes(values), target)
        return self.add("accessors", accessor)

    def sparse(
        self, values: NDArray[np.float32], *, limits: bool = False, target: int | None = None
    ) -> int:
        """Add an array that is mostly zero: only its other rows are stored, if that is less.

        Parameters
        ----------
        values : (N, width) float32
            The array.
        limits : bool
            Whether to state the least and greatest values.
        target : int, optional
            :data:`VERTICES`, put on the view where the array is stored whole.

        Returns
        -------
        int
            The accessor's index.
        """
        rows = np.flatnonzero(np.logical_or.reduce([column != 0 for column in values.T]))
        kind = np.dtype("<u2") if len(values) <= 1 << 16 else np.dtype("<u4")
        row_size = values.shape[1] * values.itemsize
        if len(rows) * (row_size + kind.itemsize) >= len(values) * row_size:
            return self.accessor(values, limits=limits, target=target)
        accessor = _describe(values, limits)
        if len(rows):
            indices = {"bufferView": self.view(rows.astype(kind).tobytes())}
            accessor["sparse"] = {
                "count": len(rows),
                "indices": {**indices, "componentType": _CODES[kind]},
                "values": {"bufferView": self.view(_bytes(values[rows]))},
            }
        return self.add("accessors", accessor)

    def finish(self) -> Gltf:
        """Return the model with all additions."""
        document = dict(self.json)
        if self._size:
            first, *others = document.get("buffers") or [{}]
            document["buffers"] = [{**first, "byteLength": self._size}, *others]
        binary = b"".join(self._parts)
        return Gltf(document, binary, self._model.where, self._model.rest)


def _bytes(values: NDArray[Any]) -> bytes:
    return np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes()


def _describe(values: NDArray[Any], limits: bool) -> dict[str, Any]:
    width = 1 if values.ndim == 1 else values.shape[1]
    accessor: dict[str, Any] = {
        "componentType": _CODES[values.dtype.newbyteorder("<")],
        "count": len(values),
        "type": _TYPES[width],
    }
    if limits:
        columns = values.reshape(len(values), width).T
        accessor["min"] = [column.min().item() for column in columns]
        accessor["max"] = [column.max().item() for column in columns]
    return accessor
