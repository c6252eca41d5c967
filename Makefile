# make setup     the environment, in .venv
# make demo      the main job on a sample clip
# make test      the test suite
# make check     style, types, import contract
# make assets    film the sample clips again
# make database  film the data set (7,600 clips, an hour) and train the shipped database of dynamic gestures on it
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
DONE   := $(VENV)/.installed

.PHONY: setup demo test check assets database clean

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

assets: $(DONE)
	$(BIN)/nao-sim film --samples --out assets/clips

database: $(DONE)
	$(BIN)/nao-sim film --out build/set --persons 60 --takes 4 --irrelevant 4000 --seed 21
	$(BIN)/nao-sim train build/set --out assets/databases/dynamic.parquet

clean:
	rm -rf $(VENV) demo build dist
