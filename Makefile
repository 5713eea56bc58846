# `make demo` and `make test` install into .venv first; `make help` lists all targets.
PYTHON ?= $(shell for name in python3.11 python3.12 python3.13 python3; do command -v $$name && break; done)
VENV := .venv
BIN := $(VENV)/bin
UV := $(shell command -v uv)
STAMP := $(VENV)/.installed
JOBS ?= 2
NATIVE := $(shell find native -name build -prune -o \( -name '*.cpp' -o -name '*.hpp' -o -name '*.py' -o -name '*.pyi' -o -name CMakeLists.txt \) -print)
INPUTS := pyproject.toml uv.lock requirements.txt pinned.txt $(wildcard native/pyproject.toml plugins/pyproject.toml plugins/*/pyproject.toml plugins/*/*/pyproject.toml) $(NATIVE)

.PHONY: paper slurm results-site help install explore pages anchors rotations demo test lint types layers cpp python format lock speed policy pogema clean optima live ros soak sanitize worlds fuzz mutants wheels docs links hunts

help: ## list the targets
	@grep -hE '^[a-z-]+:.*##' Makefile | sed -E 's/:.*## /\t/' | expand -t 12

install: $(STAMP) ## install everything into .venv, with uv if it is installed, else with pip

$(STAMP): $(INPUTS)
ifdef UV
	UV_PYTHON_DOWNLOADS=never uv sync --locked --python $(PYTHON)
else
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements.txt
endif
	@touch $@

speed: install ## measure the speed of executions, and the share of each part; BASE=commit for ratios to that commit
	$(BIN)/python $(if $(BASE),benchmarks/speed.py $(BASE),benchmarks/full_stack.py) $(ARGS)

anchors: install ## compare cbs, ecbs and eecbs with the reference solvers; ARGS="--maps maze-32-32-2" for less
	$(BIN)/python benchmarks/anchors.py --shared ../shared/data $(ARGS)

OPTIMA := "cbs" "ita_cbs" "cbs_ta" "ecbs w=1.0" "ecbs w=1.2" "eecbs w=1.0" "eecbs w=1.05" "eecbs w=1.2" "ita_ecbs w=1.2" "lacam" "lns"
optima: install ## check all 636 published optima with every planner that promises them (hours); OPTIMA='"cbs"' ARGS="--limit 1"
	for planner in $(OPTIMA); do $(BIN)/python plugins/planners/mapf/tests/soak_optima.py --shared ../shared/data --planner "$$planner" $(ARGS) || exit 1; done

DEMO := $(if $(wildcard $(STAMP)),$(VENV),build/demo)
demo: ## compare three planners, one of them from a folder of its own, with bodies and lidar, end to end: answer, table, replay, picture, bag; installs only what that needs, unless .venv is there
ifdef UV
	test -e $(STAMP) || UV_PROJECT_ENVIRONMENT=$(DEMO) UV_PYTHON_DOWNLOADS=never uv sync --quiet --locked --no-default-groups --group demo --python $(PYTHON)
else
	test -x $(DEMO)/bin/python || $(PYTHON) -m venv $(DEMO)
	test -e $(STAMP) || $(DEMO)/bin/python -m pip install --quiet --disable-pip-version-check --constraint pinned.txt '.[figures,statistics]' ./native ./plugins ./plugins/replay ./plugins/scaffold ./plugins/world ./plugins/exporters/rosbag2 ./plugins/simulators/mujoco
endif
	$(if $(UV),$(UV) pip install --python $(DEMO)/bin/python,$(DEMO)/bin/python -m pip install --disable-pip-version-check --upgrade) --quiet --no-deps --target build/example ./examples/acme-planner
	PYTHONPATH=build/example $(DEMO)/bin/mrpbench demo

test: install lint types layers docs cpp python ## run all checks of CI

lint: install
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/clang-format --dry-run --Werror $(filter %.cpp %.hpp,$(NATIVE))

types: install
	$(BIN)/mypy

layers: install
	$(BIN)/lint-imports

cpp: install ## run the C++ tests, without Python, of the libraries that `make install` has built
	$(BIN)/cmake -S native -B build/native -G Ninja -DCMAKE_MAKE_PROGRAM=$(CURDIR)/$(BIN)/ninja -DBUILT="$(abspath $(wildcard native/build/cp3*))"
	$(BIN)/cmake --build build/native
	$(BIN)/ctest --test-dir build/native --output-on-failure

python: install ## run the Python tests, JOBS at a time
	$(BIN)/pytest --numprocesses $(JOBS) --dist worksteal

explore: install ## run the property tests with examples that `make test` does not draw
	$(BIN)/pytest --numprocesses $(JOBS) --dist worksteal --hypothesis-profile explore -m hypothesis

