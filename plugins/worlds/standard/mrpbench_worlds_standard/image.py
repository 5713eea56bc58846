"""Reads images as greyscale; needs the extra `images`."""

import re
import warnings
from pathlib import Path

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.files.extras import pip
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_worlds_standard.building.node import Node

PIXELS = 2**26
"""Most pixels of an image: 400 m x 400 m of squares of 5 cm. Reading takes about 12 bytes for each."""
FORMATS = ("PPM", "PNG", "BMP", "JPEG", "GIF", "TIFF", "WEBP", "TGA")
"""Formats of Pillow that are read; others would run further programs."""


@attrs.frozen(eq=False)
class GreyscaleImage:
    """An image; row 0 is the top."""

    tone: NDArray[np.uint16]
    """u2[rows, columns]: index into `lightness`."""
    lightness: Float
    """f8[tones], 0 black to 1 white; the mean of the colours."""
    opaque: Bool
    """bool[rows, columns]: alpha is 255, or the image has no alpha."""


def read_image(file: Path, named: Node) -> GreyscaleImage:
    """Read the image that the value `named` names.

    Raises:
        InputError: Pillow is not installed, or the file is missing, not an image or too large.
    """
    try:
        from PIL import Image
    except ImportError:
        raise named.error("images need Pillow", pip("images")) from None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(file, formats=FORMATS) as image:  # reads the header only
                if image.width * image.height > PIXELS:
                    raise _too_large(file, named)
                if image.mode.startswith("I"):  # 16 bits
                    tone = np.clip(np.asarray(image), 0, 65535).astype(np.uint16)
                    return GreyscaleImage(tone, np.arange(65536) / 65535, np.ones(tone.shape, bool))
                colours = np.asarray(image.convert("RGBA"))
    except FileNotFoundError:
        raise _missing(file, named) from None
    except (Image.DecompressionBombWarning, Image.DecompressionBombError):
        raise _too_large(file, named) from None
    except InputError:
        raise
    except Exception as error:  # noqa: BLE001 - Pillow has no class of errors for broken files
        if _is_pointer(file):
            raise InputError("is a pointer of Git LFS, not the image", file=file, hint="git lfs pull") from None
        raise InputError(f"is not an image that Pillow reads: {one_line(error)}", file=file) from None
    tone = colours[..., :3].sum(axis=2, dtype=np.uint16)
    return GreyscaleImage(tone, np.arange(3 * 255 + 1) / 3 / 255, colours[..., 3] == 255)


def _too_large(file: Path, named: Node) -> InputError:
    most = f"crop it, or make its resolution coarser: {PIXELS // 10**6} million pixels at most"
    return named.error(f"image {file} is too large", most)


def _missing(file: Path, named: Node) -> InputError:
    """Return the error that an image is missing; maps that were moved have it beside the file that names it."""
    hint = "the option image names another"
    if named.document.file is not None:
        names = {entry.name.lower(): entry.name for entry in named.document.file.absolute().parent.iterdir()}
        beside = names.get(re.split(r"[/\\]", str(file))[-1].lower())
        hint = hint if beside is None else f"beside this file is {beside}"
    return named.error(f"there is no image {file}", hint)


def _is_pointer(file: Path) -> bool:
    with file.open("rb") as content:
        return content.read(40).startswith(b"version https://git-lfs")
