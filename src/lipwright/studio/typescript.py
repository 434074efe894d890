"""The page's types, made from the server's: ``python -m lipwright.studio.typescript FILE``.

A test holds the file in ``web/`` equal to what this makes, so that the two sides of the
studio cannot drift apart.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import msgspec
from msgspec import inspect

from lipwright.studio import messages
from lipwright.studio.changes import AnyChange

HEAD = """\
// Made by `python -m lipwright.studio.typescript web/src/studio/protocol.ts`
// from src/lipwright/studio/messages.py; change it there.

/** base64 of little-endian float32 */
export type Packed = string;
"""
PLAIN = {
    inspect.StrType: "string",
    inspect.IntType: "number",
    inspect.FloatType: "number",
    inspect.BoolType: "boolean",
    inspect.NoneType: "null",
    inspect.AnyType: "unknown",
}
UNIONS = (("Change", AnyChange), ("Request", messages.Request), ("Answer", messages.Answer))


def typescript() -> str:
    """Return the module of types."""
    structs: dict[str, inspect.StructType] = {}
    asked: set[str] = set()
    unions = []
    for name, union in UNIONS:
        read = inspect.type_info(union)
        assert isinstance(read, inspect.UnionType)
        _collect(read, structs)
        if name == "Request":
            asked = set(structs)
        members = "\n  | ".join(_name(one) for one in read.types)
        unions.append(f"export type {name} =\n  | {members};\n")
    # What the server says is always said whole; what the page says may leave out defaults.
    written = [_interface(one, optional=name in asked) for name, one in structs.items()]
    return "\n".join([HEAD, *written, *unions])


def _name(read: inspect.Type) -> str:
    assert isinstance(read, inspect.StructType)
    return read.cls.__name__


def _collect(read: Any, structs: dict[str, inspect.StructType]) -> None:
    """Gather all structs that a type speaks of, in order of appearance."""
    if isinstance(read, inspect.StructType):
        if _name(read) in structs:
            return
        structs[_name(read)] = read
        for field in read.fields:
            _collect(field.type, structs)
        return
    for part in ("types", "item_types"):
        for one in getattr(read, part, ()):
            _collect(one, structs)
    for part in ("type", "item_type", "key_type", "value_type"):
        if hasattr(read, part):
            _collect(getattr(read, part), structs)


def _interface(read: inspect.StructType, *, optional: bool) -> str:
    lines = []
    if read.tag is not None:
        lines.append(f"  {read.tag_field}: {_quoted(read.tag)};")
    for field in read.fields:
        mark = "?" if optional and not field.required else ""
        lines.append(f"  {field.encode_name}{mark}: {_type(field.type)};")
    about = (read.cls.__doc__ or "").strip().splitlines()[0]
    comment = f"/** {about} */\n" if about else ""
    return "\n".join([f"{comment}export interface {_name(read)} {{", *lines, "}\n"])


def _quoted(value: object) -> str:
    return msgspec.json.encode(value).decode()


def _type(read: inspect.Type) -> str:
    if isinstance(read, inspect.Metadata):
        return "Packed"
    if type(read) in PLAIN:
        return PLAIN[type(read)]
    if isinstance(read, inspect.StructType):
        return _name(read)
    if isinstance(read, inspect.LiteralType):
        return " | ".join(map(_quoted, read.values))
    if isinstance(read, inspect.UnionType):
        if read == inspect.type_info(AnyChange):
            return "Change"
        return " | ".join(map(_type, read.types))
    if isinstance(read, inspect.DictType):
        return f"Record<string, {_type(read.value_type)}>"
    if isinstance(read, inspect.TupleType):
        return f"[{', '.join(map(_type, read.item_types))}]"
    if isinstance(read, inspect.VarTupleType | inspect.ListType):
        item = _type(read.item_type)
        return f"({item})[]" if "|" in item else f"{item}[]"
    raise TypeError(f"no TypeScript for {read}")


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(typescript(), "utf-8")
