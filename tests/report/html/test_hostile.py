"""Results of a stranger in headless Chromium: whatever their fields hold, the page shows it as text."""

import json
import time

import pytest

from mrpbench_core.report.html.page import write_report
from mrpbench_core.report.report import make_report

pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")

HOSTILE = """\
"'></script></title></style></select></pre><img src=x onerror="window.ran='{}'"><script>window.ran='{}'</script>"""


def hostile(name):
    return HOSTILE.format(name, name)


@pytest.fixture(scope="module")
def opened(browser, written, record, tmp_path_factory):
    """Return the browser with the report of records in which every text is markup."""
    records = []
    for tag, planner in enumerate(("cbs", hostile("planner"))):
        for seed in range(8):
            config = {"planner": {"plugin": planner}}
            entry = record(
                f"p{tag}", seed, config=config, cost=float(seed + len(planner)), scenario=hostile(f"scenario {seed}")
            )
            entry["config"]["world"] = {"plugin": hostile("world"), hostile("option"): hostile(f"value of {planner}")}
            entry["metrics"][hostile("metric")] = 1.5
            entry["timing"][hostile("timing")] = 1.5
            entry["error"] = {"stage": hostile("stage"), "message": hostile("message")}
            if seed == 7:
                entry["status"] = hostile("status")
            records.append(entry)
    column = {key: hostile(key) for key in ("unit", "description", "source")} | {"better": "lower", "primary": True}
    invocation = {
        "columns": {"planning.cost": column, hostile("metric"): column},
        "machine": {key: hostile(key) for key in ("node", "processor", "system", "python", "cores", "memory_bytes")},
        "versions": {hostile("distribution"): hostile("version")},
        "overrides": [hostile("override")],
        "started": hostile("started"),
        "study": {hostile("key"): hostile("value")},
    }
    folder = tmp_path_factory.mktemp("stranger") / "javascript:alert(1)"
    results = written(records, folder, json.dumps(invocation))
    page = folder / "report.html"
    write_report(make_report([results], ["all"]), page, {records[0]["run_id"]: hostile("replay")})
    for log in ("browser", "performance"):
        browser.get_log(log)
    browser.get(page.as_uri())
    end = time.monotonic() + 20
    while not browser.execute_script("return document.body.classList.contains('ready')"):
        assert time.monotonic() < end, "the page did not get there in time"
        time.sleep(0.02)
    return browser


def test_no_script_of_a_record_runs(opened):
    opened.execute_script("for (const row of [...document.querySelectorAll('#list tr.entry')].slice(0, 3)) row.click()")
    assert opened.execute_script("return window.ran ?? null") is None
    assert opened.execute_script("return document.querySelectorAll('img, script[src], iframe').length") == 0
    assert opened.get_log("browser") == [], "the policy had nothing to refuse: every field was escaped"


def test_every_field_is_shown_as_text(opened):
    shown = opened.execute_script(
        "return document.body.textContent + [...document.querySelectorAll('[title]')].map((it) => it.title)"
    )
    shown = shown.replace(" ", "_")
    for name in ("planner", "option", "metric", "message", "unit", "processor", "version", "override"):
        assert hostile(name).replace(" ", "_") in shown, name
