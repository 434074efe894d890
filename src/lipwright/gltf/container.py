"""The containers of glTF 2.0: ``.glb`` and ``.vrm`` (binary), ``.gltf`` (JSON and files).

Section 4.4 (GLB) and 3.6.1 (buffers) of the specification. Whatever container a model
comes in, it leaves as one GLB. Files that a ``.gltf`` names are looked for beside or
below it, nowhere else; textures that are not there stay named, missing buffers are an
error.
"""

from __future__ import annotations

import base64
import binascii
import json
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote, unquote_to_bytes

from lipwright.errors import FileFormatError, InputError, LipwrightError
from lipwright.files import parse_json, read_bytes

MAGIC = b"glTF"
LARGEST = 1 << 30
"""Larger files are refused before they are read, in bytes."""

_MEDIA = {".png": "image/png", ".jpg": "image/jpeg", ".jpeg": "image/jpeg", ".webp": "image/webp"}
_OTHERS = {
    ".obj": "give it a mouth with 'lipwright character build'",
    ".fbx": "convert it to GLB, with its blend shapes (shape keys)",
    ".blend": "export it from Blender as GLB, with its shape keys",
}
_CURE = "export the model again, or fetch the file again"


@dataclass(frozen=True, slots=True, eq=False)
class Gltf:
    """A glTF model in memory.

    Parameters
    ----------
    json : dict
        The document. Treat as read-only: a :class:`~lipwright.gltf.GltfWriter` copies it.
    binary : bytes
        The content of buffer 0, of which new data go to the end.
    where : str
        The file's name in errors.
    rest : bytes
        Chunks behind the two that the specification defines, kept as they are.
    """

    json: dict[str, Any]
    binary: bytes
    where: str = "model"
    rest: bytes = b""

    def items(self, kind: str) -> list[dict[str, Any]]:
        """Return a top-level array of objects (``"meshes"``), empty where there is none.

        Raises
        ------
        FileFormatError
            If it is something else.
        """
        found = self.json.get(kind, [])
        if not isinstance(found, list) or not all(isinstance(item, dict) for item in found):
            raise FileFormatError(
                f"{kind!r} is not a list of objects", where=self.where, expected="a glTF 2.0 model"
            )
        return found

    def to_glb(self) -> bytes:
        """Return the model as the bytes of a GLB file.

        Raises
        ------
        InputError
            If it would exceed the 4 GB that the format can count.
        """
        text = json.dumps(self.json, ensure_ascii=False, separators=(",", ":")).encode()
        chunks = _chunk(b"JSON", text, b" ")
        if self.binary:
            chunks += _chunk(b"BIN\0", self.binary, b"\0")
        length = 12 + len(chunks) + len(self.rest)
        if length >= 1 << 32:
            raise InputError(f"{length} bytes", where=self.where, expected="a GLB under 4 GB")
        return struct.pack("<4sII", MAGIC, 2, length) + chunks + self.rest


@contextmanager
def structure(where: str) -> Iterator[None]:
    """Turn what goes wrong on a document of the wrong structure into an error of the file."""
    try:
        yield
    except LipwrightError:
        raise
    except (TypeError, AttributeError, LookupError, ValueError, OverflowError) as error:
        raise FileFormatError(
            f"breaks the structure of glTF ({type(error).__name__}: {error})",
            where=where,
            cure="export the model again",
        ) from None


def read_gltf(path: str | Path) -> Gltf:
    """Return the model in a ``.glb``, ``.vrm`` or ``.gltf`` file.

    Which of the two containers it is, its first bytes say, not its name.

    Raises
    ------
    InputError
        If the file cannot be read, or is larger than :data:`LARGEST`.
    FileFormatError
        If its content breaks the format: the message names the place.
    """
    path = Path(path)
    if path.is_file() and path.stat().st_size > LARGEST:
        raise InputError(
            f"{path.stat().st_size / 1e9:.1f} GB",
            where=str(path),
            expected=f"a model of at most {LARGEST / 1e9:.1f} GB",
            cure="export the head alone, or with smaller textures",
        )
    data = read_bytes(path)
    if not data:
        raise FileFormatError("is empty", where=str(path), expected="a GLB, VRM or glTF file")
    if data[:4] == MAGIC:
        return parse_glb(data, str(path), path.parent)
    if data.lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"{":
        return parse_gltf(data, str(path), path.parent)
    raise FileFormatError(
        f"starts with {data[:4]!r}",
        where=str(path),
        expected="a GLB, VRM or glTF file",
        cure=_OTHERS.get(path.suffix.lower(), ""),
    )


def parse_glb(data: bytes, where: str = "model", folder: Path | None = None) -> Gltf:
    """Return the model in the bytes of a GLB file.

    Parameters
    ----------
    data : bytes
        The whole file.
    where : str
        Its name in errors.
    folder : Path, optional
        Where files that it names are looked for; None means nowhere.

    Raises
    ------
    FileFormatError
        If the container is cut, lies about its lengths, or is not glTF 2.0.
    """
    if data[:4] != MAGIC:
        raise FileFormatError(f"starts with {data[:4]!r}", where=where, expected="a GLB file")
    if len(data) < 20:
        raise FileFormatError(f"ends after {len(data)} bytes", where=where, cure=_CURE)
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise FileFormatError(
            f"glTF version {version}", where=where, expected="version 2", cure="export it as glTF 2"
        )
    if length > len(data):
        raise FileFormatError(
            f"is cut: {len(data)} bytes", where=where, expected=f"{length} bytes", cure=_CURE
        )
    (kind, text), *others = _chunks(data, length, where)
    if kind != b"JSON":
        raise FileFormatError(
            f"its first chunk is {kind!r}", where=f"{where}, byte 12", expected="a JSON chunk"
        )
    document = parse_json(text.rstrip(b" \0"), where)
    binary = None
    if others and others[0][0] == b"BIN\0":
        binary = others.pop(0)[1]
    rest = b"".join(struct.pack("<I4s", len(body), kind) + body for kind, body in others)
    return _whole(document, binary, where, folder, rest)