soak: install ## compare with brute force, execute drawn plans a million times, do a million events of tasks, run configurations drawn from the schema, disturb studies, look for robots that stand, let people meet robots, drive drawn robots as rigid bodies (six hours)
	$(BIN)/python plugins/planners/mapf/tests/soak_planners.py 20000 1
	$(BIN)/python plugins/planners/mapf/tests/soak_assigning.py 10000 1
	$(BIN)/python tests/engine/execution/soak_executions.py 1000000 1
	$(BIN)/python tests/engine/execution/soak_tasks.py 1000000 1
	$(BIN)/python tests/engine/soak_configurations.py 2000 1
	$(BIN)/python tests/engine/processes/soak_disturbances.py 20 1
	$(BIN)/python tests/engine/processes/soak_disturbances.py 20 2
	$(BIN)/python plugins/controllers/dwb/tests/soak_driving.py 1000 0
	$(BIN)/python plugins/crowds/walking/tests/soak_people.py 60
	$(BIN)/python plugins/crowds/walking/tests/soak_people.py 60 --crowd orca
	$(BIN)/python plugins/policies/tests/env/soak_bodies.py 128 60 1
	$(BIN)/python plugins/simulators/bodies/tests/soak_drives.py 200 0
	$(BIN)/python plugins/simulators/bodies/tests/soak_drives.py 200 0 --simulator pybullet

pages: install ## do what every page of the documentation says, in empty folders (ten minutes)
	MRPBENCH_ALL_PAGES=1 $(BIN)/pytest --numprocesses $(JOBS) --dist worksteal tests/docs

hunts: install ## hunt for six planted faults, and count the runs until each is found (two hours); ARGS="2 20" for 2 searches and 20 random seeds
	$(BIN)/python plugins/search/tests/hunting/soak_hunt.py $(or $(ARGS),10 300)

rotations: install ## let rings of robots rotate 100,000 times in simulators and count contacts (two hours)
	$(BIN)/python tests/builtin/dispatchers/soak_rotations.py 100000 1

SANITIZED := build/sanitized
CHECKED = LD_PRELOAD="$(shell c++ -print-file-name=libasan.so) $(shell c++ -print-file-name=libubsan.so)" ASAN_OPTIONS=detect_leaks=0 $(SANITIZED)/bin/python
sanitize: install ## run native tests and soaks under AddressSanitizer and UndefinedBehaviorSanitizer
	$(BIN)/cmake -S native -B $(SANITIZED)/cpp -G Ninja -DCMAKE_MAKE_PROGRAM=$(CURDIR)/$(BIN)/ninja -DSANITIZE=ON
	$(BIN)/cmake --build $(SANITIZED)/cpp
	$(BIN)/ctest --test-dir $(SANITIZED)/cpp --output-on-failure
	test -x $(SANITIZED)/bin/python || $(PYTHON) -m venv $(SANITIZED)
	SKBUILD_BUILD_DIR=$(CURDIR)/$(SANITIZED)/native SKBUILD_CMAKE_DEFINE=SANITIZE=ON $(SANITIZED)/bin/python -m pip install --quiet --disable-pip-version-check -r requirements.txt
	$(CHECKED) -m pytest -p no:cacheprovider native plugins/planners/mapf plugins/simulators/planar plugins/controllers/dwb plugins/controllers/pure_pursuit plugins/navigators/waypoints plugins/localizers/amcl plugins/localizers/slam
	$(CHECKED) plugins/planners/mapf/tests/soak_planners.py 2000 2
	$(CHECKED) plugins/planners/mapf/tests/soak_assigning.py 1000 2

ATHERIS := build/fuzz/atheris
fuzz: install ## give changed inputs to readers of files; COUNT=1000000 READERS="records mcap"
	test -d $(ATHERIS) || $(PYTHON) -m pip install --quiet --disable-pip-version-check --target $(ATHERIS) atheris || echo "Atheris cannot be installed here"
	PYTHONPATH=$(ATHERIS) $(BIN)/python fuzz/run.py --inputs $(or $(COUNT),20000) $(READERS)
	$(if $(READERS),,fuzz/native.sh $(or $(COUNT),20000))

mutants: install ## change production code 80 times and count how many changes the tests find (an hour); ARGS="--count 10 --seed 2"
	test -x $(BIN)/coverage || $(PYTHON) -m pip --python $(BIN)/python install --quiet --disable-pip-version-check 'coverage>=7.17'
	$(BIN)/python scripts/mutants $(ARGS)

worlds: install ## drive robots on every built-in world without contacts (ten minutes); CONTROLLER=dwb for another
	$(BIN)/python benchmarks/worlds.py --controller $(or $(CONTROLLER),pure_pursuit)

DOCS := build/docs
SPHINX := $(BIN)/sphinx-build --fail-on-warning --keep-going --nitpicky --jobs auto --doctree-dir $(DOCS)/doctrees
docs: install ## build the documentation site into build/docs/html; warnings are errors
	$(SPHINX) docs $(DOCS)/html

links: install ## look up all external links of the documentation
	$(SPHINX) --builder linkcheck docs $(DOCS)/links

