"""Tables as Markdown and LaTeX."""

import re
from collections.abc import Sequence

from mrpbench_core.files.printing import printable
from mrpbench_core.report.tables.table import Cell, Table, text

_LATEX = {
    "\\": r"\textbackslash{}",
    **{letter: f"\\{letter}" for letter in "&%$#_{}"},
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": "$<$",
    ">": "$>$",
    "–": "--",
    "·": r"$\cdot$",
}
_MARKDOWN = re.compile(r"[\\`*{}\[\]<>|~&$]|(?<!\w)_|_(?!\w)")


def markdown(tables: Sequence[Table]) -> str:
    """Pipe tables under headings."""
    parts = []
    for table in tables:
        rows = [[_markdown(cell) for cell in row] for row in table.rows]
        lines = [f"## {_markdown(table.title)}", ""]
        lines += [f"| {' | '.join(map(_markdown, table.headings))} |"]
        lines += ["|" + "|".join("---" if index < table.keys else "---:" for index in range(len(table.headings))) + "|"]
        lines += [f"| {' | '.join(row)} |" for row in rows]
        parts.append("\n".join([*lines, "", _markdown(table.note), ""]))
    return "\n".join(parts)


def latex(tables: Sequence[Table]) -> str:
    """`tabular` environments for the package booktabs."""
    parts = []
    for table in tables:
        layout = "l" * table.keys + "r" * (len(table.headings) - table.keys)
        rows = [" & ".join(_tex(text(cell)) for cell in row) + r" \\" for row in table.rows]
        parts.append(
            "\n".join(
                [
                    rf"\begin{{table}}\centering\caption{{{_tex(table.title)}. {_tex(table.note)}}}",
                    rf"\begin{{tabular}}{{{layout}}}\toprule",
                    " & ".join(map(_tex, table.headings)) + r" \\ \midrule",
                    *(f"{{}}{row}" if row.startswith(("[", "*")) else row for row in rows),  # no options of \\
                    r"\bottomrule\end{tabular}\end{table}",
                    "",
                ]
            )
        )
    return "\n".join([r"% needs \usepackage{booktabs}", *parts])


def _markdown(cell: Cell) -> str:
    """The text of a cell; text of records is escaped, so that it is neither markup nor HTML."""
    return _MARKDOWN.sub(r"\\\g<0>", printable(cell)) if isinstance(cell, str) else text(cell)


def _tex(words: str) -> str:
    return "".join(_LATEX.get(letter, letter) for letter in printable(words))
