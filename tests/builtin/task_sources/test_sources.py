"""Which tasks come, when, and what a source says of a mistake."""

import numpy as np
import pytest

from mrpbench_core.builtin.task_sources.file import FromFile
from mrpbench_core.builtin.task_sources.pickup_delivery import PickupDelivery
from mrpbench_core.builtin.task_sources.poisson import Poisson
from mrpbench_core.builtin.task_sources.trace import Trace, read_arrivals
from mrpbench_core.files.errors import InputError
from mrpbench_core.testing.fixtures.office import office, office_roadmap
from mrpbench_core.testing.fixtures.room import fleet


def tasks(source, seed=0, until=3600.0):
    return list(source.start(office(), office_roadmap(), fleet(2), seed).released(until, 0))


def test_a_file_gives_its_tasks_by_release(tmp_path):
    path = tmp_path / "tasks.yaml"
    path.write_text(
        "tasks:\n- {goals: [sofa], release: 5, name: late}\n- {goals: [lounge], name: first}\n- {goals: [sofa]}\n"
    )
    found = tasks(FromFile(file=path))
    assert [task.name for task in found] == ["first", "", "late"]
    assert [task.index for task in found] == [0, 1, 2]


def test_a_place_off_the_roadmap_is_located(tmp_path):
    path = tmp_path / "tasks.csv"
    path.write_text("errands\nlounge;-500 -500\n")
    with pytest.raises(InputError, match=r"tasks.csv:2: errand 2 at \(-500, -500\) is off the roadmap"):
        tasks(FromFile(file=path))


def test_the_times_of_a_trace_are_scaled_and_its_errands_depend_on_the_seed(tmp_path):
    path = tmp_path / "arrivals.txt"
    path.write_text("".join(f"{time}\n" for time in range(20)))
    slow, other = tasks(Trace(file=path, scale=3, errands=2)), tasks(Trace(file=path, errands=2), seed=1)
    assert [task.release for task in slow] == list(range(0, 60, 3))
    assert [task.release for task in other] == list(range(20))
    assert any(not np.array_equal(one.goals, two.goals, True) for one, two in zip(slow, other, strict=True))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1\n\nsoon\n", r":3: 'soon' is not a time in seconds from 0"),
        ("-1\n", r":1: '-1' is not a time"),
        ("5\n4 # early\n", r":2: 4 s comes after 5 s \(sort the times\)"),
        ("# none\n", r": has no times"),
    ],
)
def test_a_mistake_in_a_trace_is_located(tmp_path, text, message):
    path = tmp_path / "arrivals.txt"
    path.write_text(text)
    with pytest.raises(InputError, match=f"arrivals.txt{message}"):
        read_arrivals(path)


def test_pickups_and_deliveries_are_where_they_are_named():
    source = PickupDelivery(rate=10, pickups=("lounge", "print*"), dropoffs=("sofa", "lounge"))
    found = tasks(source)
    ends = {tuple(task.name.split(" to ")) for task in found}
    pickups, dropoffs = ({names[i] for names in ends} for i in (0, 1))
    assert dropoffs == {"sofa", "lounge"}
    assert pickups == {"lounge", "printer"}
    assert all(first != second for first, second in ends)
    assert [task.release for task in found] == [task.release for task in tasks(Poisson(rate=10))]


def test_places_of_an_errand_differ_and_none_is_of_the_errand_before():
    names = ("lounge", "printer", "sofa")
    source = PickupDelivery(
        rate=10, pickups=names, dropoffs=(*names, "library"), places_per_pickup=2, places_per_dropoff=2
    )
    for task in tasks(source):
        first, second = (set(goal) for goal in task.by_errand([*map(tuple, task.goals[:, :2].tolist())]))
        assert len(first) == len(second) == 2
        assert not first & second
    assert task.name.count(" or ") == 2


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"pickups": ("sofa",), "dropoffs": ("lounge",), "places_per_pickup": 2},
            r"tasks.places_per_pickup: 2 of 1 places$",
        ),
        (
            {"pickups": ("sofa", "lounge"), "dropoffs": ("sofa", "lounge"), "places_per_dropoff": 2},
            r"tasks.places_per_dropoff: 2 of 1 places beside 1 of the pickup$",
        ),
        ({}, r"tasks: no vertex of world office has 'pickup_dispenser' \(name places with 'pickups'; names are "),
        ({"pickups": ("lunge",), "dropoffs": ("sofa",)}, r"tasks.pickups: .*'lunge' \(did you mean 'lounge'\?\)"),
        ({"pickups": ("x*",), "dropoffs": ("sofa",)}, r"tasks.pickups: world office has no vertex 'x\*' \(names are "),
        ({"pickups": ("sofa",), "dropoffs": ("sofa",)}, r"tasks.dropoffs: the only place, 'sofa', is also a place of"),
    ],
)
def test_mistakes_of_pickup_and_delivery_are_one_line(options, message):
    with pytest.raises(InputError, match=message):
        tasks(PickupDelivery(rate=1, **options))
