"""Archives of strangers that could harm whoever opens them: none is unpacked, and each is named."""

import zipfile

import pytest


def hostile(forger, add, compression=zipfile.ZIP_STORED):
    file = forger.pack()
    with zipfile.ZipFile(file, "a", compression) as archive:
        add(archive, forger.top.name)
    return file


def entry(name, mode=0o100644):
    made = zipfile.ZipInfo(name)
    made.external_attr = mode << 16
    return made


@pytest.mark.parametrize(
    ("name", "mode", "words"),
    [
        ("../escaped.txt", 0o100644, "does not stay in its folder"),
        ("/etc/escaped.txt", 0o100644, "does not stay in its folder"),
        ("{top}/data/../../escaped.txt", 0o100644, "does not stay in its folder"),
        ("{top}/data/link", 0o120777, "is a link"),
        ("{top}/data/pipe", 0o010644, "is not a file"),
        ("{top}/data\\inputs", 0o100644, "has a name that not every system can store"),
        ("{top}/data/STUDY.yaml", 0o100644, "is there twice"),
        ("{top}/data/study.yaml/more", 0o100644, "is below a file"),
        ("{top}/data/empty/", 0o100644, "is a folder"),
        ("more/data/study.yaml", 0o100644, "a bundle has one folder"),
    ],
)
def test_an_archive_that_could_write_elsewhere(forger, tmp_path, name, mode, words, found):
    name = name.replace("{top}", forger.top.name)
    file = hostile(forger, lambda archive, top: archive.writestr(entry(name, mode), "text"))
    found(file, "archive", words)
    assert not list(tmp_path.rglob("escaped.txt"))


def test_a_zip_bomb(forger, found):
    def add(archive, top):
        with archive.open(f"{top}/data/inputs/zeros", "w", force_zip64=True) as stream:
            for _ in range(300):
                stream.write(bytes(2**20))

    forger.shard.parent.parent.parent.joinpath("zeros").touch()
    found(hostile(forger, add, zipfile.ZIP_DEFLATED), "archive", "a bundle takes at most 200 times its size")


def test_no_zip_file_at_all(tmp_path, found):
    file = tmp_path / "text.zip"
    file.write_text("text")
    found(file, "archive", "is not a bundle")
