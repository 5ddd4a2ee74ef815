# For a machine with Rust and, for long digits and the tests, a C compiler:
#   make demo         builds the command in pure Rust and solves a real scene in doubles; a minute or two
#   make demo-exact   the same scene in fractions
#   make test         runs all tests
#   make page         builds the page, one HTML file that opens from disk, and make page-test tries it in Chromium
#   make site         builds the site of docs/, with the page, the commands' help and the gallery in it
#   make docs         works out docs/guide anew
# GMP needs m4, and page-test Chromium; both are installed where they are missing. page-test and site need Node 20 with
# npm too.

CARGO ?= cargo
# What builds the command for the page's test and the site.
BUILD ?= build
# Random tests draw the same cases every time, so that one commit has one answer. `make explore` draws others.
export PROPTEST_RNG_SEED ?= 1878

.PHONY: help demo demo-exact test docs explore page page-test site site-test release m4 chromium

help:
	@echo "make demo         build the command in pure Rust and solve the bouncing bar of Doyen, Ern and Piperno"
	@echo "make demo-exact   the same in fractions"
	@echo "make test         run all tests, those of the documentation included"
	@echo "make page         build the page: target/page/dalembert.html, one file that opens from disk"
	@echo "make page-test    try the page in Chromium; needs Node 20 and npm"
	@echo "make site         build the site, target/site/index.html, opens from disk; needs Python 3.10 and Node 20 with npm"
	@echo "make release      binary, wheel, crate and page in target/dist, each tried; half an hour where nothing is built"
	@echo "make docs         write the outputs and pictures of docs/guide, and docs/benchmarks.md, anew"
	@echo "make explore      run the random tests on cases never tried before"

demo:
	@echo "building the command without the C libraries; a minute or two where nothing is built yet"
	$(CARGO) run --profile demo --package dalembert-cli --no-default-features -- solve doyen-ern-piperno
	@echo "make demo-exact solves the same scene in fractions"

demo-exact:
	$(CARGO) run --profile demo --package dalembert-cli --no-default-features -- solve doyen-ern-piperno --exact

test: m4
	$(CARGO) test --no-fail-fast

docs: m4
	REBUILD_GUIDE=1 $(CARGO) test --package dalembert-cli --test suite -- guide:: benchmarks::

explore: m4
	PROPTEST_RNG_SEED=$$(date +%s) $(CARGO) test --no-fail-fast --test suite -- properties first_contact_bounce
	PROPTEST_CASES=400 PROPTEST_RNG_SEED=$$(date +%s) $(CARGO) test --release --test suite -- same_value
	PROPTEST_RNG_SEED=$$(date +%s) $(CARGO) test --release --lib -- --ignored displaced
	PROPTEST_RNG_SEED=$$(date +%s) $(CARGO) test --release --test suite -- --ignored near_thresholds near_coincidences derivatives asked_times certified_damped any_scene t_400 chain_soft_random
	$(CARGO) test --release --package dalembert --features mp --lib -- --ignored number::wide number::pure
	$(CARGO) test --package dalembert-inner --no-default-features --features chain,long

WASM = wasm32-unknown-unknown
PACKED = --package dalembert-web --profile page --target $(WASM) --target-dir target/web

page:
	@rustc --print target-libdir --target $(WASM) | xargs test -d || rustup target add $(WASM)
	$(CARGO) build $(PACKED) --lib
	@mkdir -p target/page
	$(MAKE) --no-print-directory target/page/dalembert.html

target/page/dalembert.html: target/web/$(WASM)/page/dalembert_web.wasm $(wildcard web/page/* web/pack/src/*)
	$(CARGO) run --quiet --package pack -- $< web/page $@

page-test: page chromium web/test/node_modules
	$(CARGO) test --quiet --package pack
	$(CARGO) $(BUILD)
	cd web/test && node page.mjs

web/test/node_modules: web/test/package-lock.json
	cd web/test && npm ci --silent --no-fund && touch node_modules

# Every picture and table of the site is made here; a link that leads nowhere ends it.
site: page target/site-venv web/test/node_modules
	$(CARGO) $(BUILD)
	NO_MKDOCS_2_WARNING=1 target/site-venv/bin/mkdocs build --quiet --strict --config-file site/mkdocs.yml

site-test: site chromium web/test/node_modules
	cd web/test && node site.mjs

target/site-venv: site/requirements.txt
	python3 -m venv $@
	$@/bin/pip install --quiet --requirement $<
	@touch $@

release:
	bash .ci/release

# Debian and its kin; elsewhere the message says what is missing.
m4 chromium:
	@command -v $@ >/dev/null 2>&1 && exit 0; \
	missing="$@ is missing. Install it (Debian: apt-get install $@) and try again."; \
	command -v apt-get >/dev/null 2>&1 || { echo "$$missing" >&2; exit 1; }; \
	if [ "$$(id -u)" = 0 ]; then root=; \
	elif command -v sudo >/dev/null 2>&1; then root=sudo; \
	else echo "$$missing" >&2; echo "This account is not root and there is no sudo." >&2; exit 1; fi; \
	echo "installing $@"; install="$$root apt-get install -y --no-install-recommends $@"; \
	{ $$install || { $$root apt-get update && $$install; }; } >&2 \
	&& command -v $@ >/dev/null 2>&1 || { echo "$$missing" >&2; exit 1; }
