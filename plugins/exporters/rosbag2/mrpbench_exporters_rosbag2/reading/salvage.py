"""Makes an mcap file that was cut off readable: everything up to its last whole record, with a proper end.

The format: https://mcap.dev/spec. A file is magic, records (opcode u1, length u8, content), magic. The end need not
have an index; readers then go through the whole file.
"""

import shutil
import struct
from pathlib import Path

MAGIC = b"\x89MCAP0\r\n"
FOOTER, DATA_END = 0x02, 0x0F
END = struct.pack("<BQI", DATA_END, 4, 0) + struct.pack("<BQQQI", FOOTER, 20, 0, 0, 0) + MAGIC


def is_cut_off(file: Path) -> bool:
    """Tell whether this is an mcap file without an end."""
    with file.open("rb") as stream:
        if stream.read(len(MAGIC)) != MAGIC:
            return False
        stream.seek(-len(MAGIC), 2)
        return stream.read() != MAGIC


def salvage(file: Path, folder: Path) -> Path:
    """A readable copy in `folder`."""
    copy = folder / file.name
    shutil.copyfile(file, copy)
    size = copy.stat().st_size
    with copy.open("r+b") as stream:
        end = stream.seek(len(MAGIC))
        while len(head := stream.read(9)) == 9:
            opcode, length = struct.unpack("<BQ", head)
            if opcode in (DATA_END, FOOTER) or end + 9 + length > size:
                break
            end = stream.seek(end + 9 + length)
        stream.seek(end)
        stream.truncate()
        stream.write(END)
    return copy
