import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_league.files.motion import parse_segments, parse_steps, write_segments, write_steps

LETTERS = st.text("FRCW", max_size=40).map(lambda text: np.frombuffer(text.encode(), np.uint8))


@given(LETTERS)
def test_steps_are_read_as_they_were_written(letters):
    assert np.array_equal(parse_steps(write_steps(letters)).letters, letters)


@given(LETTERS, st.integers(1, 12))
def test_segments_are_read_as_they_were_written(letters, length):
    states = np.zeros((-(-len(letters) // length), 4), np.int32)
    read = parse_segments(write_segments(letters, states, length), 40)
    assert np.array_equal(read.letters, letters)
    assert [begin for begin, _ in read.begins] == list(range(0, len(letters), length))


def test_segments_have_the_form_that_planviz_reads():
    letters = np.frombuffer(b"FFFWWR", np.uint8)
    states = np.array([[3, 4, 1, 0], [4, 4, 1, 0]], np.int32)
    assert write_segments(letters, states, 4) == "[(0,3,4,1,0):(F 3,W 1)][(4,4,4,1,0):(W 1,R 1)]"


@pytest.mark.parametrize("text", ["F,", "FF", "F,X", ",F", "F;R"])
def test_other_letters_are_no_steps(text):
    with pytest.raises(ValueError, match="should be letters"):
        parse_steps(text)


@pytest.mark.parametrize(
    "text", ["(0,0,0,0,0):(F 1)", "[(0,0,0,0,0):(X 1)]", "[(0,0,0,9,0):(F 1)]", "[(0,0,0,0,0):(F 9)]x"]
)
def test_other_texts_are_no_segments(text):
    with pytest.raises(ValueError, match="should be"):
        parse_segments(text, 100)


def test_a_run_longer_than_the_makespan_is_refused_before_it_fills_the_memory():
    with pytest.raises(ValueError, match="more than 10 ticks"):
        parse_segments("[(0,0,0,0,0):(F 999999999)]", 10)
