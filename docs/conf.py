"""The documentation site: `make docs` builds it into build/docs/html."""

import os
import posixpath
import re
from importlib import metadata
from pathlib import Path

from sphinx.application import Sphinx

project = "mrpbench"
author = "The mrpbench authors"
project_copyright = author
release = metadata.version("mrpbench-core")

extensions = ["myst_parser", "sphinx.ext.intersphinx", "sphinx_copybutton"]
exclude_patterns = ["README.md"]
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
"""Files outside this folder that pages of `project/` include, and these pages."""


def lead_links_to_pages(_app: Sphinx, path: Path, _page: str, content: list[str]) -> None:
    """Let the links of an included file, which are relative to the file, lead to pages of the site."""

    def led(link: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join("docs", path.parent, link[1]))
        return f"]({PAGES_OF_FILES.get(target, posixpath.join('..', posixpath.relpath(target, 'docs')))}"

    content[0] = re.sub(r"\]\((?!https?:|mailto:|#)([^)#\s]+)", led, content[0])


def setup(app: Sphinx) -> None:
    """Register what this file defines."""
    app.connect("include-read", lead_links_to_pages)
