"""`analyze` on the command line."""


def test_the_option_of_the_last_release_gives_one_line_of_advice(mrpbench):
    code, _, errors = mrpbench("analyze", "none", "--importer", "rosbag2")
    note, error = errors.splitlines()
    assert note == "note: --importer is now --format; the next release does not read the old name"
    assert (code, error) == (2, "none: there is no such bag")


def test_a_format_that_is_only_written_is_one_line(mrpbench, tmp_path):
    (tmp_path / "mine.py").write_text(
        "import attrs\nfrom mrpbench_core.api import WritableFormat\n"
        "@attrs.frozen(kw_only=True)\nclass Mine(WritableFormat):\n    def open(self, context, destination): ...\n"
    )
    code, _, errors = mrpbench("analyze", "none", "--format", "./mine.py:Mine")
    assert (code, errors) == (2, "--format: format './mine.py:Mine': Mine cannot be read, only written\n")
