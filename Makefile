# Everything a developer or a CI machine runs. `make test` needs python3 (3.9 to 3.13), a C compiler
# (one dependency of OctoPrint 1.11 comes as source), Debian's chromium for the browser tests, mosquitto
# for those of MQTT, nginx, haproxy and caddy for those of reverse proxies.

PYTHON ?= python3
PYTHON39 ?= python3.9
# workers by OctoPrint: there are three times as many tests end to end in 2.0
JOBS_1.11 ?= 4
JOBS_2.0 ?= 7
DEMO_OCTOPRINT ?= 2.0
PYTEST_ARGS ?=
MINUTES ?= 10
SECONDS ?= 280
BRANCHES ?= 95
FUZZ_ARGS ?=
ENDURANCE_ARGS ?=

VENV_1.11 := .venv/octoprint-1.11
VENV_2.0 := .venv/octoprint-2.0
READY := .venv/octoprint-1.11/.ready .venv/octoprint-2.0/.ready
PLAIN := .venv/octoprint-1.11-plain/.ready .venv/octoprint-2.0-plain/.ready

# what needs no OctoPrint runs once, in the first environment
PURE := tests/rrf tests/simulator tests/docs tests/test_layering.py

# the tests mostly wait for servers, so that more of them than cores run side by side; what takes
# long begins first, which tests/conftest.py sees to
PYTEST := -m pytest --dist loadgroup --no-loadscope-reorder $(PYTEST_ARGS)

export PIP_DISABLE_PIP_VERSION_CHECK := 1
export PIP_NO_INPUT := 1
# each worker and each server would compile all it imports
export PYTHONDONTWRITEBYTECODE :=

.DELETE_ON_ERROR:
.PHONY: help test test-1.11 test-2.0 test-pure-py39 lint lint-page format coverage dist bench fuzz endurance endurance-network silence demo docs reference translations environments clean

help:
	@echo "make test           lint and the tests in OctoPrint 1.11 and 2.0, side by side"
	@echo "make test-1.11      the tests in OctoPrint 1.11; test-2.0 likewise"
	@echo "make test-pure-py39 the tests that need no OctoPrint, in Python 3.9 (PYTHON39=...)"
	@echo "make lint           ruff, mypy, the floors, spelling, templates, scripts and styles (those with Node);"
	@echo "                    make format puts files in shape"
	@echo "make coverage       how much of octoprint_rrfmodel/rrf its own tests reach; 95 % of branches at least"
	@echo "make dist           source distribution and wheel, in dist/"
	@echo "make bench          the measurements in tests/bench"
	@echo "make fuzz           inputs by chance and by coverage to all that takes any; MINUTES=10"
	@echo "make endurance      prints, faults and visitors of a simulated week, in both OctoPrints; MINUTES=30"
	@echo "make silence        commands that the board is silent for, with OctoPrint's own timeouts; SECONDS=280"
	@echo "make endurance-network  the same with a board on the network, in OctoPrint 2.0; MINUTES=10"
	@echo "make demo           an OctoPrint with a simulated printer; DEMO_OCTOPRINT=1.11, DEMO_PORT=5000,"
	@echo "                    DEMO_MACHINE=toolchanger, DEMO_FIRMWARE=3.6.1, DEMO_LINK=network (OctoPrint 2.0)"
	@echo "make docs           the site of docs/ into build/site; make reference writes its pages of tables anew"
	@echo "make translations   refresh messages.pot and the catalogues"
	@echo "make clean          remove environments and what tools left behind"

# Environments. The plain ones hold OctoPrint and nothing else: test_package installs into a copy of
# them what a user would install. They are made anew when what they should hold changes.

.venv/octoprint-%-plain/.ready: requirements/octoprint-%.txt
	@echo "installing OctoPrint $* alone into $(@D)"
	@rm -rf $(@D)
	@$(PYTHON) -m venv $(@D)
	@$(@D)/bin/python -m pip install -qq --requirement $<
	@touch $@

.venv/octoprint-%/.installed: requirements/octoprint-%.txt requirements/dev.txt requirements/clients.txt
	@echo "installing OctoPrint $* and the test tools into $(@D)"
	@rm -rf $(@D)
	@$(PYTHON) -m venv $(@D)
	@$(@D)/bin/python -m pip install -qq $(^:%=--requirement=%)
	@touch $@

# metadata and entry points are copied at installation, all else is read from the work tree
.venv/octoprint-%/.ready: .venv/octoprint-%/.installed pyproject.toml
	@$(@D)/bin/python -m pip install -qq --no-deps --editable .
	@touch $@

