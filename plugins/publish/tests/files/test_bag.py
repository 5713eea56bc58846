"""Tag files of bags: the reference implementation of BagIt accepts them, and every change is named."""

import pytest
from mrpbench_publish.files.bag import bag_faults, read_info, tag_files

PAYLOAD = {"data/a.txt": b"one\n", "data/deep/b.txt": b"two\n", "data/empty": b""}


@pytest.fixture
def bag(tmp_path):
    for name, content in {**PAYLOAD, **tag_files(PAYLOAD, {"External-Description": "two\nlines"})}.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(content)
    return tmp_path


def test_the_reference_implementation_accepts_a_bag(bag):
    bagit = pytest.importorskip("bagit")
    found = bagit.Bag(str(bag))
    found.validate()
    assert found.info["Payload-Oxum"] == "8.3"
    assert list(bag_faults(bag)) == []
    assert read_info(bag)["External-Description"] == "two lines"


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("data/a.txt", "data/a.txt is not the file whose SHA-256 manifest-sha256.txt has"),
        ("bagit.txt", "bagit.txt does not declare BagIt 1.0 in UTF-8"),
        ("bag-info.txt", "bag-info.txt is not the file whose SHA-256 tagmanifest-sha256.txt has"),
        ("manifest-sha256.txt", "manifest-sha256.txt is not the file whose SHA-256 tagmanifest-sha256.txt has"),
    ],
)
def test_a_change_is_named(bag, name, words):
    text = (bag / name).read_bytes()
    (bag / name).write_bytes(text.translate(bytes.maketrans(b"0123456789abcdef", b"1234567890bcdefa")))
    assert words in list(bag_faults(bag))


def test_names_are_escaped_as_the_standard_says(tmp_path):
    tags = tag_files({"data/50%": b""}, {})
    assert tags["manifest-sha256.txt"].endswith(b"  data/50%25\n")
    for name, content in {"data/50%": b"", **tags}.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(content)
    assert list(bag_faults(tmp_path)) == []


def test_missing_and_further_files_are_named(bag):
    (bag / "data/a.txt").unlink()
    (bag / "data/c.txt").touch()
    (bag / "more.txt").touch()
    faults = list(bag_faults(bag))
    assert "data/a.txt is listed in manifest-sha256.txt and is not there" in faults
    assert "data/c.txt is not listed in manifest-sha256.txt" in faults
    assert "more.txt does not belong to a bundle" in faults
    (bag / "manifest-sha256.txt").unlink()
    assert "manifest-sha256.txt: no such file" in list(bag_faults(bag))
