"""What is read is written again; what is broken is refused by name and place."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path

import pytest

from lipwright.errors import FileFormatError, InputError
from lipwright.gltf import container as container_module
from lipwright.gltf import parse_glb, read_gltf
from tests.models import model

WHOLE = model().to_glb()


def glb(document: object, binary: bytes | None = b"\0\0\0\0", version: int = 2) -> bytes:
    text = document if isinstance(document, bytes) else json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text
    if binary is not None:
        body += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", version, 12 + len(body)) + body


ASSET = {"asset": {"version": "2.0"}}
LYING_CHUNK = WHOLE[:12] + struct.pack("<I", len(WHOLE)) + WHOLE[16:]
BUFFER = {**ASSET, "buffers": [{"byteLength": 4}]}

BROKEN = [
    (b"", "is empty; expected a GLB, VRM or glTF file"),
    (b"RIFF....WAVE", r"starts with b'RIFF'; expected a GLB, VRM or glTF file"),
    (b"glTF\2\0\0\0", "ends after 8 bytes"),
    (WHOLE[:-100], rf"is cut: {len(WHOLE) - 100} bytes; expected {len(WHOLE)} bytes. Export"),
    (LYING_CHUNK, r"byte 12: the chunk b'JSON' says \d+ bytes, but \d+ follow"),
    (glb(ASSET, version=1), "glTF version 1; expected version 2. Export it as glTF 2"),
    (glb({"asset": {"version": "3.0"}}), "glTF version '3.0'; expected version 2.0"),
    (glb({"asset": {"version": "2.1", "minVersion": "2.1"}}), "needs glTF 2.1; expected 2.0"),
    (glb({"scene": 0}), "has no asset.version"),
    (glb([]), "has no asset.version"),
    (glb(b'{"asset": '), r"line 1 column 10: broken JSON \(Expecting value\)"),
    (glb(b'{"asset": NaN}'), "the number NaN; expected finite numbers"),
    (glb(b'{"asset": "\xff"}'), "is not UTF-8 text"),
    (glb(BUFFER, None), "buffer 0: has no binary chunk"),
    (glb({**ASSET, "buffers": [{"byteLength": 9}]}), "buffer 0: 4 bytes; expected 9 bytes"),
    (glb({**ASSET, "buffers": [{}]}), "buffer 0: byteLength None; expected 1 or more"),
    (glb({**ASSET, "meshes": 3}), "'meshes' is not a list of objects"),
    (b'{"asset": {"version": "1.0"}}', "glTF version '1.0'"),
]


@pytest.mark.parametrize(("content", "message"), BROKEN, ids=[row[1][:24] for row in BROKEN])
def test_broken_files_are_refused_by_name_and_place(
    tmp_path: Path, content: bytes, message: str
) -> None:
    path = tmp_path / "broken.glb"
    path.write_bytes(content)
    with pytest.raises(FileFormatError, match=message) as caught:
        read_gltf(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_gltf(tmp_path / "none.glb")


def test_too_large_a_file_is_refused_before_it_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "large.glb"
    path.write_bytes(WHOLE)
    monkeypatch.setattr(container_module, "LARGEST", 100)
    monkeypatch.setattr(container_module, "read_bytes", lambda path: pytest.fail("was read"))
    with pytest.raises(InputError, match="expected a model of at most"):
        read_gltf(path)


def test_what_is_read_is_written_again() -> None:
    assert parse_glb(WHOLE).to_glb() == WHOLE


def test_chunks_of_others_stay() -> None:
    chunk = struct.pack("<I4s", 8, b"XTRA") + b"whatever"
    longer = struct.pack("<4sII", b"glTF", 2, len(WHOLE) + len(chunk)) + WHOLE[12:] + chunk
    assert parse_glb(longer).to_glb() == longer


def test_bytes_after_the_stated_length_are_left_out() -> None:
    assert parse_glb(WHOLE + b"junk").to_glb() == WHOLE


def gltf(tmp_path: Path, **changes: object) -> Path:
    path = tmp_path / "model.gltf"
    path.write_text(json.dumps({**ASSET, **changes}))
    return path


def test_a_gltf_takes_in_its_buffer_and_texture(tmp_path: Path) -> None:
    (tmp_path / "my data.bin").write_bytes(b"12345678")
    (tmp_path / "skin.PNG").write_bytes(b"png")
    path = gltf(
        tmp_path,
        buffers=[{"byteLength": 8, "uri": "my%20data.bin"}],
        images=[{"uri": "skin.PNG"}, {"uri": "absent.png"}],
    )
    read = parse_glb(read_gltf(path).to_glb())
    assert read.binary == b"12345678"
    assert "uri" not in read.json["buffers"][0]
    assert read.json["images"][0]["uri"] == "data:image/png;base64,cG5n"
    assert read.json["images"][1]["uri"] == "absent.png"


def test_further_buffers_become_part_of_the_document(tmp_path: Path) -> None:
    (tmp_path / "b.bin").write_bytes(b"abcd")
    first = "data:application/octet-stream;base64," + base64.b64encode(b"1234").decode()
    path = gltf(
        tmp_path, buffers=[{"byteLength": 4, "uri": first}, {"byteLength": 4, "uri": "b.bin"}]
    )
    read = read_gltf(path)
    assert read.binary == b"1234"
    assert read.json["buffers"][1]["uri"].endswith("base64,YWJjZA==")


@pytest.mark.parametrize(
    ("uri", "message"),
    [
        ("absent.bin", "buffer 0: .*absent.bin: no such file"),
        ("../outside.bin", "lies at '../outside.bin'; expected a file beside the model"),
        ("https://example.org/a.bin", "expected a file beside the model"),
        ("data:;base64,?", "buffer 0: broken base64"),
    ],
)
def test_a_buffer_that_cannot_be_had_is_an_error(tmp_path: Path, uri: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_gltf(gltf(tmp_path, buffers=[{"byteLength": 4, "uri": uri}]))
