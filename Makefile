# make setup   the environment, in .venv
# make demo    the main job on a sample clip
# make test    the test suite
# make check   style, types, import contract
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
DONE   := $(VENV)/.installed

.PHONY: setup demo test check clean

setup: $(DONE)

$(DONE): pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade pip
	$(BIN)/python -m pip install --quiet --editable '.[dev]'
	touch $@

demo: $(DONE)
	$(BIN)/nao-sim imitate assets/clips/bye_right.avi --out demo

test: $(DONE)
	$(BIN)/python -m pytest -n 2 --dist loadscope

check: $(DONE)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

clean:
	rm -rf $(VENV) demo build dist
