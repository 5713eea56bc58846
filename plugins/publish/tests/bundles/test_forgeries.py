"""Planted forgeries, whose hashes are consistent unless they say otherwise: each is found and named."""

import json
import shutil
import zipfile

import numpy as np
import pytest

from mrpbench_core.store.instances import inlined, inlined_array


def of_planner(records, name):
    return [record for record in records if record["config"]["planner"]["plugin"] == name]


# Hashes


def test_an_edited_record_without_new_hashes(forger, found):
    forger.edit(lambda record: record["metrics"].update({"planning.makespan": 0.5}))
    found(forger.pack(seal=False), "files", "is not the file whose SHA-256")


def test_a_file_that_no_manifest_lists(forger, found):
    (forger.top / "data" / "results" / "runs" / "more.jsonl").write_text("")
    found(forger.pack(seal=False), "files", "is not listed in manifest-sha256.txt")


def test_a_manifest_that_lists_a_file_that_is_not_there(forger, found):
    forger.recording().unlink()
    found(forger.pack(seal=False), "files", "is listed in manifest-sha256.txt and is not there")


def test_a_forged_manifest(forger, found):
    manifest = forger.top / "manifest-sha256.txt"
    manifest.write_text(manifest.read_text().replace("a", "b"))
    found(forger.pack(seal=False), "files", "is not the file whose SHA-256 tagmanifest-sha256.txt has")


def test_a_file_that_does_not_belong_there(forger, found):
    (forger.top / "data" / "setup.py").write_text("raise SystemExit\n")
    found(forger.pack(), "files", "data/setup.py: does not belong to a bundle")


def test_another_tag_file(forger, found):
    (forger.top / "fetch.txt").write_text("https://example.org/x - data/x\n")
    found(forger.pack(seal=False), "files", "fetch.txt does not belong to a bundle")


# Description


def test_a_description_of_other_versions(forger, found):
    crate = forger.top / "data" / "ro-crate-metadata.json"
    crate.write_text(crate.read_text().replace('"softwareVersion": "', '"softwareVersion": "9.'))
    found(forger.pack(seal=False), "description", "does not describe these files, versions and invocations")


def test_a_citation_of_other_authors(forger, found):
    citation = forger.top / "data" / "CITATION.cff"
    citation.write_text(citation.read_text().replace("The authors of tiny", "Somebody Famous"))
    found(forger.pack(seal=False), "description", "does not say what the description says")


def test_another_study_file(forger, found):
    (forger.top / "data" / "study.yaml").write_text("name: other\n")
    found(forger.pack(seal=False), "description", "is not the configuration of the newest invocation")


# Records and studies


def test_a_dropped_run(forger, found):
    forger.write(forger.records()[1:])
    found(forger.pack(), "study", "is a run of the study without a record")


def test_all_failures_of_a_planner_dropped_with_their_seeds(forger, found):
    forger.write([record for record in forger.records() if record["seed"] != 1])
    found(forger.pack(), "study", "is a run of the study without a record")


def test_a_doubled_record(forger, found):
    records = forger.records()
    forger.write([*records, records[0]])
    found(forger.pack(), "records", "has two records of attempt 1")


def test_a_renamed_run(forger, found):
    forger.edit(lambda record: record.update(run_id="0123456789abcdef"))
    found(forger.pack(), "study", "its id does not follow from it")


def test_a_run_of_another_study(forger, found):
    records = forger.records()
    more = records[0] | {"run_id": "0123456789abcdef", "seed": 77, "config": records[0]["config"] | {"seed": 77}}
    forger.write([*records, more])
    found(forger.pack(), "study", "is not a run of the study of its invocation")


def test_a_study_from_which_a_planner_was_removed(forger, found):
    forger.edit_document(lambda data: data["study"]["matrix"].update(planner=["cbs"]))
    found(forger.pack(), "study", "is not a run of the study of its invocation")


def test_a_study_with_another_limit(forger, found):
    forger.edit_document(lambda data: data["study"].update(limits={"planning": 1}))
    found(forger.pack(), "study", "its id does not follow from it")


def test_another_configuration_under_the_same_id(forger, found):
    forger.edit(lambda record: record["config"]["limits"].update(planning=3600.0))
    found(forger.pack(), "study", "has another configuration than its id says: limits")


def test_a_column_of_which_more_is_suddenly_better(forger, found):
    forger.edit_document(lambda data: data["columns"]["planning.makespan"].update(better="higher"))
    found(forger.pack(), "study", "declares other columns, units or directions")


def test_a_line_that_is_no_record(forger, found):
    forger.shard.write_text(forger.shard.read_text() + '{"run_id": 3}\n')
    forger.sums = lambda: None
    found(forger.pack(), "records", "is not a record")


