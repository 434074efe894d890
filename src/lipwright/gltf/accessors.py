"""Accessors: typed arrays inside a model's buffers, dense and sparse.

Section 3.6.2 of the glTF 2.0 specification. Reads; :mod:`lipwright.gltf.writer` writes.
Compressed geometry (Draco, meshopt) is not unpacked.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from lipwright.errors import FileFormatError
from lipwright.gltf.container import LARGEST, Gltf, structure

COMPONENTS: dict[int, np.dtype[Any]] = {
    5120: np.dtype("<i1"),
    5121: np.dtype("<u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


def read_accessor(model: Gltf, index: int) -> NDArray[Any]:
    """Return the content of an accessor.

    Parameters
    ----------
    model : Gltf
        The model.
    index : int
        Which of its accessors.

    Returns
    -------
    (N,) or (N, width) array
        In the file's own type; normalised integers as float32.

    Raises
    ------
    FileFormatError
        If it does not exist, or reaches beyond its data.
    """
    where = f"{model.where}, accessor {index}"
    accessors = model.items("accessors")
    if not isinstance(index, int) or not 0 <= index < len(accessors):
        raise FileFormatError("does not exist", where=where)
    accessor = accessors[index]
    with structure(where):
        dtype, width = COMPONENTS[accessor["componentType"]], WIDTHS[accessor["type"]]
        count = accessor["count"]
        if not isinstance(count, int) or not 0 < count < LARGEST:
            raise FileFormatError(f"holds {count!r} elements", where=where, expected="1 or more")
        if "bufferView" in accessor:
            values = _view(model, accessor, dtype, count, width, where).copy()
        else:
            values = np.zeros((count, width), dtype)
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            kind = COMPONENTS[sparse["indices"]["componentType"]]
            at = _view(model, sparse["indices"], kind, sparse["count"], 1, where)[:, 0]
            values[at] = _view(model, sparse["values"], dtype, sparse["count"], width, where)
    if accessor.get("normalized") and dtype.kind in "iu":
        values = np.maximum(values / np.float32(np.iinfo(dtype).max), -1).astype(np.float32)
    return values[:, 0] if width == 1 else values


def _view(
    model: Gltf, part: dict[str, Any], dtype: DTypeLike, count: int, width: int, where: str
) -> NDArray[Any]:
    view = model.items("bufferViews")[part["bufferView"]]
    if view["buffer"] != 0:
        raise FileFormatError("lies outside the binary chunk", where=where)
    start = view.get("byteOffset", 0)
    inside = model.binary[start : start + view["byteLength"]]
    size = np.dtype(dtype).itemsize
    strides = (view.get("byteStride", width * size), size)
    offset = part.get("byteOffset", 0)
    if count and offset + strides[0] * (count - 1) + width * size > len(inside):
        raise FileFormatError("reaches beyond its data", where=where)
    return np.ndarray((count, width), dtype, inside, offset, strides)
