"""Who is told which plugin is imported."""

from mrpbench_core.plugins import importing


def test_the_listener_is_told_which_import_begins_and_which_goes_on_after_it(monkeypatch):
    told = []
    monkeypatch.setattr(importing, "_listener", told.append)
    with importing.attributed_to("outer"):
        with importing.attributed_to("inner"):
            pass
        assert told == ["outer", "inner", "outer"]
    assert told[3:] == [None]