def test_a_record_that_was_cut(forger, found):
    forger.shard.write_text(forger.shard.read_text() + '{"run_id": ')
    forger.sums = lambda: None
    found(forger.pack(), "records", "ends in the middle of a record")


def test_a_record_of_an_invocation_without_document(forger, found):
    forger.document.rename(forger.document.with_name("20000101T000000.000000Z-00000000.yaml"))
    found(forger.pack(), "references", "is not the document of this invocation")


# Statuses and seeds


def test_a_failure_that_became_a_success(forger, found):
    def fail(record):
        record.update(status="plan_timeout", error={"stage": "planning", "message": "late"})

    forger.edit(fail)
    forger.edit(lambda record: record.update(status="succeeded"))
    found(forger.pack(), "statuses", "has the status succeeded and an error")


def test_a_success_that_became_a_timeout(forger, found):
    forger.edit(
        lambda record: record.update(status="plan_timeout", error={"stage": "planning", "message": "the planner ended"})
    )
    found(forger.pack(), "statuses", "has the status plan_timeout and the cost of a plan")


def test_a_status_that_the_stage_cannot_have(forger, found):
    forger.edit(lambda record: record.update(status="goals_missed", error={"stage": "planning", "message": "late"}))
    found(forger.pack(), "statuses", "which a run cannot get in the stage planning")


def test_a_metric_that_was_left_out(forger, found):
    forger.edit(lambda record: record["metrics"].pop("execution.robot_contacts"))
    found(forger.pack(), "statuses", "its metrics are not the columns that its invocation declares")


def test_swapped_seeds(forger, found):
    records = of_planner(forger.records(), "cbs")
    rest = of_planner(forger.records(), "prioritized")
    results = [{key: record[key] for key in ("metrics", "timing", "scenario_id", "plan")} for record in records]
    forger.write([record | result for record, result in zip(records, reversed(results), strict=True)] + rest)
    found(forger.pack(), "scenarios", "does not have the scenario that its configuration draws")


def test_another_seed_than_the_configuration(forger, found):
    forger.edit(lambda record: record.update(seed=9))
    found(forger.pack(), "records", "its seed is not the one of its configuration")


def test_a_scenario_of_its_own(forger, found):
    forger.edit(lambda record: record.update(scenario_id="easy"))
    found(forger.pack(), "records", "has another scenario than other runs")


# Versions and sources


def test_another_version(forger, found):
    def claim(record):
        record["provenance"]["versions"]["mrpbench-planners-mapf"] = "9.9"
        for entry in record["provenance"]["components"]:
            if entry.get("distribution") == "mrpbench-planners-mapf":
                entry["version"] = "9.9"

    forger.edit_all(claim)
    forger.edit_document(lambda data: data["versions"].update({"mrpbench-planners-mapf": "9.9"}))
    found(forger.pack(), "versions", "was made with mrpbench-planners-mapf 9.9")


def test_a_version_of_one_record(forger, found):
    forger.edit(lambda record: record["provenance"]["versions"].update(numpy="9.9"))
    found(forger.pack(), "versions", "says numpy 9.9, its invocation")


def test_a_component_that_is_not_listed(forger, found):
    forger.edit(lambda record: record["provenance"]["components"].pop())
    found(forger.pack(), "versions", "does not list the metric 'execution', which it needs")


def test_a_changed_map(forger, found):
    (file,) = (forger.top / "data" / "inputs").rglob("tiny.map")
    file.write_text(file.read_text().replace("@", "."))
    found(forger.pack(), "study", "its id does not follow from it")


# Recordings and plans


def rewritten(file, change):
    """Write a recording again with other arrays."""
    parts = {}
    with zipfile.ZipFile(file) as old:
        parts = {name: old.read(name) for name in old.namelist()}
    arrays = {}
    for name, content in parts.items():
        if name.endswith(".npy"):
            path = file.with_suffix(".npy")
            path.write_bytes(content)
            arrays[name] = np.load(path)
            path.unlink()
    change(arrays)
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as new:
        for name, content in parts.items():
            if name in arrays:
                path = file.with_suffix(".npy")
                np.save(path, arrays[name])
                content = path.read_bytes()
                path.unlink()
            new.writestr(name, content)


def test_an_edited_metric_with_its_recording(forger, found):
    forger.edit(lambda record: record["metrics"].update({"execution.duration_s": 1.0}))
    found(forger.pack(), "recordings", "execution.duration_s is not what the recording gives")


