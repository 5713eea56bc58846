"""The documentation site: `make docs` builds it into build/docs/html."""

import os
import posixpath
import re
import sys
from importlib import metadata
from pathlib import Path

from sphinx.application import Sphinx

project = "mrpbench"
author = "The mrpbench authors"
project_copyright = author
release = metadata.version("mrpbench-core").partition("+")[0]

sys.path.insert(0, str(Path(__file__).parent / "extensions"))
extensions = [
    "generated",
    "python_modules",
    "myst_parser",
    "sphinx.ext.intersphinx",
    "sphinx_copybutton",
]
nitpicky = True

myst_enable_extensions = ["deflist"]
myst_heading_anchors = 3

# The inventories of other projects are read over the network, which a build must not depend on.
intersphinx_mapping = (
    {"python": ("https://docs.python.org/3", None), "numpy": ("https://numpy.org/doc/stable", None)}
    if os.environ.get("DOCS_INTERSPHINX")
    else {}
)

html_theme = "furo"
html_title = f"mrpbench {release}"
html_static_path = ["static"]
html_css_files = ["tables.css"]
html_copy_source = False
copybutton_exclude = ".linenos, .gp, .go"

PAGES_OF_FILES = {
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
    "SECURITY.md": "security.md",
    "README.md": "../index.md",
    "native/README.md": "native.md",
    "plugins/README.md": "standard-plugins.md",
}
"""Files outside this folder that pages include, and these pages, seen from `project/`."""


def lead_links_to_pages(folder: str, page: str, content: list[str]) -> None:
    """Let links to files outside this folder lead to their pages.

    Args:
        folder: to which the links are relative, in the checkout.
        page: the folder of the page, in the checkout.
        content: the text, which is replaced.
    """

    def led(link: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(folder, link[1]))
        if target in PAGES_OF_FILES:
            target = posixpath.join("docs/project", PAGES_OF_FILES[target])
        return f"]({posixpath.relpath(target, page)}"

    content[0] = re.sub(r"\]\((?!https?:|mailto:|#)([^)#\s]+)", led, content[0])


def read_page(_app: Sphinx, page: str, content: list[str]) -> None:
    """Lead the links of a page."""
    folder = posixpath.dirname(f"docs/{page}")
    lead_links_to_pages(folder, folder, content)


def read_included(app: Sphinx, path: Path, _stem: str, content: list[str]) -> None:
    """Lead the links of a file that a page includes; MyST tells only the last part of the page's name."""
    folder = posixpath.dirname(posixpath.normpath(posixpath.join("docs", path)))
    lead_links_to_pages(folder, posixpath.dirname(f"docs/{app.env.docname}"), content)


def setup(app: Sphinx) -> None:
    """Register what this file defines."""
    app.connect("source-read", read_page)
    app.connect("include-read", read_included)
