"""The worlds that come with this distribution: editable `building.yaml` files in the folder `data`."""

from pathlib import Path
from typing import Literal

import attrs

from mrpbench_core.api.component import option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.model.worlds.world import World
from mrpbench_worlds_standard.rmf import DoorState, Rmf, doors_option

FOLDER = Path(__file__).parent / "data"
CASES = ("corridor", "swap", "roundabout", "alcove", "door")
ENCOUNTERS = ("crossing", "head_on", "narrow", "overtaking", "blind_corner", "doorway", "group")


@attrs.frozen(kw_only=True)
class Office(WorldSource):
    """An office of 21.5 × 12 m: ten rooms on both sides of a corridor, 29 places."""

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "office.building.yaml").load()


@attrs.frozen(kw_only=True)
class Warehouse(WorldSource):
    """A warehouse of 22 × 27 m: shelves, aisles, docks and pick stations, 54 places."""

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "warehouse.building.yaml").load()


@attrs.frozen(kw_only=True)
class Airport(WorldSource):
    """An airport terminal of 282 × 64 m: two concourses, 56 gates, shops and lounges, 210 places."""

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "airport.building.yaml").load()


@attrs.frozen(kw_only=True)
class Household(WorldSource):
    """A furnished flat of 12.4 × 9.2 m: five rooms on a hall, 28 places. Doors and passages are 0.7 m wide."""

    doors: DoorState = doors_option()

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "household.building.yaml", clearance=0.3, doors=self.doors).load()


@attrs.frozen(kw_only=True)
class Hospital(WorldSource):
    """A hospital of 26 × 12 m on three floors: fifteen rooms with doors, four lifts, a corridor with two lanes."""

    doors: DoorState = doors_option()

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "hospital.building.yaml", doors=self.doors).load()


@attrs.frozen(kw_only=True)
class Bottlenecks(WorldSource):
    """Minimal hard cases in which robots have to give way to one another. Passages are 0.7 m wide.

    `corridor`: two rooms, 4.8 m apart, joined by a corridor for one robot. `swap`: a room two robots wide.
    `roundabout`: a one-way ring with four arms. `alcove`: a corridor with one place to let another robot pass.
    `door`: two rooms and one narrow door.
    """

    case: Literal["corridor", "swap", "roundabout", "alcove", "door"] = option(
        "corridor", help="Which case: one level of the file.", validator=attrs.validators.in_(CASES)
    )

    def load(self) -> World:
        """Read the packaged file."""
        return _case("bottlenecks", self.case)


@attrs.frozen(kw_only=True)
class Station(WorldSource):
    """A station hall of 36 × 16 m: entrances, stairs to four platforms, kiosks, pillars, docks, 21 places."""

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "station.building.yaml").load()


@attrs.frozen(kw_only=True)
class OfficeNoon(WorldSource):
    """An office of 24 × 12 m at noon: offices with doors, kitchen, canteen, meeting room, 23 places.

    Crowds do what people do there: 12 walk between desks, kitchen, canteen, meeting, post and entrance.
    """

    doors: DoorState = doors_option()

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "office_noon.building.yaml", doors=self.doors).load()


@attrs.frozen(kw_only=True)
class HospitalCorridor(WorldSource):
    """Two hospital floors of 24 × 10.4 m: fourteen rooms with doors at corridors of 2.4 m, one lift, 46 places.

    Crowds do what people do there, one crowd for each floor: 8 staff, visitors and patients walk between nurses'
    station, rooms and lift, and along the corridor.
    """

    doors: DoorState = doors_option()

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "hospital_corridor.building.yaml", doors=self.doors).load()


@attrs.frozen(kw_only=True)
class WarehousePickers(WorldSource):
    """A warehouse of 24 × 17 m with pickers: five racks, six aisles of 2.2 m and more, packing stations, 32 places.

    Crowds do what people do there: 10 walk along an aisle, pick at shelves, and bring it to a packing station.
    """

    def load(self) -> World:
        """Read the packaged file."""
        return Rmf(file=FOLDER / "warehouse_pickers.building.yaml").load()


@attrs.frozen(kw_only=True)
class Encounters(WorldSource):
    """Minimal cases in which a robot, from `robot` to `robot_goal`, meets one who goes from `person` to `person_goal`.

    `crossing`: two corridors of 2 m, in which a person at 1.34 m/s meets a robot at 0.22 m/s. `head_on`, `narrow`: in a
    corridor of 2 or 1.2 m. `overtaking`: the person begins behind the robot. `blind_corner`: corridors of 1.5 m.
    `doorway`: 0.9 m, at the same time. `group`: three people stand in the way, also at `person_2` and `person_3`.
    """

    case: Literal["crossing", "head_on", "narrow", "overtaking", "blind_corner", "doorway", "group"] = option(
        "crossing", help="Which case: one level of the file.", validator=attrs.validators.in_(ENCOUNTERS)
    )

    def load(self) -> World:
        """Read the packaged file."""
        return _case("encounters", self.case)


def _case(name: str, case: str) -> World:
    """One level of a packaged file."""
    world = Rmf(file=FOLDER / f"{name}.building.yaml", level=case).load()
    notes = tuple(note for note in world.notes if not note.startswith("only level"))
    return attrs.evolve(world, name=f"{name}_{case}", notes=notes)
