"""XML files, with one line for each error."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path
from xml.parsers import expat

from mrpbench_core.files.errors import InputError


class _Element(ET.Element):
    line: int
    """The line of the file that it begins in, from 1."""


def parse_xml(text: str, file: Path, what: str) -> ET.Element:
    """Return the root element of the text of a file.

    Names stay as they are written: a prefix need not be declared as a namespace, because ROS reads such files.

    Args:
        text: the content of the file.
        file: its path, for errors.
        what: what the file should be, with its article, for errors: "a URDF".

    Raises:
        InputError: it is not XML, or declares a document type, whose entities could expand without end.
    """
    if re.search(r"<!(DOCTYPE|ENTITY)", text):
        raise InputError(f"has a DOCTYPE, which {what} must not have", file=file)
    parser = expat.ParserCreate()
    parser.buffer_text = True
    builder = ET.TreeBuilder(element_factory=_Element)

    def start(name: str, attributes: dict[str, str]) -> None:
        element = builder.start(name, attributes)
        assert isinstance(element, _Element)
        element.line = parser.CurrentLineNumber

    parser.StartElementHandler = start
    parser.EndElementHandler = builder.end
    parser.CharacterDataHandler = builder.data
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        wrong = expat.ErrorString(error.code)
        raise InputError(f"is not XML: {wrong}", file=file, line=error.lineno, column=error.offset + 1) from None
    return builder.close()


def line_of(element: ET.Element) -> int | None:
    """Return the line that an element begins in, from 1; None if it was not read from a file."""
    return element.line if isinstance(element, _Element) else None
