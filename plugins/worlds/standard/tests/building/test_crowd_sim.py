"""People of building files: what they do, where, and what of it is refused or left out."""

from pathlib import Path

import pytest
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.routines import PeopleGroup

BUILDING = """\
coordinate_system: cartesian_meters
levels:
  L1:
    vertices:
      - [0, 0, 0, ""]
      - [9, 0, 0, ""]
      - [2, 1, 0, "", {human_goal_set_name: [1, desk]}]
      - [4, 1, 0, "", {human_goal_set_name: [1, desk]}]
    lanes:
      - [0, 1, {bidirectional: [4, true]}]
  L2:
    vertices:
      - [6, 1, 0, "", {human_goal_set_name: [1, tea]}]
crowd_sim:
  enable: 1
  goal_sets:
    - {set_id: 0, set_area: [desk], capacity: 3}
    - {set_id: 4, set_area: [desk, tea], capacity: 3}
  states:
    - {name: robots, goal_set: -1, final: 1}
    - {name: work, goal_set: 0, final: 0}
    - {name: roam, goal_set: 4, final: 0}
    - {name: rest, goal_set: -1, final: 0}
  transitions:
    - from: work
      to: ""
      Condition:
        type: and
        condition1: {type: goal_reached, distance: 0.7}
        condition2: {type: timer, dist: c, value: 30, per_agent: true}
      Target: [{name: rest, weight: 2}, {name: roam, weight: 0.5}]
    - {from: rest, to: work, Condition: {type: timer, dist: u, min: 5, max: 9}}
    - {from: roam, to: rest, Condition: {type: goal_reached, distance: 0.5}}
  agent_groups:
    - {group_id: 0, agents_number: 1, profile_selector: external_agent, state_selector: robots, x: 0, y: 0}
    - {group_id: 1, agents_number: 3, profile_selector: human, state_selector: rest, x: 2.5, y: 1.5}
"""


def load(tmp_path, text=BUILDING, **options):
    file = tmp_path / "house.building.yaml"
    file.write_text(text)
    return Rmf(file=file, **options).load()


def test_states_become_activities_with_places_ends_and_what_follows(tmp_path):
    world = load(tmp_path)
    assert world.notes == ()
    _, work, roam, rest = world.activities
    assert (work.places.tolist(), work.level.tolist()) == ([[2, 1], [4, 1]], [0, 0])
    assert (work.reach, work.time, work.either, work.following) == (0.7, (30, 30), False, ((3, 2), (2, 0.5)))
    assert (roam.places.tolist(), roam.level.tolist()) == ([[2, 1], [4, 1], [6, 1]], [0, 0, 1])
    assert (roam.reach, roam.time, roam.following) == (0.5, None, ((3, 1),))
    assert (len(rest.places), rest.reach, rest.time, rest.following) == (0, None, (5, 9), ((1, 1),))


def test_robots_are_no_people_and_a_group_is_on_the_level_to_which_it_goes(tmp_path):
    assert load(tmp_path).people == (PeopleGroup(people=3, x=2.5, y=1.5, level=0, activity=3),)


def test_a_section_that_is_not_enabled_says_nothing(tmp_path):
    world = load(tmp_path, BUILDING.replace("enable: 1", "enable: 0"))
    assert (world.activities, world.people) == ((), ())


def test_states_without_places_on_the_loaded_level_are_left_out_with_a_note(tmp_path):
    world = load(tmp_path, BUILDING.replace("[desk, tea]", "[tea]"), level="L1")
    assert [activity.name for activity in world.activities] == ["robots", "work", "rest"]
    assert world.activities[1].following == ((2, 2),)
    assert any("'roam' has no places" in note for note in world.notes)


@pytest.mark.parametrize(
    ("old", "new", "note"),
    [
        ("type: goal_reached, distance: 0.5", "type: AABB", "transition from 'roam' is not supported"),
        ("dist: u, min: 5, max: 9", "dist: n, mean: 5", "transition from 'rest' is not supported"),
        ("- {from: roam, to: rest", "- {from: rest, to: rest", "several transitions from 'rest'"),
    ],
)
def test_what_is_not_supported_is_noted_and_never_ends(tmp_path, old, new, note):
    world = load(tmp_path, BUILDING.replace(old, new))
    assert any(note in sentence for sentence in world.notes)
    assert any(not activity.following for activity in world.activities[1:])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("state_selector: rest", "state_selector: resting", "no state 'resting' in `states`"),
        ("{from: roam", "{from: roaming", "no state 'roaming'"),
        ("{name: roam, weight: 0.5}", "{name: room, weight: 0.5}", "no state 'room'"),
        ("goal_set: 4", "goal_set: 5", "names goal set 5"),
        ("set_id: 4, ", "", "entry of goal_sets has no set_id"),
        ("weight: 2", "weight: -2", "must not be negative"),
        ("value: 30", "value: -3", "value must not be negative"),
        (", value: 30", "", "has no value"),
        ("max: 9", "max: 3", "max should be at least min, 5"),
        ("agents_number: 3", "agents_number: many", "should be a number"),
    ],
)
def test_a_broken_section_is_refused_with_its_line(tmp_path, old, new, message):
    assert old in BUILDING
    with pytest.raises(InputError, match=message) as caught:
        load(tmp_path, BUILDING.replace(old, new))
    assert "house.building.yaml:" in str(caught.value)


def test_the_people_of_the_original_benchmark_are_read(shared_data):
    world = Rmf(file=shared_data / "rmf" / "mrp_bench" / "office_crowdsim.building.yaml").load()
    assert sum(group.people for group in world.people) == 8
    assert len(world.activities) == 8
    assert not any("crowd_sim" in note for note in world.notes)


def test_the_section_that_the_how_to_shows_is_read(tmp_path):
    page = (Path(__file__).parents[5] / "docs/how-to/people.md").read_text()
    section = page[page.index("crowd_sim:\n") :].partition("```")[0]
    world = load(tmp_path, BUILDING.partition("crowd_sim:")[0].replace("[1, tea]", "[1, kitchen]") + section)
    assert world.people == (PeopleGroup(people=4, x=2.4, y=10.0, level=0, activity=0),)
    assert [(len(it.places), it.following) for it in world.activities] == [
        (2, ((1, 1),)),
        (0, ((2, 1),)),
        (1, ((0, 1),)),
    ]
    assert world.notes == ()
