"""Runs programs in an environment of their own, in which what is written can be installed."""

import os
import subprocess
import sys
import sysconfig

import pytest


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Studies of a module share their worker processes."""


@pytest.fixture(scope="session")
def environment(tmp_path_factory):
    """Return a function that runs a program of a new virtual environment with pip, which sees all that is installed."""
    folder = tmp_path_factory.mktemp("environment")
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    paths = {"base": str(folder), "platbase": str(folder)}
    own = sysconfig.get_path("purelib", scheme="venv", vars=paths)
    here = sysconfig.get_path("purelib")
    (folder / own / "here.pth").write_text(f"import site; site.addsitedir({here!r})\n")
    (folder / "bin/mrpbench").write_text(
        f"#!{folder}/bin/python\nimport sys\nfrom mrpbench_core.cli.main import main\nsys.exit(main())\n"
    )
    (folder / "bin/mrpbench").chmod(0o755)
    path = f"{folder}/bin:{sysconfig.get_path('scripts')}:{os.environ['PATH']}"

    def run(*words, cwd, ok=True, timeout=100):
        done = subprocess.run(
            words,
            cwd=cwd,
            env={**os.environ, "PATH": path, "VIRTUAL_ENV": str(folder)},
            capture_output=True,
            text=True,
            timeout=timeout,
        )
        assert not ok or done.returncode == 0, done.stdout + done.stderr
        return done

    return run