.PRECIOUS: .venv/octoprint-%/.installed

# Programs that talk to boards, each with what it brings, for a test of the simulated board that says
# which of them it couldn't have; the vendor's needs Node
CLIENTS := .venv/network-clients

$(CLIENTS)/.ready: requirements/network-clients.txt tests/clients/package.json
	@echo "installing programs that talk to boards into $(@D)"
	@rm -rf $(@D)
	@$(PYTHON) -m venv $(@D)
	@$(@D)/bin/python -m pip install -qq --requirement $< || echo "those for Python can't be had"
	@cp tests/clients/package.json $(@D)
	@if command -v npm >/dev/null; then \
		npm install --prefix $(@D) --no-package-lock --no-audit --no-fund --silent \
			|| echo "those for Node can't be had"; \
	fi
	@touch $@

# what builds the site of docs/
DOCS := .venv/docs

$(DOCS)/.ready: requirements/docs.txt
	@echo "installing what builds the documentation into $(@D)"
	@rm -rf $(@D)
	@$(PYTHON) -m venv $(@D)
	@$(@D)/bin/python -m pip install -qq --requirement $<
	@touch $@

# What looks through the page's scripts and styles, where Node is there

PAGE_LINT := .venv/page-lint
STATIC := octoprint_rrfmodel/static

$(PAGE_LINT)/.ready: tools/package.json
	@mkdir -p $(@D)
	@cp $< $(@D)
	@if ! command -v npm >/dev/null; then \
		echo "no npm: scripts and styles of the page are not looked through"; \
	elif npm install --prefix $(@D) --no-package-lock --no-audit --no-fund --silent --fetch-retries=1; then \
		touch $@; \
	else \
		echo "ESLint and Prettier can't be had: scripts and styles of the page are not looked through"; \
	fi

environments: $(READY) $(PLAIN) $(CLIENTS)/.ready $(DOCS)/.ready $(PAGE_LINT)/.ready
	@:

# Tests

test:
	@$(MAKE) --no-print-directory --jobs=2 environments
	@echo "lint and the tests in both OctoPrints, each told as it ends"
	@$(MAKE) --no-print-directory --keep-going --jobs=3 --output-sync=target lint test-1.11 test-2.0

test-1.11: .venv/octoprint-1.11/.ready .venv/octoprint-1.11-plain/.ready
	@echo "tests in OctoPrint 1.11"
	@$(VENV_1.11)/bin/python $(PYTEST) -n $(JOBS_1.11)

test-2.0: .venv/octoprint-2.0/.ready .venv/octoprint-2.0-plain/.ready
	@echo "tests in OctoPrint 2.0"
	@$(VENV_2.0)/bin/python $(PYTEST) -n $(JOBS_2.0) $(PURE:%=--ignore=%)

test-pure-py39: .venv/python-3.9/.ready
	@.venv/python-3.9/bin/python $(PYTEST) -n $(JOBS_1.11) $(PURE)

.venv/python-3.9/.ready: requirements/dev.txt
	@rm -rf $(@D)
	@$(PYTHON39) -m venv $(@D)
	@$(@D)/bin/python -m pip install -qq --requirement $<
	@touch $@

lint: .venv/octoprint-1.11/.ready $(PAGE_LINT)/.ready
	@status=0; \
	for check in "python -m ruff check --quiet" "python -m ruff format --check --quiet" \
		"python -m mypy" "lint-imports" "codespell"; do \
		$(VENV_1.11)/bin/$$check || { echo "lint: $$check failed"; status=1; }; \
	done; \
	found=$$($(VENV_1.11)/bin/djlint --lint octoprint_rrfmodel/templates 2>/dev/null) \
		|| { echo "$$found"; echo "lint: djlint failed"; status=1; }; \
	$(MAKE) --no-print-directory lint-page || status=1; \
	exit $$status

lint-page: $(PAGE_LINT)/.ready
	@status=0; \
	if [ -e $< ]; then \
		$(PAGE_LINT)/node_modules/.bin/eslint --config tools/eslint.config.mjs $(STATIC) \
			|| { echo "lint: eslint failed"; status=1; }; \
		$(PAGE_LINT)/node_modules/.bin/prettier --check --log-level=warn "$(STATIC)/**/*.{js,css}" tools \
			|| { echo "lint: prettier failed, make format puts it right"; status=1; }; \
	fi; \
	exit $$status

