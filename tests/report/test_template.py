"""Pages run the scripts of their template only, also where something was not escaped."""

import re

import pytest

from mrpbench_core.report.template import PageTemplate

TEMPLATE = """\
<style>
p { color: rgb(1, 2, 3); }
</style>
</head>
<body>
<p id="own">nothing</p>
<!--data-->
<script><!--script--></script>
</body>
</html>
"""
SCRIPT = "document.getElementById('own').textContent = 'own script';"
INJECTED = (
    "<script>window.ran = 1</script><img src=x onerror='window.ran = 2'><svg onload='window.ran = 3'></svg>"
    "<script src='data:text/javascript,window.ran = 4'></script><style>p { color: red !important; }</style>"
    "<iframe srcdoc='<script>parent.ran = 5</script>'></iframe><base href='http://127.0.0.1:9/'>"
    "<img src='http://127.0.0.1:9/beacon'><link rel='stylesheet' href='http://127.0.0.1:9/sheet'>"
    "<p style='color: red' onclick='window.ran = 6'>styled</p><a id='go' href='javascript:window.ran=7'>go</a>"
)


@pytest.fixture
def template(tmp_path):
    (tmp_path / "body.html").write_text(TEMPLATE)
    return PageTemplate(tmp_path / "body.html", {"script": SCRIPT})


def test_a_page_is_recognised_by_its_policy(template, tmp_path):
    page = tmp_path / "page.html"
    template.write(page, "<title>", {"data": INJECTED})
    assert template.wrote(page)
    assert "<title>&lt;title&gt;</title>" in page.read_text()
    page.write_text("<script>alert(1)</script>" + page.read_text())
    assert not template.wrote(page)
    assert not template.wrote(tmp_path / "none.html")
    assert not template.wrote(tmp_path)


def test_the_policy_forbids_inline_scripts_and_the_network(template):
    assert "unsafe" not in template.policy
    assert template.policy.startswith("default-src 'none'; script-src 'sha256-")
    sources = re.sub(r"'[^']*'", "", template.policy)
    assert not re.search(r"http|\*|blob:|script-src[^;]*data:", sources)


def test_injected_markup_runs_nothing_and_asks_for_nothing(browser, template, tmp_path):
    page = tmp_path / "page.html"
    template.write(page, "page", {"data": INJECTED})
    browser.get_log("browser")
    browser.get_log("performance")
    browser.get(page.as_uri())
    browser.execute_script("document.getElementById('go').click(); document.querySelector('[onclick]').click()")
    assert browser.execute_script("return window.ran ?? null") is None
    assert browser.execute_script("return document.getElementById('own').textContent") == "own script"
    colours = "return [...document.querySelectorAll('p')].map((p) => getComputedStyle(p).color)"
    assert browser.execute_script(colours) == ["rgb(1, 2, 3)"] * 2
    refused = " ".join(entry["message"] for entry in browser.get_log("browser"))
    assert refused.count("Content Security Policy") >= 8
    received = [entry["message"] for entry in browser.get_log("performance") if "responseReceived" in entry["message"]]
    assert not [message for message in received if "127.0.0.1" in message]
