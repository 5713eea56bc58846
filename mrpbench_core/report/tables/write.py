"""Tables as Markdown and LaTeX."""

from collections.abc import Sequence

from mrpbench_core.report.tables.table import Table, text

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


def markdown(tables: Sequence[Table]) -> str:
    """Pipe tables under headings."""
    parts = []
    for table in tables:
        rows = [[_pipe(text(cell)) for cell in row] for row in table.rows]
        lines = [f"## {table.title}", ""]
        lines += [f"| {' | '.join(map(_pipe, table.headings))} |"]
        lines += ["|" + "|".join("---" if index < table.keys else "---:" for index in range(len(table.headings))) + "|"]
        lines += [f"| {' | '.join(row)} |" for row in rows]
        parts.append("\n".join([*lines, "", table.note, ""]))
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
                    *rows,
                    r"\bottomrule\end{tabular}\end{table}",
                    "",
                ]
            )
        )
    return "\n".join([r"% needs \usepackage{booktabs}", *parts])


def _pipe(words: str) -> str:
    return words.replace("|", "\\|").replace("\n", " ")


def _tex(words: str) -> str:
    return "".join(_LATEX.get(letter, letter) for letter in words)
