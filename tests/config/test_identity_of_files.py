"""Files that components read are part of the identity of runs, with the installed plugins."""

import pytest

from mrpbench_core.config.study import load_study


def test_an_image_counts_that_a_map_names(tmp_path):
    pytest.importorskip("PIL")
    image = tmp_path / "map.pgm"
    image.write_bytes(b"P5 2 1 255 \xfe\xfe")
    (tmp_path / "map.yaml").write_text("image: map.pgm\nresolution: 1\norigin: [0, 0, 0]\n")
    (tmp_path / "run.yaml").write_text(
        "world: {plugin: ros_map, file: map.yaml}\nroadmap: grid\nscenario: {plugin: random, robots: 1}\n"
        "assigner: identity\nplanner: example\nsimulator: none\n"
    )

    def run_id():
        return load_study(tmp_path / "run.yaml").runs[0].run_id

    before = run_id()
    assert run_id() == before
    image.write_bytes(b"P5 2 1 255 \xfe\x00")
    assert run_id() != before


def test_the_urdf_of_a_robot_and_its_meshes_count_but_not_where_they_lie(tmp_path):
    sphere = '<collision><geometry><sphere radius="0.1"/></geometry></collision>'
    wheel = f'<link name="{{0}}"><inertial><mass value="1"/></inertial>{sphere}</link>'
    ends = '<parent link="base"/><child link="{0}"/><origin xyz="0 {1} 0"/><axis xyz="0 1 0"/>'
    joint = f'<joint name="{{0}}" type="continuous">{ends}</joint>'
    parts = [text.format(name, y) for name, y in (("left", 0.2), ("right", -0.2)) for text in (wheel, joint)]
    hull = '<link name="base"><collision><geometry><mesh filename="hull.stl"/></geometry></collision></link>'

    def write(folder):
        folder.mkdir()
        (folder / "hull.stl").write_text("solid")
        (folder / "cart.urdf").write_text(f'<robot name="cart">{hull}{"".join(parts)}</robot>')
        (folder / "cart.yaml").write_text(
            "name: cart\nfootprint: [[0.3, -0.2], [0.3, 0.2], [-0.3, 0.2]]\nmax_speed: 1\nmax_turn_rate: 1\n"
            "urdf: {file: cart.urdf, wheels: [left, right]}\n"
        )
        (folder / "run.yaml").write_text(
            "world: office\nscenario: {plugin: random, robots: 1}\nfleet: cart.yaml\nplanner: example\n"
        )

    def run_id(folder):
        return load_study(folder / "run.yaml").runs[0].run_id

    write(tmp_path / "here")
    write(tmp_path / "there")
    same = run_id(tmp_path / "here")
    assert run_id(tmp_path / "there") == same
    (tmp_path / "here" / "hull.stl").write_text("solid hull")
    assert run_id(tmp_path / "here") != same
    (tmp_path / "there" / "cart.urdf").write_text((tmp_path / "there" / "cart.urdf").read_text().replace("0.1", "0.2"))
    assert run_id(tmp_path / "there") not in (same, run_id(tmp_path / "here"))