def test_swapped_recordings(forger, found):
    first, second = forger.recording(0), forger.recording(1)
    content = first.read_bytes()
    shutil.copy(second, first)
    second.write_bytes(content)
    found(forger.pack(), "recordings", "is the recording of another run")


def test_a_recording_that_the_record_does_not_have(forger, found):
    shutil.copy(forger.recording(1), forger.recording(0))
    forger.sums = lambda: None
    found(forger.pack(), "references", "is not the recording whose SHA-256 its record has")


def test_a_recording_that_no_record_names(forger, found):
    shutil.copy(forger.recording(), forger.recording().with_name("0123456789abcdef.zip"))
    found(forger.pack(), "references", "is a recording that no record names")


def test_a_recording_that_was_left_out(forger, found):
    forger.recording().unlink()
    found(forger.pack(), "references", "recordings that the share draws are missing")


def test_a_recording_that_was_shortened(forger, found):
    def shorten(arrays):
        for name in [name for name in arrays if name.startswith("time/")]:
            arrays[name] = arrays[name] * 0.5

    rewritten(forger.recording(), shorten)
    found(forger.pack(), "recordings", "samples are missing")


def test_a_recording_whose_robots_jump(forger, found):
    def jump(arrays):
        for name in [name for name in arrays if name.startswith("truth/")]:
            arrays[name] = np.concatenate(
                [arrays[name][:1], np.repeat(arrays[name][-1:], len(arrays[name]) - 1, axis=0)]
            )

    rewritten(forger.recording(), jump)
    found(forger.pack(), "recordings", "faster than its limits allow")


def test_a_plan_that_was_edited(forger, found):
    file = forger.recording()
    with zipfile.ZipFile(file) as old:
        parts = {name: old.read(name) for name in old.namelist()}
    header = json.loads(parts["context.json"])
    paths = header["context"]["paths"]
    for column in ("enter", "leave"):
        paths[column]["array"] = inlined(np.maximum(inlined_array(paths[column]["array"]) - 1, 0))
    parts["context.json"] = json.dumps(header).encode()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as new:
        for name, content in parts.items():
            new.writestr(name, content)
    found(forger.pack(), "recordings", "and its recording shows plan_invalid: robot 0")


def test_the_cost_of_a_plan(forger, found):
    forger.edit(lambda record: record["plan"].update(cost=1))
    found(forger.pack(), "recordings", "its plan has another problem, cost or bound than the record says")


# Times


def test_an_impossible_processor_time(forger, found):
    forger.edit_all(lambda record: record["timing"].update(planning_cpu_s=record["timing"]["planning_s"] * 64 + 1))
    found(forger.pack(), "times", "more CPU time than its cores have")


def test_a_plan_after_the_limit(forger, found):
    forger.edit(lambda record: record["timing"].update(planning_s=61.0))
    found(forger.pack(), "times", "has a plan that came after the limit")


def test_a_negative_time(forger, found):
    forger.edit(lambda record: record["timing"].update(planning_s=-1.0))
    found(forger.pack(), "times", "is not a number of 0 or more")


def test_a_faster_simulation(forger, found):
    forger.edit(lambda record: record["timing"].update(real_time_factor=1e6))
    found(forger.pack(), "recordings", "do not give the simulated time of the recording")


# What only a repetition shows


@pytest.mark.parametrize("change", ["metric", "status", "clock bound"])
def test_a_forged_record_without_recording(forger, change, found, judged):
    """The forger leaves out all recordings, so that records contradict nothing."""

    def lie(record):
        if change == "metric":
            record["metrics"]["planning.makespan"] *= 0.5
        elif change == "status":
            record.update(status="crashed", error={"stage": "metrics", "message": "it died"}, metrics={})
        else:
            record["timing"]["clock_bound"] = True

    info = forger.top / "bag-info.txt"
    info.write_text(info.read_text().replace("Mrpbench-Recordings: 1", "Mrpbench-Recordings: 0"))
    shutil.rmtree(forger.results / "recordings")
    forger.edit(lie)
    file = forger.pack()
    assert judged(file) == {}
    words = {
        "metric": "planning.makespan differs when the run is repeated",
        "status": "has the status crashed, here succeeded",
        "clock bound": "says that the clock ended its planning, which ends by itself here",
    }
    found(file, "repetition", words[change], rerun=1.0, seed="1")


# Files outside of the bundle


def test_a_study_that_reads_files_of_the_verifier(forger, tmp_path, found):
    secret = tmp_path / "secret.map"
    secret.write_text((forger.top / "data" / "inputs" / "maps" / "tiny.map").read_text())
    forger.edit_document(lambda data: data["study"]["world"].update(file=str(secret)))
    found(forger.pack(), "inputs", "which is not in the bundle", rerun=1.0, seed="1")
