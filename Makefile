# Each target sets up .venv by itself when it is missing or older than what it is made from.
PYTHON ?= python3
JOBS ?= 2
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
PEERS := .peers
MAVPROXY := $(CURDIR)/$(PEERS)/mavproxy
PACKAGES := companion fakevehicle planner logs wire campaigns
export PIP_DISABLE_PIP_VERSION_CHECK := 1

.PHONY: help demo test soak test-clients lint check format bench bench-peers paper pin readers web clean
help:            ## show this
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-13s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: $(STAMP)   ## fly the L-shaped wall with the bundled vehicle, over UDP, recorded
	$(BIN)/companion demo

test: $(STAMP)   ## every test, but for those of `make soak`: what needs no clock, then what flies in real time (which mostly waits)
	$(BIN)/python -m pytest -q -m "not soak and not udp" -n $(JOBS) --dist loadgroup
	$(BIN)/python -m pytest -q -m "udp and not soak" -n $(JOBS) --dist loadfile

soak: $(STAMP)   ## tests that are judged by the clock, or long: want a machine of their own
	$(BIN)/python -m pytest -q -m soak

test-clients: $(STAMP) $(PEERS)/mavproxy/.installed $(PEERS)/mavsdk3/.installed ## other people's clients fly the vehicle: MAVSDK 3 and 4, pymavlink, MAVProxy
	PYTHONPATH=$(MAVPROXY) MAVPROXY=$(MAVPROXY)/bin/mavproxy.py $(BIN)/python -m pytest -q tests/clients
	PYTHONPATH=$(CURDIR)/$(PEERS)/mavsdk3 $(BIN)/python -m pytest -q -W ignore::FutureWarning \
		tests/clients/test_mavsdk_grpc.py tests/clients/test_mavsdk_streams.py

lint: $(STAMP)   ## format, lint, types, import rules
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

check: lint      ## the same, and the fast tests
	$(BIN)/python -m pytest -q -m "not udp and not slow"

format: $(STAMP) ## rewrite the sources in the one format
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

bench: $(STAMP)  ## benchmarks: figures and ratios, about ten minutes
	-$(MAKE) bench-peers
	PYTHONPATH=$(PEERS) $(BIN)/python -m benchmarks

bench-peers: $(PEERS)/.installed ## what benchmarks compare with, in a folder of its own, not in the environment

paper: $(STAMP)  ## the paper's tables and figures again, into docs: half an hour on two quiet cores; goes on where it was
	$(BIN)/companion paper -j $(JOBS) --out paper
	mkdir -p docs/paper && cp paper/paper/* docs/paper/ && cp paper/paper.md docs/

pin: $(STAMP)    ## write constraints.txt from what is installed now
	{ head -1 constraints.txt; $(BIN)/pip freeze --all --exclude-editable | grep -v '^pip==' ; } > constraints.tmp && mv constraints.tmp constraints.txt

readers:         ## other people's readers of recordings, for tests/readers (wants node and npm)
	cd tests/readers && npm ci --no-audit --no-fund --ignore-scripts

web:             ## build the page of reports and of the live view from web/ (wants node and npm)
	cd web && npm ci --no-audit --no-fund && npm run build

clean:           ## remove the environment and caches
	rm -rf $(VENV) $(PEERS) .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache build *.egg-info
	find $(PACKAGES) tests benchmarks -name __pycache__ -type d -prune -exec rm -rf {} +

# --no-deps: mealpy pins an old numpy, and needs of pandas only that it can be imported; of rotorpy only the plant is used.
$(PEERS)/.installed: $(STAMP)
	$(BIN)/python -m pip install -q --no-deps --target $(PEERS) --upgrade mealpy==3.0.3 rotorpy==3.0.0 pandas python-dateutil six tzdata
	@touch $@

# --no-deps: of what it brings along (1.1 GB) its console needs the serial port's package, and pymavlink, which is here.
$(PEERS)/mavproxy/.installed: $(STAMP)
	$(BIN)/python -m pip install -q --no-deps --target $(PEERS)/mavproxy --upgrade MAVProxy==1.8.75 pyserial==3.5
	@touch $@

# The asyncio API had the name of the present one until version 4; its code is the same under both.
$(PEERS)/mavsdk3/.installed: $(STAMP)
	$(BIN)/python -m pip install -q --no-deps --target $(PEERS)/mavsdk3 --upgrade mavsdk==3.17.4
	rm -rf $(PEERS)/mavsdk3/mavsdk_grpc && mv $(PEERS)/mavsdk3/mavsdk $(PEERS)/mavsdk3/mavsdk_grpc
	@touch $@

$(STAMP): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; v = sys.version_info; sys.exit(None if v >= (3, 11) else f"companion needs Python 3.11 or newer, found {v[0]}.{v[1]}: make PYTHON=python3.11 ...")'
	@echo "setting up $(VENV) (half a minute to a few, most of it downloads)"
	@$(PYTHON) -m venv --clear $(VENV)
	@$(BIN)/python -m pip install -q -c constraints.txt setuptools
	@$(BIN)/python -m pip install -q -c constraints.txt --no-build-isolation -e '.[dev]'
	@touch $@