def parse_gltf(data: bytes, where: str = "model", folder: Path | None = None) -> Gltf:
    """Return the model in the bytes of a ``.gltf`` file; see :func:`parse_glb`."""
    return _whole(parse_json(data, where), None, where, folder, b"")


def _chunk(kind: bytes, body: bytes, fill: bytes) -> bytes:
    padded = body + fill * (-len(body) % 4)
    return struct.pack("<I4s", len(padded), kind) + padded


def _chunks(data: bytes, end: int, where: str) -> list[tuple[bytes, bytes]]:
    found = []
    at = 12
    while at + 8 <= end:
        length, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + length > end:
            raise FileFormatError(
                f"the chunk {kind!r} says {length} bytes, but {end - at - 8} follow",
                where=f"{where}, byte {at}",
                cure=_CURE,
            )
        found.append((kind, data[at + 8 : at + 8 + length]))
        at += 8 + length
    return found


def _whole(
    document: Any, binary: bytes | None, where: str, folder: Path | None, rest: bytes
) -> Gltf:
    version = _version(document, where)
    if not version.startswith("2."):
        raise FileFormatError(f"glTF version {version!r}", where=where, expected="version 2.0")
    needed = document["asset"].get("minVersion", "2.0")
    if needed != "2.0":
        raise FileFormatError(
            f"needs glTF {needed}", where=where, expected="2.0", cure="export it as glTF 2.0"
        )
    model = Gltf(document, binary or b"", where, rest)
    for kind in ("buffers", "bufferViews", "accessors", "meshes", "nodes", "images", "animations"):
        model.items(kind)
    with structure(where):
        return _embed(model, binary, folder)


def _version(document: Any, where: str) -> str:
    asset = document.get("asset") if isinstance(document, dict) else None
    if not isinstance(asset, dict) or not isinstance(asset.get("version"), str):
        raise FileFormatError("has no asset.version", where=where, expected="a glTF 2.0 model")
    return str(asset["version"])


def _embed(model: Gltf, binary: bytes | None, folder: Path | None) -> Gltf:
    """Take in what lies beside the file, so that the model is whole on its own."""
    buffers = [dict(buffer) for buffer in model.items("buffers")]
    for index, buffer in enumerate(buffers):
        place = f"{model.where}, buffer {index}"
        length = buffer.get("byteLength")
        if not isinstance(length, int) or length < 1:
            raise FileFormatError(f"byteLength {length!r}", where=place, expected="1 or more")
        content = binary if index == 0 and "uri" not in buffer else None
        if "uri" in buffer:
            content = _fetch(buffer["uri"], place, folder)
            if index == 0:
                del buffer["uri"]
                binary = content
            elif not buffer["uri"].startswith("data:"):
                buffer["uri"] = _data_uri("application/octet-stream", content)
        elif index == 0 and binary is None:
            raise FileFormatError("has no binary chunk", where=place, cure=_CURE)
        if content is not None and len(content) < length:
            raise FileFormatError(
                f"{len(content)} bytes", where=place, expected=f"{length} bytes", cure=_CURE
            )
    changed = {"buffers": buffers} if buffers else {}
    images = [_embedded_image(image, folder) for image in model.items("images")]
    if images:
        changed["images"] = images
    binary = binary if buffers and binary is not None else b""
    return Gltf({**model.json, **changed}, binary, model.where, model.rest)


def _fetch(uri: Any, place: str, folder: Path | None) -> bytes:
    if not isinstance(uri, str):
        raise FileFormatError(f"the address {uri!r}", where=place, expected="text")
    if uri.startswith("data:"):
        head, _, body = uri.partition(",")
        try:
            if head.endswith(";base64"):
                return base64.b64decode(body, validate=True)
            return unquote_to_bytes(body)
        except (binascii.Error, ValueError):
            raise FileFormatError("broken base64", where=place, cure=_CURE) from None
    path = _beside(uri, folder)
    if path is None:
        raise FileFormatError(
            f"lies at {uri!r}", where=place, expected="a file beside the model", cure="put it there"
        )
    try:
        return read_bytes(path)
    except InputError as error:
        raise error.at(place) from None


def _beside(uri: str, folder: Path | None) -> Path | None:
    """Return the file that an address names, if it lies beside or below the model."""
    if folder is None or ":" in uri:
        return None
    path = (folder / unquote(uri)).resolve()
    return path if path.is_relative_to(folder.resolve()) else None


def _embedded_image(image: dict[str, Any], folder: Path | None) -> dict[str, Any]:
    uri = image.get("uri")
    if not isinstance(uri, str) or uri.startswith("data:"):
        return image
    path = _beside(uri, folder)
    if path is None or not path.is_file():
        return image
    media = image.get("mimeType") or _MEDIA.get(path.suffix.lower())
    if media is None:
        return image
    return {**image, "uri": _data_uri(media, read_bytes(path))}


def _data_uri(media: str, data: bytes) -> str:
    return f"data:{media};base64,{base64.b64encode(data).decode()}"