format: .venv/octoprint-1.11/.ready $(PAGE_LINT)/.ready
	@$(VENV_1.11)/bin/python -m ruff check --quiet --fix
	@$(VENV_1.11)/bin/python -m ruff format
	@if [ -e $(PAGE_LINT)/.ready ]; then \
		$(PAGE_LINT)/node_modules/.bin/prettier --write --log-level=warn "$(STATIC)/**/*.{js,css}" tools; \
	fi

# The pure half by its own tests alone; five minutes, so that it is no part of make test
coverage: .venv/octoprint-1.11/.ready
	@mkdir -p .artifacts
	@$(VENV_1.11)/bin/python -m coverage run -m pytest -q -n 0 tests/rrf
	@$(VENV_1.11)/bin/python -m coverage report
	@$(VENV_1.11)/bin/python -m coverage json --quiet -o .artifacts/coverage.json
	@$(VENV_1.11)/bin/python tools/branches.py .artifacts/coverage.json $(BRANCHES)

dist: .venv/octoprint-2.0/.ready
	@$(VENV_2.0)/bin/python -m build --outdir dist .

bench: .venv/octoprint-2.0/.ready
	@$(VENV_2.0)/bin/python -m tests.bench

# Atheris is for this alone, so that nothing else waits for its installation
$(VENV_2.0)/.fuzz: requirements/fuzz.txt $(VENV_2.0)/.ready
	@$(VENV_2.0)/bin/python -m pip install -qq --requirement $<
	@touch $@

fuzz: $(VENV_2.0)/.fuzz
	@$(VENV_2.0)/bin/python -m tests.fuzz --minutes $(MINUTES) $(FUZZ_ARGS)

endurance: $(READY)
	@$(VENV_2.0)/bin/python -m tests.endurance --minutes $(MINUTES) \
		$(if $(SEED),--seed $(SEED)) $(if $(HOST),--host $(HOST)) $(ENDURANCE_ARGS)

# three of it: one that OctoPrint doesn't know as long, one that it knows, one in a print
silence: $(READY)
	@for venv in $(VENV_1.11) $(VENV_2.0); do \
		RRF_SILENCE=$(SECONDS) $$venv/bin/python -m pytest -n 3 tests/e2e/line/test_silence.py -k silent_command || exit 1; \
	done

endurance-network: .venv/octoprint-2.0/.ready
	@$(VENV_2.0)/bin/python -m tests.endurance.network --minutes $(MINUTES) \
		$(if $(SEED),--seed $(SEED)) $(ENDURANCE_ARGS)

demo: .venv/octoprint-$(DEMO_OCTOPRINT)/.ready
	@exec .venv/octoprint-$(DEMO_OCTOPRINT)/bin/python -m extras.demo

# Documentation. The theme warns of a MkDocs that isn't the one that is pinned.

docs: $(DOCS)/.ready
	@NO_MKDOCS_2_WARNING=1 $(DOCS)/bin/mkdocs build --strict
	@echo "read it: build/site/index.html"

reference: .venv/octoprint-2.0/.ready
	@$(VENV_2.0)/bin/python -m extras.site.reference

# Translations. Sources lie in translations/, OctoPrint reads the copy inside the package.

BABEL := $(VENV_2.0)/bin/python -m babel.messages.frontend
LANGUAGES := $(notdir $(patsubst %/LC_MESSAGES/messages.po,%,$(wildcard translations/*/LC_MESSAGES/messages.po)))

translations: .venv/octoprint-2.0/.ready
	@$(BABEL) --quiet extract --mapping-file=babel.cfg --keyword=N_ --output-file=translations/messages.pot \
		--project=OctoPrint-RRFModel --copyright-holder="OctoPrint-RRFModel developers" \
		--no-location --sort-output .
	@for language in $(LANGUAGES); do \
		$(BABEL) --quiet update --no-fuzzy-matching --input-file=translations/messages.pot \
			--output-dir=translations --locale=$$language && \
		$(BABEL) --quiet compile --directory=translations --locale=$$language && \
		mkdir -p octoprint_rrfmodel/translations/$$language/LC_MESSAGES && \
		cp translations/$$language/LC_MESSAGES/messages.* \
			octoprint_rrfmodel/translations/$$language/LC_MESSAGES/ || exit 1; \
	done

clean:
	rm -rf .venv .demo .artifacts .hypothesis .mypy_cache .pytest_cache .ruff_cache build dist
	rm -rf *.egg-info
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