WHEELS := build/wheels/bin
wheels: ## build all distributions twice, check them, and drive a first study from the wheels alone on each Python; ARGS="--once"
	test -x $(WHEELS)/python || $(PYTHON) -m venv build/wheels
	$(WHEELS)/python -m pip install --quiet --disable-pip-version-check build twine check-wheel-contents abi3audit auditwheel cffconvert
	$(WHEELS)/python scripts/wheels.py $(ARGS)

format: install ## rewrite the sources in the house style
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(BIN)/clang-format -i $(filter %.cpp %.hpp,$(NATIVE))

lock: ## write the pinned versions for uv and pip; UPGRADE=1 takes the newest
	uv lock $(if $(UPGRADE),--upgrade)
	uv export --quiet --locked --all-groups --no-emit-workspace --no-hashes --no-header --no-annotate --output-file pinned.txt

clean: ## remove the results of builds
	rm -rf build dist $(VENV) native/build

ROS := build/ros/bin
ros: ## test live ROS 2, with rclpy from PyPI in its own environment (Python 3.11)
	test -x $(ROS)/python || python3.11 -m venv build/ros
	$(ROS)/python -m pip install --quiet ros-kilted-rclpy ros-rmw-fastrtps-cpp ros-nav-msgs ros-sensor-msgs ros-diagnostic-msgs ros-visualization-msgs
	$(ROS)/python -m pip install --quiet pytest pytest-timeout -e . ./native -e plugins -e plugins/exporters/rosbag2 -e plugins/bridges/ros2
	$(ROS)/python -m pytest -p no:cacheprovider plugins/bridges/ros2

LIVE := build/live/bin
live: ## measure live fleets, a line for each figure with what was asked: orders of vda5050-sdk and vda-5050-lib, 100,000 broken messages, a broker killed 20 times, 1,000 vehicles, throughput over MQTT, the load test, the patrol swap, the table of Open-RMF (an hour and a half); ARGS="--only swap" for less; needs mosquitto, and npm
	test -x $(LIVE)/python || $(PYTHON) -m venv build/live
	$(LIVE)/python -m pip install --quiet hypothesis pytest pytest-timeout vda5050-sdk aiomqtt -e . ./native -e plugins -e 'plugins/live[rmf,vda5050]'
	if command -v npm >/dev/null; then npm install --silent --no-save --prefix build/live vda-5050-lib@1.4.0; fi
	NODE_PATH=build/live/node_modules $(LIVE)/python benchmarks/live.py $(ARGS)

PAPER := table2 fig5 table4 paper replicability
paper: install ## repeat the paper's tables in office, warehouse and airport, with bodies (ten hours; what is done is not repeated); ARGS="seed=3000" PAPER=paper for less
	for study in $(PAPER); do \
	    case $$study in paper) given=;; replicability) given=simulator=mujoco;; *) given='world=[office,warehouse,airport]';; esac; \
	    $(BIN)/mrpbench run studies/$$study.yaml --workers $(JOBS) --out results/paper/$$study $$given $(ARGS) || exit 1; \
	    $(BIN)/mrpbench report results/paper/$$study || exit 1; \
	done

policy: install ## train the policy that mrpbench-policies ships (25 minutes); ARGS="--instances 50 --rounds 0 --out small.onnx" for less
	OPENBLAS_NUM_THREADS=1 $(BIN)/python scripts/train_policy.py $(ARGS)

POGEMA := build/pogema/bin
pogema: install ## compare 100,000 random steps with POGEMA, in its own environment (Python below 3.13); STEPS=1000 for less; then speeds, and published results
	test -x $(POGEMA)/python || python3.11 -m venv build/pogema
	$(POGEMA)/python -m pip install --quiet --disable-pip-version-check pogema==1.4.0
	$(BIN)/python plugins/policies/tests/observations/soak_pogema.py $(or $(STEPS),100000) 1
	$(BIN)/python benchmarks/policies.py
	$(POGEMA)/python -m pip install --quiet --disable-pip-version-check --no-deps pogema-toolbox==0.1.1 pyyaml
	$(POGEMA)/python plugins/policies/tests/pogema/write_problems.py build/pogema/benchmark
	for set in "01-random --robots 8 32 64" "02-mazes --robots 8 32 64" "03-warehouse --robots 32 96" "05-puzzles --robots 2 3 4"; do \
	    $(BIN)/python benchmarks/pogema_tables.py --benchmark build/pogema/benchmark --set $$set $(ARGS) || exit 1; \
	done
	$(BIN)/python benchmarks/pogema_lifelong.py --maps 16

slurm: install ## run the array job of the page on clusters on a SLURM cluster of this machine (Debian, root; five minutes)
	$(BIN)/python scripts/slurm.py

SEEDS ?= 3000..3053
RESULTS_SITE := build/results-site
results-site: install ## run the studies of the paper, verify their bundles and make a site of them (an hour; SEEDS=3000..3002 for less)
	$(BIN)/python scripts/results_site.py --seeds $(SEEDS) --out $(RESULTS_SITE) $(ARGS)
