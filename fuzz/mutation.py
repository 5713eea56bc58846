"""Changes inputs: bytes anywhere, words of text, and arrays."""

import random
import re
from collections.abc import Callable, Sequence

Mutate = Callable[[bytes, random.Random], bytes]

WORDS = (
    *(
        b"",
        b"0",
        b"-1",
        b"1e400",
        b"-1e308",
        b".nan",
        b".inf",
        b"NaN",
        b"Infinity",
        b"9223372036854775807",
        b"1" + 400 * b"0",
    ),
    *(
        b"true",
        b"null",
        b"~",
        b"[]",
        b"{}",
        b"[[1]]",
        b"'x'",
        b'""',
        b"\x00",
        b"\xff",
        "é😀".encode(),
        b"\\ud800",
        b"../x",
    ),
    *(b"&a", b"*a", b"<<: *a", b"- ", b"? ", b"!!python/object:os.x", b"inf", b"1e-320", b"\t", b"\n", b":", b"#"),
)
"""Values that readers of text often get wrong."""
_TOKEN = re.compile(rb"[\w.+-]+|[^\w\s]")


def mutate_bytes(data: bytes, rng: random.Random) -> bytes:
    """Flip bits, set, insert, delete or copy a few bytes."""
    out = bytearray(data or b"\0")
    for _ in range(rng.choice((1, 1, 2, 4))):
        place = rng.randrange(len(out)) if out else 0
        match rng.randrange(6):
            case 0 if out:
                out[place] ^= 1 << rng.randrange(8)
            case 1 if out:
                out[place] = rng.choice((0, 1, 0x7F, 0x80, 0xFF, rng.randrange(256)))
            case 2:
                out[place:place] = rng.randbytes(rng.choice((1, 1, 4, 8)))
            case 3:
                del out[place : place + rng.choice((1, 2, 8, 64))]
            case 4:
                source = rng.randrange(len(out)) if out else 0
                out[place:place] = out[source : source + rng.choice((4, 16, 64))]
            case _:
                number = rng.choice((0, 1, -1, 2**31 - 1, -(2**31), 2**62, 2**63 - 1, -(2**63)))
                out[place : place + 8] = number.to_bytes(8, "little", signed=True)
    return bytes(out)


def mutate_text(data: bytes, rng: random.Random) -> bytes:
    """Replace tokens by others of the text or by `WORDS`; drop, repeat or swap lines; sometimes change bytes."""
    if rng.random() < 0.2:
        return mutate_bytes(data, rng)
    for _ in range(rng.choice((1, 1, 2, 3))):
        if rng.random() < 0.2:
            lines = data.splitlines(keepends=True) or [b""]
            place, other = rng.randrange(len(lines)), rng.randrange(len(lines))
            lines[place : place + rng.randrange(2)] = lines[other : other + rng.choice((0, 1, 3))]
            data = b"".join(lines)
            continue
        place, other = _token(data, rng), _token(data, rng)
        if place is None or other is None:
            return data + rng.choice(WORDS)
        word = rng.choice(WORDS) if rng.random() < 0.7 else other[0]
        data = data[: place.start()] + word + data[place.end() :]
    return data


def _token(data: bytes, rng: random.Random) -> re.Match[bytes] | None:
    """A token somewhere in a text, without a look at all of it; at times only the end of one."""
    return _TOKEN.search(data, rng.randrange(len(data) + 1)) or _TOKEN.search(data)


def mutate_npy(data: bytes, rng: random.Random) -> bytes:
    """Change the header of a `.npy` file or, mostly, one of its values; anything else as text."""
    if not data.startswith(b"\x93NUMPY") or len(data) < 16:
        return mutate_text(data, rng)
    end = 10 + int.from_bytes(data[8:10], "little")
    header, values = data[10:end], data[end:]
    if rng.random() < 0.3:
        header = mutate_text(header.strip(), rng)
        header = header.ljust(end - 11)[: 2**16 - 2] + b"\n"
        return data[:8] + len(header).to_bytes(2, "little") + header + values
    if len(values) < 8:
        return data
    place = 8 * rng.randrange(len(values) // 8)
    return data[:end] + values[:place] + rng.choice(VALUES) + values[place + 8 :]


VALUES: Sequence[bytes] = (
    *(number.to_bytes(8, "little", signed=True) for number in (0, 1, -1, 5, 2**31, -(2**31), 2**63 - 1, -(2**63))),
    *(bytes.fromhex(number) for number in ("000000000000f87f", "000000000000f07f", "000000000000f0ff")),
    *(
        bytes.fromhex(number)
        for number in ("ffffffffffffef7f", "0000c07f0000c07f", "00000000000059c0", "ffffffffffffffff")
    ),
)
"""Eight bytes: integers of any width, and as floats NaN, infinities, the largest number and -100."""
