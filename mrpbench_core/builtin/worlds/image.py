"""Reads images as greyscale; needs the extra `images`."""

import warnings
from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.builtin.worlds.building.node import Node
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float


@attrs.frozen(eq=False)
class GreyscaleImage:
    """An image; row 0 is the top."""

    lightness: Float
    """f8[rows, columns], 0 black to 1 white; the mean of the colours."""
    transparent: Bool
    """bool[rows, columns]."""


def read_image(file: Path, named: Node) -> GreyscaleImage:
    """Read the image that the value `named` names.

    Raises:
        InputError: Pillow is not installed, or the file is missing or not an image.
    """
    try:
        from PIL import Image
    except ImportError:
        raise named.error("images need Pillow", "pip install 'mrpbench-core[images]'") from None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(file) as image:
                if image.mode.startswith("I"):  # 16 bits
                    values = np.asarray(image, float)
                    return GreyscaleImage(np.clip(values / 65535, 0, 1), np.zeros(values.shape, bool))
                colours = np.asarray(image.convert("RGBA"), float)
    except FileNotFoundError:
        raise named.error(f"there is no image {file}") from None
    except (Image.DecompressionBombWarning, Image.DecompressionBombError):
        raise named.error(f"image {file} is too large") from None
    except (OSError, ValueError, SyntaxError) as error:  # what Pillow raises at broken files
        raise InputError(f"is not an image that Pillow reads: {' '.join(str(error).split())}", file=file) from None
    return GreyscaleImage(colours[..., :3].mean(axis=2) / 255, colours[..., 3] == 0)
