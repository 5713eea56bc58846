"""Build every distribution, check it, and try the wheels in empty environments of each version of Python.

`make wheels` runs this. Distributions are built twice, in isolation, the wheel from the sdist, and must be equal byte
for byte. Then only the wheels are installed into an empty environment of each Python that is found, and a first study
is written, run and reported there, outside of the checkout. Then a plugin of each kind is written there, installed from
its folder as its README says, and its tests run.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
PYTHONS = ("3.11", "3.12", "3.13")
STUDY = (
    ("init", "first"),
    ("run", "first.yaml", "simulator=planar", "controller=dwb"),
    ("publish", "results/first", "--out", "first.zip"),
    ("verify", "first.zip"),
    ("report", "results/first"),
)


def folders() -> list[Path]:
    """The folders of all distributions."""
    return [ROOT, *sorted(file.parent for part in ("metapackage", "native", "plugins") for file in projects(part))]


def projects(part: str) -> list[Path]:
    """The projects in a folder, without copies in folders of builds."""
    return [file for file in (ROOT / part).rglob("pyproject.toml") if "build" not in file.relative_to(ROOT).parts]


def build(out: Path, chosen: list[Path]) -> None:
    """Build the sdists, and the wheels from them."""
    committed = subprocess.run(["git", "log", "-1", "--format=%ct"], cwd=ROOT, capture_output=True, text=True)
    environment = {**os.environ, "SOURCE_DATE_EPOCH": committed.stdout.strip() or "1600000000"}
    installer = ["--installer", "uv"] if shutil.which("uv") else []
    for folder in chosen:
        print(f"building {folder.relative_to(ROOT.parent)}", flush=True)
        command = [sys.executable, "-m", "build", *installer, "--outdir", str(out), str(folder)]
        done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            sys.exit(done.stdout)


def check(out: Path) -> None:
    """Check metadata and contents of all files, and the ABI and libraries of the native wheel."""
    files = list(map(str, sorted(out.iterdir())))
    native = [file for file in files if "abi3" in file]
    for command in (
        ["cffconvert.cli.cli", "--validate", "--infile", str(ROOT / "CITATION.cff")],
        ["twine", "check", "--strict", *files],
        # mrpbench has no modules (W007, W008), mrpbench-standard several packages (W009)
        ["check_wheel_contents", "--ignore", "W007,W008,W009", *(file for file in files if file.endswith(".whl"))],
        ["abi3audit", "--strict", *native],
        ["auditwheel", "show", *native],
    ):
        subprocess.run([sys.executable, "-m", *command], check=True)
    for file in files:
        if file.endswith(".whl"):
            names = zipfile.ZipFile(file).namelist()
            if not {"LICENSE", "NOTICE"} <= {Path(name).name for name in names if "/licenses/" in name}:
                sys.exit(f"{file} lacks LICENSE or NOTICE")


def compare(first: Path, second: Path) -> None:
    """Exit if two builds differ."""
    differing = [file.name for file in first.iterdir() if file.read_bytes() != (second / file.name).read_bytes()]
    if differing:
        sys.exit(f"two builds differ: {', '.join(differing)}")
    print("two builds are equal byte for byte")


def python(version: str) -> str | None:
    """The interpreter of a version, on the path or from pyenv."""
    root = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv")
    candidates = [shutil.which(f"python{version}"), *sorted(map(str, root.glob(f"versions/{version}.*/bin/python")))]
    for candidate in filter(None, candidates):
        command = [candidate, "-c", "import sys, venv; print('%d.%d' % sys.version_info[:2])"]
        if subprocess.run(command, capture_output=True, text=True).stdout.strip() == version:
            return candidate
    return None


def drive(interpreter: str, out: Path, folder: Path) -> dict[str, float]:
    """Install the wheels into an empty environment, and do a first study there."""
    release = next(out.glob("mrpbench-*.whl")).name.split("-")[1]
    bin_folder = folder / "env/bin"
    environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "VIRTUAL_ENV")}
    subprocess.run([interpreter, "-m", "venv", str(folder / "env")], check=True)
    before = time.monotonic()
    subprocess.run(
        [bin_folder / "python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--only-binary=:all:"]
        + [f"--find-links={out}", f"mrpbench=={release}"],
        check=True,
        env=environment,
    )
    installed = time.monotonic()
    work = folder / "work"
    work.mkdir()
    for words in STUDY:
        done = subprocess.run(
            [bin_folder / "mrpbench", *words], cwd=work, env=environment, capture_output=True, text=True
        )
        if done.returncode or "Traceback" in done.stderr:
            sys.exit(f"mrpbench {' '.join(words)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    if "succeeded" not in done.stdout or not (work / "results/first/report.html").is_file():
        sys.exit(f"the report says nothing of runs that succeeded:\n{done.stdout}")
    finished = time.monotonic()
    facts = sizes(folder) | {"install s": installed - before, "first study and report s": finished - installed}
    facts["plugins from templates"] = write_plugins(bin_folder, out, work, environment)
    return facts


def sizes(folder: Path) -> dict[str, float]:
    """Count what is installed."""
    (site,) = (folder / "env/lib").glob("python3*/site-packages")
    tools = ("pip", "setuptools", "pkg_resources", "_distutils", "distutils")  # what venv puts there
    ours = [path for path in site.iterdir() if not path.name.startswith(tools)]
    files = [file for path in ours for file in ([path] if path.is_file() else path.rglob("*")) if file.is_file()]
    return {
        "distributions": sum(path.suffix == ".dist-info" for path in ours),
        "MB": sum(file.stat().st_size for file in files if file.suffix != ".pyc") / 1e6,
        "MB with bytecode": sum(file.stat().st_size for file in files) / 1e6,
    }


def write_plugins(bin_folder: Path, out: Path, work: Path, environment: dict[str, str]) -> int:
    """Write a plugin of each kind and form, install it, and run its tests; return their number."""
    kinds = "from mrpbench_scaffold.kinds import kinds; print(*kinds())"
    words = subprocess.run([bin_folder / "python", "-c", kinds], capture_output=True, text=True, check=True)
    forms = [(kind, ()) for kind in words.stdout.split()] + [("planner", ("--native",)), ("planner", ("--external",))]
    environment = environment | {"PATH": f"{bin_folder}{os.pathsep}{environment['PATH']}"}
    install = [str(bin_folder / "python"), "-m", "pip", "install", "--quiet", f"--find-links={out}"]
    for kind, options in forms:
        name = "_".join(["own", kind, *(option.removeprefix("--") for option in options)])
        for command in (
            [str(bin_folder / "mrpbench"), "new-plugin", kind, name, "--folder", name, *options],
            [*install, f"./{name}", "pytest"],
            [str(bin_folder / "python"), "-m", "pytest", "-q", f"{name}/tests"],
        ):
            done = subprocess.run(command, cwd=work, env=environment, capture_output=True, text=True)
            if done.returncode:
                sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return len(forms)


def main() -> None:
    """Build, check, install and drive."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="folder of the files (default: dist)")
    parser.add_argument("--once", action="store_true", help="do not build a second time to compare")
    parser.add_argument("--no-build", action="store_true", help="take the files that are in the folder")
    parser.add_argument("--no-drive", action="store_true", help="build and check only")
    arguments = parser.parse_args()
    out = arguments.out.resolve()
    if not arguments.no_build:
        shutil.rmtree(out, ignore_errors=True)
        build(out, folders())
        if not arguments.once:
            with tempfile.TemporaryDirectory() as again:
                build(Path(again), folders())
                compare(out, Path(again))
    check(out)
    print(f"{sum(file.stat().st_size for file in out.glob('*.whl')) / 1e6:.1f} MB of wheels")
    for version in () if arguments.no_drive else PYTHONS:
        interpreter = python(version)
        if interpreter is None:
            print(f"Python {version}: skipped, it is not installed here")
            continue
        with tempfile.TemporaryDirectory() as folder:
            facts = drive(interpreter, out, Path(folder))
        print(f"Python {version}: " + ", ".join(f"{value:.0f} {name}" for name, value in facts.items()), flush=True)


if __name__ == "__main__":
    main()
