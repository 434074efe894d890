# Each target makes what it needs. Python 3.11 or newer, git and make are enough.
#   make demo    a speaking head, and the files that come with it, in demo/
#   make test    formatting, lint, types, the client's tests, tests and doctests
#   make check   formatting, lint and types only
#   make bench   measures: speed, memory and quality, as one JSON object

SHELL := /bin/sh
PYTHON := $(shell for p in python3.11 python3.12 python3.13 python3.14 python3 python; do \
	$$p -c 'import sys; raise SystemExit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
BIN := .venv/bin
READY := .venv/ready
LINE := Peter Piper picked a peck of pickled peppers.

.PHONY: demo test check bench install chromium client clean

install: $(READY)

$(READY): pyproject.toml constraints.txt
	@test -n "$(PYTHON)" || { echo "Python 3.11 or newer is needed: see python.org"; exit 1; }
	@test -x $(BIN)/python || $(PYTHON) -m venv .venv || { \
		echo "no virtual environment could be made; on Debian type: apt-get install python3-venv"; exit 1; }
	PIP_CONSTRAINT=constraints.txt $(BIN)/python -m pip install --quiet -e '.[tts,av,dev]'
	@touch $(READY)

client: $(READY)
	@$(BIN)/python hatch_build.py

demo: $(READY) client
	@mkdir -p demo
	@$(BIN)/lipwright say "$(LINE)" -o demo/peter.html -o demo/peter.json -o demo/peter.csv \
		-o demo/peter.glb -o demo/peter.wav
	@echo "Open demo/peter.html in a browser: it needs no server."

check: $(READY)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

test: check client chromium
	$(BIN)/python hatch_build.py test
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -n auto

chromium:
	@sh tools/need_chromium.sh

bench: $(READY) client
	@$(BIN)/python -m bench

clean:
	rm -rf .venv demo web/node_modules web/dist web/dist-studio src/lipwright/export/player.html \
		src/lipwright/studio/page
