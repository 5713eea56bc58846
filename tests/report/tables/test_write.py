"""Text of records is text in Markdown and LaTeX."""

import re

from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_core.report.tables.table import Shown, Table
from mrpbench_core.report.tables.write import latex, markdown

WORDS = "<script>x</script> [a](javascript:b) | `c` *d* _e_ ![i](http://f) plan_timeout \x1b[1m\n# g"


def table(cell):
    estimate = Shown(IntervalEstimate(0.5, 0.25, 0.75, 8), percent=True)
    return Table(key="k", title=cell, headings=(cell, "n"), rows=((cell, estimate),), keys=1, note=cell)


def test_markdown_has_neither_markup_nor_html_of_a_record():
    title, _, heads, _, row, _, note, *_ = markdown([table(WORDS)]).splitlines()
    for line in (title, heads, row, note):
        assert not re.search(r"(?<!\\)[<>\[\]`*]", line.replace("[25, 75]", ""))
        assert r"\_e\_" in line
        assert "plan_timeout" in line
        assert len(re.findall(r"(?<!\\)\|", line)) == (3 if line in (heads, row) else 0)
        assert "\x1b" not in line
    assert "50 % [25, 75] n=8 |" in row


def test_latex_has_no_command_of_a_record():
    written = latex([table(r"\input{/etc/passwd} $x$ %y #z")])
    assert r"\textbackslash{}input\{/etc/passwd\} \$x\$ \%y \#z &" in written


def test_a_latex_row_does_not_begin_with_an_option_of_the_row_before():
    written = latex([table("[9cm]"), table("*")])
    assert "\n{}[9cm] &" in written
    assert "\n{}* &" in written
