"""XML files, with one line for each error."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

from mrpbench_core.files.errors import InputError


def parse_xml(text: str, file: Path, what: str) -> ET.Element:
    """Return the root element of the text of a file.

    Args:
        text: the content of the file.
        file: its path, for errors.
        what: what the file should be, with its article, for errors: "a URDF".

    Raises:
        InputError: it is not XML, or declares a document type, whose entities could expand without end.
    """
    if re.search(r"<!(DOCTYPE|ENTITY)", text):
        raise InputError(f"has a DOCTYPE, which {what} must not have", file=file)
    try:
        return ET.fromstring(text)  # noqa: S314 - without a DOCTYPE nothing in it expands
    except ET.ParseError as error:
        line, column = error.position
        raise InputError(f"is not XML: {error}", file=file, line=line, column=column + 1) from None
