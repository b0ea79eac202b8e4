# SPDX-License-Identifier: MIT
# Builds go to build/, results to out/. `make help` lists the commands.

BOARD ?= versatilepb
FRAMES ?= 600
OPT ?= -O2
# Nobody looks at variables in CI. The lines of a failure are enough, and take less time to compile.
DEBUG_INFO ?= $(if $(CI),-g1,-g)
LABEL ?= $(if $(PAPER),paper)
DEBUG ?=
PAPER ?=
# 1: instrumented for libFuzzer
FUZZ ?=
# 1: the engine is the two source files of `make amalgamation`
JOINED ?=
# 1: the engine counts what runs, for `make coverage`
COVERED ?=

# of `make bench`, `make fixtures` and `make faults`, before the board sets its scenes
BENCH_SCENES := $(SCENES)
# of `make view`: the X server, before the board sets its display
X_DISPLAY := $(if $(filter environment,$(origin DISPLAY)),$(DISPLAY))
BOARDS := $(patsubst port/%/board.mk,%,$(wildcard port/*/board.mk))
# boards that have scenes to show
SHOWN := $(patsubst port/%/board.mk,%,$(sort $(shell grep -l '^SCENES' port/*/board.mk)))
# a board that was asked for, not the default one
ASKED := $(if $(filter command environment,$(origin BOARD)),$(BOARD))
ifeq ($(filter $(BOARD),$(BOARDS)),)
$(error BOARD=$(BOARD) is none of: $(BOARDS))
endif
include port/$(BOARD)/board.mk
ifdef FAMILY
include port/$(FAMILY)/family.mk
endif
# the default scene of the board
SCENE ?= $(if $(MESH),user,$(firstword $(subst :, ,$(SCENES)) head))

# scenes with joints and moving parts, and those that the board has in ROM
GAME_SCENES := door chain crusher conveyor car walker lockstep gears screw \
    newton dominoes cards arch bowl pour espresso espresso-fine
ROM_GAMES := $(filter $(GAME_SCENES),$(ROM_SCENES))

# ---------------------------------------------------------------- tools, flags

B := build/$(BOARD)$(if $(DEBUG),-debug)$(if $(FUZZ),-fuzz)$(if $(JOINED),-joined)$(if $(COVERED),-covered)
TARGET_CC := $(or $(COMPILER),$(if $(CROSS),$(CROSS)gcc,$(CC)))
TARGET_AR := $(CROSS)ar
WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Werror
comma := ,
space := $(subst ,, )
SANITIZE := $(if $(DEBUG),$(if $(CROSS),,-fsanitize=address$(comma)undefined$(if $(FUZZ),$(comma)fuzzer-no-link -fno-sanitize-coverage=trace-cmp,$(if $(findstring clang,$(TARGET_CC)),,$(comma)bounds-strict)) -fno-sanitize-recover))
CFLAGS := -std=c11 $(OPT) $(DEBUG_INFO) $(WARNINGS) $(ARCH) $(SANITIZE) -ffunction-sections -fdata-sections \
          -Iinclude -Isrc -Iport -Iport/bare $(if $(FAMILY),-Iport/$(FAMILY)) $(FAMILY_CFLAGS) -Iexamples \
          $(if $(DEBUG),-DCAROM_DEBUG) $(if $(ICOUNT_SHIFT),-DPORT_ICOUNT_SHIFT=$(ICOUNT_SHIFT)) \
          $(if $(ROM_SCENES),-DSCENE_ROM -DBOARD_SCENE=$(or $(START),$(firstword $(ROM_SCENES))) -I$(B)/gen) \
          $(if $(ROM_GAMES),-DSCENE_ROM_GAMES -DBOARD_GAME_CAPS=$(GAME_CAPS)) \
          $(if $(CAPS),-DBOARD_CAPS=$(CAPS)) $(if $(DRAW_BYTES),-DBOARD_DRAW_BYTES=$(DRAW_BYTES)) \
          $(if $(SHADOWS),-DBOARD_SHADOWS) $(if $(SMOOTH),-DBOARD_SMOOTH) \
          $(if $(CYCLES),-DBOARD_UNIT=cycles) $(if $(LINE_BYTES),-DBOARD_LINE_BYTES=$(LINE_BYTES)) \
          $(if $(CLOCK_MHZ),-DPORT_CLOCK_MHZ=$(CLOCK_MHZ))
COUNTERS := $(if $(COVERED),-fprofile-instr-generate)
LDFLAGS := $(ARCH) $(SANITIZE) $(COUNTERS) -Wl,--gc-sections
JOINED_SOURCES := build/amalgamation/carom.c build/amalgamation/carom_draw.c
PAPER_LINK := -Wl,--wrap=interfere_leaves -Wl,--wrap=interfere_note_faces
ENGINE_SOURCES := $(if $(JOINED),$(JOINED_SOURCES),$(wildcard src/*/*.c))
ifneq ($(PAPER),)
# The paper's interference detection in place of ours; its z-list buffer leaves less memory for a mesh.
ENGINE_SOURCES += $(wildcard tests/paper/*.c)
CFLAGS += -DUSER_VERTICES=4000 -DBENCH_MESH_BYTES=3000000 -DBENCH_DRAW_BYTES=131072
LDFLAGS += $(PAPER_LINK)
endif
LDFLAGS += $(FAMILY_LDFLAGS)
# a board without an operating system
ifneq ($(if $(HOSTED),,$(CROSS)),)
LDFLAGS += -Wl,-z,noexecstack -nostartfiles -Lport/$(BOARD) -Llinker -T$(BOARD).ld
LINKER_FILES := linker/$(BOARD).ld linker/sections.ld $(wildcard linker/hot*.ld) \
    $(firstword $(wildcard port/$(BOARD)/fast.ld) linker/fast.ld)
endif

# ---------------------------------------------------------------------- files

objects = $(addprefix $(B)/,$(addsuffix .o,$(basename $(1))))
ENGINE := $(call objects,$(ENGINE_SOURCES))
SUPPORT := $(call objects,$(PORT) port/option.c port/print.c port/assert.c) $(LINKER_FILES)
# the null port proves that port.h can be implemented; nothing links it
ALSO := $(call objects,port/null/null.c)
# examples are for the host; head is for every board
EXAMPLES := $(if $(CROSS),examples/head.c,$(filter-out examples/scene% examples/show% examples/view%,$(wildcard examples/*.c)))
PROGRAMS := $(EXAMPLES:examples/%.c=$(B)/%.elf)
# generated meshes, by number of faces; without a number, that of the paper
HEADS := head head48 head80 head100 head450 head836
FIELDS := field field128 field386 field512 field12012 field49928
# parts of games' scenes; a program links those that it names
SHAPES := character wheel car door link ramp steps jump tower mat rink puck yard gear10 gear24 gear16 gear12 board bolt nut hexagon \
    domino pendulum beam post card cover stone plinth bowl cup \
    ring star hook beaker bucket tray
# figure 8: meshes, and the colours of their faces
FIGURE8 := espresso mandelbrot512 mandelbrot3200
# the programs of these scenes
GAMES := $(filter-out $(patsubst %,examples/scene_%.c,sheet built rom play look),$(wildcard examples/scene_*.c))
# the scenes, whose meshes are indexed when a scene is loaded
SCENES_BUILT := $(call objects,examples/scene.c examples/scene_look.c examples/scene_sheet.c examples/scene_built.c \
    $(GAMES) $(patsubst %,build/gen/%_mesh.c,$(HEADS) $(FIELDS) $(SHAPES) $(FIGURE8)) \
    $(FIGURE8:%=build/gen/%_ramps.c))
# or, on a board with ROM_SCENES, indexed in ROM
SCENES_IN_ROM := $(call objects,examples/scene.c examples/scene_look.c examples/scene_sheet.c examples/scene_rom.c \
    $(if $(ROM_GAMES),$(GAMES) $(FIGURE8:%=build/gen/%_ramps.c)) $(ROM_SCENES:%=build/gen/rom/%.c))
SCENE_FILES := $(if $(ROM_SCENES),$(SCENES_IN_ROM),$(SCENES_BUILT))
# A board runs the suites for which it has room, in one image or in one each
SUITES ?= $(patsubst tests/test_%.c,%,$(wildcard tests/test_*.c))
TEST_IMAGES := $(if $(SUITE_IMAGES),$(SUITES:%=$(B)/suite_%.elf),$(B)/tests.elf)
# the board of all suites, one image each: together their arrays exceed its RAM
CORTEX_TESTS := $(patsubst tests/test_%.c,build/mps2-an385/suite_%.elf,$(wildcard tests/test_*.c))
# programs of their own, and what the tests share
HOST_TESTS := $(patsubst tests/%.c,build/host/%.elf,$(wildcard tests/host_*.c))
ACCURACY := $(patsubst tests/%.c,build/host/%.elf,$(wildcard tests/accuracy_*.c))
TEST_TOOLS := $(call objects,$(wildcard tests/lib/*.c))
# the page, if the viewer is there
PAGE := $(if $(wildcard examples/view.c),out/web/index.html)
# the window of `make view`, the one program that needs SDL2
WINDOW := build/host/window.elf
SCRIPT_TESTS := $(wildcard tests/*.sh tests/test_*.py $(if $(PAGE),tests/test_*.mjs))

# ------------------------------------------------------------------- commands

export PYTHONDONTWRITEBYTECODE := 1
# no built-in rules
MAKEFLAGS += -r

# V=1 shows the commands themselves.
ifndef V
MAKEFLAGS += -s --no-print-directory
endif

# A sub-make knows the board. It has two jobs unless it gets a number.
SUBMAKE = $(MAKE) $(if $(findstring jobserver,$(MAKEFLAGS)),,-j2)
NEED_MESHES := python3 c++ assimp meshopt png
NEED_HOST := cc libc png
NEED_BOARD := arm newlib qemu-arm
# Build boards one after another for a command. A board whose tools cannot be installed is left out, except in CI. A board that cannot be
# built fails the command after the others are done.
build_boards = ready= broken=; for board in $(1); do \
    if ! $(MAKE) BOARD=$$board need; then echo "$$board is left out: its tools are not there"; \
        [ -z "$$CI" ] || broken="$$broken $$board"; \
    elif $(SUBMAKE) BOARD=$$board build; then ready="$$ready $$board"; \
    else broken="$$broken $$board"; fi; done
all_built = if [ "$$broken" ]; then echo "cannot be built:$$broken"; false; fi
NEED_THIS := $(or $(NEED),$(NEED_HOST))
NEED_COMPARE := ode bullet fcl valgrind
NEED_WASM := clang lld node npm

# Scenes of the comparison: what moves, what stands still.
mesh_pair = $(1)=build/gen/$(2).crm,build/gen/$(3).crm
COMPARE_SCENES := $(call mesh_pair,head,head,field) \
                  $(call mesh_pair,head450,head450,field386) \
                  $(call mesh_pair,head836,head836,field512)
COMPARE_WASM := build/tools/heap.wasm
COMPARE_MESHES := $(filter %.crm,$(subst $(comma), ,$(subst =, ,$(COMPARE_SCENES))))

.PHONY: help docs run view web scenes test budget accuracy costs special oracle fixtures physics proof contracts analysis faults worst soak meshes mutants coverage fuzz bytes snapshots bench matrix replay figures zlists pictures compare check size boards packages amalgamation five commands build need clean force

help: ## list these commands
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/\1|\2/p' Makefile | \
	    while IFS='|' read -r name text; do printf '  make %-8s %s\n' "$$name" "$$text"; done
	@echo '  BOARD is one of: $(SHOWN)'

run: ## run a scene on a board; BOARD= SCENE=head|box|pile|sheet|car|walker|door|chain|crusher|conveyor|... FRAMES=600 MESH=file AWAKE=1 FRAMES_PNG=0|1 PRESS=N:KEYS,... PAPER=1
	@tools/need $(NEED_MESHES) $(NEED_THIS) pil
	@$(SUBMAKE) $(B)/head.elf $(RUNNER) $(if $(MESH),build/tools/carom-mesh)
	@$(if $(MESH),build/tools/carom-mesh $(MESH_FLAGS) -b build/gen/user.crm '$(MESH)')
	@tools/run_scene.py --board $(BOARD) --scene $(SCENE) --frames $(FRAMES) --out out/$(SCENE) \
	    --pictures $(or $(FRAMES_PNG),$(PICTURES),0) $(B)/head.elf \
	    $(if $(MESH),mesh=build/gen/user.crm) $(if $(AWAKE),awake=1) $(if $(PRESS),press=$(PRESS))

view: ## a scene in a window, by SDL2: turn, pause, step, grab bodies, H for help; SCENE=head|car|... MESH=file LINK=text
	@tools/need $(NEED_MESHES) $(NEED_HOST) sdl2
	@$(SUBMAKE) BOARD=host $(WINDOW) $(if $(MESH),build/tools/carom-mesh)
	@$(if $(MESH),build/tools/carom-mesh $(MESH_FLAGS) -b build/gen/user.crm '$(MESH)')
	@DISPLAY='$(X_DISPLAY)' $(WINDOW) scene='$(SCENE)' $(if $(MESH),mesh=build/gen/user.crm) $(if $(LINK),link='$(LINK)')

web: ## one web page with the engine in it, out/web/index.html: scenes, your own meshes, links
	@tools/need $(NEED_MESHES) $(NEED_HOST) clang lld llvm
	@$(if $(PAGE),,echo 'examples/view.c is not there: the page needs it'; false)
	@$(SUBMAKE) BOARD=wasm $(PAGE)

scenes: ## list the scenes, with thumbnails in out/scenes/index.html and out/scenes/scenes.png
	@tools/need $(NEED_MESHES) $(NEED_HOST) pil
	@$(SUBMAKE) BOARD=host build/host/head.elf >/dev/null
	@tools/scene_sheet.py build/host/head.elf out/scenes

# with sanitizers and assertions
DEBUG_TESTS := $(patsubst %,build/host-debug/%.elf,tests host_fuzz host_replay host_inputs host_errors host_soak)

ifneq ($(ASKED),)
test: need
	@$(SUBMAKE) BOARD=host build
	@$(SUBMAKE) BOARD=$(BOARD) build $(TEST_IMAGES)
	@tools/run_tests.py --select '$(TEST)' --frames $(FRAMES) --seconds 1800 --boards '$(BOARD)' $(TEST_IMAGES)
else
test: ## run every test, here and on a board, and a scene on every board; BOARD= all of one; TEST= part of a name
	@tools/need $(NEED_MESHES) $(NEED_HOST) $(NEED_BOARD) clang lld llvm node m68k-linux-gnu qemu-user pil npm chromium \
	    sdl2 xvfb xdotool
	@tools/need npm:tools/web
	@$(SUBMAKE) BOARD=host build/host/tests.elf build/host/zlists.elf $(HOST_TESTS) $(ACCURACY) $(WINDOW) build/tools/carom-mesh
	@$(SUBMAKE) BOARD=host DEBUG=1 $(DEBUG_TESTS)
	@$(SUBMAKE) BOARD=mps2-an385 $(CORTEX_TESTS)
	@$(if $(PAGE),$(SUBMAKE) BOARD=wasm $(PAGE))
	@$(call build_boards,$(SHOWN)); \
	    tools/run_tests.py --select '$(TEST)' --frames 120 --first --boards "$$ready" \
	    $(HOST_TESTS) $(SCRIPT_TESTS) \
	    build/host/tests.elf $(DEBUG_TESTS) $(CORTEX_TESTS) \
	    && $(all_built)
endif

budget: ## measure the worst frame of every scene of a board against its budget, to out/budget.csv; BOARD= of one
	@$(call build_boards,$(or $(ASKED),$(SHOWN))); \
	    tools/budget.py $(if $(ASKED),--keep) --frames $(FRAMES) $$ready && $(all_built)

accuracy: ## compare the integer kernels with independent oracles, to out/accuracy.csv and docs/measured.md
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host $(ACCURACY)
	@mkdir -p out
	@echo 'kernel,cases,p50,p999,p9999,max,failures,bars' | tee out/accuracy.csv
	@status=0; for program in $(ACCURACY); do \
	    $$program >out/accuracy.part || status=1; tee -a out/accuracy.csv <out/accuracy.part; \
	done; rm -f out/accuracy.part; tools/measured.py kernels; exit $$status

COSTS := $(patsubst %,build/mps2-an385/suite_%.elf,boyse_cost num_gauss_cost query_cost query_rays_cost)
costs: ## count the instructions of kernels and queries on a Cortex-M3, to docs/measured.md
	@tools/need $(NEED_MESHES) $(NEED_BOARD)
	@$(SUBMAKE) BOARD=mps2-an385 $(COSTS)
	@tools/measured.py costs $(COSTS)

special: ## let features of 100,000 pairs of bodies meet in special positions, to docs/measured.md
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/host_special.elf
	@tools/measured.py special build/host/host_special.elf

oracle: ## compare first hits of 10,000 motions with a test of every pair of features, to out/oracle.csv and docs/measured.md
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/host_first_hit.elf
	@mkdir -p out
	@status=0; build/host/host_first_hit.elf all >out/oracle.csv || status=1; \
	    cat out/oracle.csv; tools/measured.py hits; exit $$status

fixtures: ## run published and special scenes: do they hold, stand, turn? To out/fixtures.csv and docs/fixtures.md; SCENES=
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/host_fixtures.elf
	@tools/fixtures.py build/host/host_fixtures.elf $(BENCH_SCENES)

physics: ## compare motions with closed forms and published figures, to out/physics.csv and docs/physics.md
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/host_physics.elf
	@tools/physics.py build/host/host_physics.elf

faults: ## run scenes with each pool at sizes from 0 to its peak: every call that meets a full one changes nothing; SCENES=
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/host_faults.elf build/host/host_errors.elf
	@tools/faults.py build/host/host_faults.elf build/host/host_errors.elf $(BENCH_SCENES)

TRIES ?= 5000
worst: ## look for the dearest step by hill climbing, and compare its counts with the bounds of SPEC.md; TRIES=5000
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/host_worst.elf
	@tools/worst.py build/host/host_worst.elf $(TRIES)

N ?= 5000
SEED ?= 1
soak: ## run random worlds under an independent checker, to out/soak.csv and docs/soak.md; N=5000 SEED=1 RECORD=1
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/host_soak.elf
	@tools/soak.py build/host/host_soak.elf --first $(SEED) --count $(N) \
	    $(if $(filter 5000-1,$(N)-$(SEED)),--docs) $(if $(RECORD),--record)

proof: ## prove the programs of tests/proof for all inputs, to out/proof.csv and docs/evidence.md; NAMES= SHORT=1
	@tools/need python3 z3 cvc5 clang-19 cc libc
	@tools/proof.py $(if $(SHORT),--short) $(NAMES)

contracts: ## prove the contracts of tests/contracts by Frama-C, and run parts of gauss in Eva, to docs/evidence.md; NAMES= SHORT=1
	@tools/need python3 cc frama-c
	@tools/contracts.py $(if $(SHORT),--short) $(NAMES)

analysis: ## gcc -fanalyzer, clang-tidy, cppcheck with MISRA, the newest compilers; to docs/evidence.md with RECORD=1
	@tools/analysis.py $(if $(RECORD),--record)

SECONDS ?= 60
fuzz: ## libFuzzer over calls, questions, pictures, snapshots, recordings, meshes, with sanitizers; SECONDS=60 in all or N= runs each, TARGETS=calls,draw RECORD=1
	@tools/need $(NEED_MESHES) $(NEED_HOST) clang llvm
	@$(SUBMAKE) BOARD=host DEBUG=1 FUZZ=1 COMPILER=clang build/host-debug-fuzz/fuzz.elf
	@tools/fuzz.py build/host-debug-fuzz/fuzz.elf --seconds $(SECONDS) $(if $(filter command environment,$(origin N)),--runs $(N)) \
	    $(if $(TARGETS),--targets $(TARGETS)) $(if $(RECORD),--record)

RANDOM ?= 20000
bytes: ## change each byte of snapshots, recordings and blobs, and RANDOM=20000 numbers of each, check sums corrected, to docs/evidence.md; SEED= WORLDS=0,1
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/host_bytes.elf build/host/host_replay.elf
	@tools/bytes.py --random $(RANDOM) --seed $(SEED) $(if $(filter 1,$(SEED)),,--only-random) $(if $(WORLDS),--worlds $(WORLDS))

snapshots: ## save and load after each of FRAMES=600 frames of the matrix's scenes, to docs/evidence.md with RECORD=1; BIG=1: on m68k, too
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/matrix.elf
	@tools/snapshots.py build/host/matrix.elf --frames $(FRAMES) $(if $(BIG),--big) $(if $(RECORD),--record)

COVERAGE := $(patsubst build/host/%,build/host-covered/%,build/host/tests.elf $(HOST_TESTS))
coverage: ## lines, branches and MC/DC of src/ that the host tests run, to out/coverage; SHORT=1
	@tools/need $(NEED_MESHES) $(NEED_HOST) clang-19
	@$(SUBMAKE) BOARD=host COVERED=1 $(COVERAGE)
	@tools/coverage.py $(if $(SHORT),--short) $(COVERAGE)

meshes: ## give carom-mesh hostile files: each ends in a named error or a right mesh; N= FIRST= RECORD=1
	@tools/need $(NEED_MESHES)
	@$(SUBMAKE) BOARD=host build/tools/carom-mesh
	@tools/hostile_meshes.py build/tools/carom-mesh --first $(or $(FIRST),1) --count $(N) $(if $(RECORD),--record)

mutants: ## change the engine in one place at a time: do the tests notice? To out/mutants.csv and docs/evidence.md; MUTANTS=500 MOST= SEED= FILES= AGAIN=1 RECORD=1
	@tools/need $(NEED_MESHES) $(NEED_HOST) clang-19
	@tools/mutants.py --count $(or $(MUTANTS),500) $(if $(MOST),--most $(MOST)) --seed $(SEED) --files '$(FILES)' $(if $(AGAIN),--again) $(if $(RECORD),--record)

bench: ## count instructions by stage on a Cortex-M3, to out/bench.csv; SCENES= BASELINE=1 GATE=1 PAPER=1
	@tools/need $(NEED_MESHES) $(NEED_HOST) $(NEED_BOARD)
	@$(SUBMAKE) BOARD=host build/host/bench.elf
	@$(SUBMAKE) BOARD=mps2-an385 OPT=-O2 build/mps2-an385/bench.elf
	@tools/bench.py build/host/bench.elf build/mps2-an385/bench.elf --label '$(LABEL)' \
	    --scenes '$(BENCH_SCENES)' $(if $(BASELINE),--baseline) $(if $(GATE),--gate)

matrix: ## compare state hashes of every instruction set, compiler and option, to docs/matrix.md; TARGETS=armel,sh4 MISSING=1 SHORT=1
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/matrix.elf
	@tools/matrix.py $(if $(SHORT),--short) $(if $(TARGETS),--targets $(TARGETS)) $(if $(MISSING),--missing)

replay: need ## play a recording here and on BOARD=; FILE=; AGAINST= compares it with another, call by call (docs/replay.md)
	@test -n '$(FILE)' || { echo 'FILE= names the recording'; false; }
	@$(SUBMAKE) BOARD=host build/host/replay.elf
	@$(if $(filter-out host,$(ASKED)),$(SUBMAKE) BOARD=$(BOARD) build/$(BOARD)/replay.elf $(filter build/%,$(RUNNER)) || \
	    { echo 'replay.elf for $(BOARD) cannot be made$(if $(ROM_SCENES), with $(FILE) in it: perhaps it is too large)'; false; })
	@tools/replay.py '$(FILE)' $(if $(AGAINST),--against '$(AGAINST)') $(addprefix --board=,$(filter-out host,$(ASKED)))

# the scenes of which figures 7 and 8 speak
PAPER_SCENES := head head450 espresso $(patsubst %,growth-%,512 3034 12012 49928)
figures: ## measure and draw the paper's figures 6, 7 and 8, to out/figures and docs/figures.md
	@tools/need gnuplot pil
	@$(MAKE) bench SCENES=$(subst $(space),$(comma),$(PAPER_SCENES))
	@$(SUBMAKE) BOARD=host build/host/figures.elf
	@tools/figures.py build/host/figures.elf

zlists: ## write the drawings of docs/z-lists.md, from a step of the head scene
	@tools/need $(NEED_MESHES) $(NEED_HOST) pil
	@$(SUBMAKE) BOARD=host build/host/zlists.elf
	@tools/zlists.py build/host/zlists.elf

pictures: ## the pictures of README.md that boards and scenes make, to docs/
	@tools/need $(NEED_MESHES) $(NEED_HOST) pil
	@$(MAKE) scenes && cp out/scenes/scenes.png docs/
	@$(MAKE) run FRAMES=240 && cp out/head/head.gif docs/
	@tools/displays.py

compare: ## compare other engines with Carom: queries, steps, heaps, to out/compare.csv, docs/compare.md and README.md; SHORT=1
ifneq ($(SHORT),)
	@tools/need $(NEED_MESHES) $(NEED_HOST) $(NEED_COMPARE)
	@$(SUBMAKE) BOARD=host build/tools/carom-compare build/tools/carom-heaps $(COMPARE_MESHES)
	@tools/compare.py --short build/tools/carom-compare build/tools/carom-heaps $(firstword $(COMPARE_SCENES))
	@tools/check_compare
else
	@tools/need $(NEED_MESHES) $(NEED_HOST) $(NEED_COMPARE) $(NEED_WASM)
	@tools/need npm:tools/compare_wasm
	@$(SUBMAKE) BOARD=host build/tools/carom-compare build/tools/carom-heaps $(COMPARE_WASM) \
	    $(COMPARE_MESHES)
	@tools/compare.py build/tools/carom-compare build/tools/carom-heaps $(COMPARE_WASM) \
	    $(COMPARE_SCENES)
endif

docs: ## write the API reference of the public headers, by Doxygen, to out/docs/html
	@tools/need doxygen
	@rm -rf out/docs && mkdir -p out/docs
	@CAROM_VERSION=$$(sed -n 's/^#define CAROM_VERSION_[A-Z]* \([0-9]*\)$$/\1/p' include/carom_version.h | paste -sd.) \
	    doxygen docs/Doxyfile
	@echo out/docs/html/index.html

check: ## run the gates: format, layers, symbols, sizes, stack, licences, documents
	@tools/need $(NEED_HOST) $(NEED_BOARD) python3 clang clang-format doxygen reuse
	@mkdir -p build
	@status=0; for gate in $(sort $(wildcard tools/check_*)); do \
	    if [ -x $$gate ]; then echo "== $$gate"; $$gate || status=1; fi; done; exit $$status

size: ## measure code, data and stack of the programs of `make run`, to out/size.csv, and what each use of the engine adds; BOARD= of one
	@$(call build_boards,$(or $(ASKED),$(SHOWN))); \
	    tools/size.py $(if $(ASKED),--keep) --frames $(FRAMES) $$ready && $(all_built)
	@tools/size_use.py

boards: ## write the table of boards in README.md, with the figures that budget and size left in out/
	@tools/need python3
	@tools/board_table.py
	@tools/page.py --readme

amalgamation: ## write two pairs of files to copy into a project, build/amalgamation/carom.[ch] and carom_draw.[ch]
	@tools/need python3
	@$(MAKE) $(JOINED_SOURCES)

packages: ## try every way to install Carom with a stranger's project (packages/README.md); SYSTEMS= chooses
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/hello.elf >/dev/null
	@tools/packages $(SYSTEMS)

five: ## give README's commands as a new user would, in a clean clone, and time them, to docs/five-minutes.md
	@tools/need $(NEED_MESHES) $(NEED_HOST) $(NEED_BOARD) pil
	@tools/five_minutes --docs

commands: ## write compile_commands.json for editors, as BOARD compiles
	@tools/need python3
	@$(MAKE) -Bn BOARD=$(BOARD) build/$(BOARD)/tests.elf build/$(BOARD)/head.elf | tools/compile_commands.py

build: $(PROGRAMS) $(RUNNER) ## build the programs of BOARD without running them

need:
	@tools/need $(NEED_MESHES) $(NEED_THIS)

clean: ## remove build/ and out/
	rm -rf build out

# ---------------------------------------------------------------------- rules

.SECONDARY:
.DELETE_ON_ERROR:

# Objects are made again when the compiler or its options change. Options of some objects are private: $(B)/flags is made
# for the first object, and would hold them.
$(B)/flags: force
	@mkdir -p $(@D)
	@echo '$(TARGET_CC) $(CFLAGS) $(LDFLAGS)' | cmp -s - $@ || \
	    echo '$(TARGET_CC) $(CFLAGS) $(LDFLAGS)' > $@

$(B)/src/%.o: private CFLAGS += -ffreestanding $(if $(COVERED),-w $(COUNTERS) -fcoverage-mapping -fcoverage-mcdc -DDRAW_ALIGN)
ifneq ($(COVERED),)
# The engine only: the tests are what `make test` builds. Debian has no earlier clang with MC/DC.
$(B)/src/%.o $(B)/%.elf: private TARGET_CC := clang-19
endif
# the variables of functions that print must not lie on the stack while a step runs
$(B)/examples/%.o: private CFLAGS += -fno-inline
$(B)/tests/%.o: private CFLAGS += $(if $(CROSS)$(DEBUG),,-DTEST_LONG)

$(B)/%.o: %.c $(B)/flags
	@mkdir -p $(@D)
	@echo '  cc    $<'
	$(TARGET_CC) $(CFLAGS) -MMD -MP -c -o $@ $<

$(B)/%.o: %.S $(B)/flags
	@mkdir -p $(@D)
	@echo '  as    $<'
	$(TARGET_CC) $(ARCH) -c -o $@ $<

$(B)/libcarom.a: $(ENGINE)
$(B)/libtests.a: $(TEST_TOOLS)
$(B)/lib%.a:
	@echo '  ar    $@'
	rm -f $@
	$(TARGET_AR) rcs $@ $^

# One command makes both pairs.
build/amalgamation/carom.c: tools/amalgamate.py tools/gate.py LICENSE $(wildcard src/*/*.[ch] include/*.h)
	@echo '  join  $(@D)'
	tools/amalgamate.py $(@D)
build/amalgamation/carom_draw.c: build/amalgamation/carom.c ;

link = $(TARGET_CC) $(LDFLAGS) -o $@ $(filter %.o,$^) $(filter %.a,$^) $(LIBS)$(if $(IMAGE_SUFFIX), && \
    $(CROSS)objcopy -O binary $@ $(@:.elf=$(IMAGE_SUFFIX)))$(if $(IMAGE_TOOL), && \
    $(IMAGE_TOOL) $(@:.elf=$(IMAGE_SUFFIX)))
PROGRAM := $(SUPPORT) $(SCENE_FILES) $(B)/libcarom.a | $(ALSO)

$(B)/%.elf: $(B)/examples/%.o $(PROGRAM)
	@echo '  link  $@'
	$(link)

$(B)/head.elf: $(call objects,examples/scene_play.c examples/show.c)
$(B)/figures.elf: $(call objects,examples/show.c)

# The viewer, which the page and the window show.
VIEWER := $(patsubst %.c,$(B)/%.o,$(wildcard examples/view*.c) examples/show.c)
$(B)/host_view.elf $(B)/host_view_link.elf $(B)/zlists.elf: $(VIEWER)
# it looks at the gathers of the step
$(B)/zlists.elf: private LDFLAGS += -Wl,--wrap=interfere_leaves

# The window.
$(B)/window.elf: $(call objects,port/sdl2/window.c port/sdl2/input.c) $(VIEWER) $(PROGRAM)
	@echo '  link  $@'
	$(link) -lSDL2
$(B)/port/sdl2/%.o: private CFLAGS += -isystem /usr/include/SDL2

# The page: one file with the module in it.
$(B)/page.wasm: $(B)/port/wasm/page.o $(VIEWER) $(SCENES_BUILT) $(call objects,port/nolibc/string.c) $(B)/libcarom.a
	@echo '  link  $@'
	$(TARGET_CC) -nostdlib -Wl,--no-entry,--gc-sections,--strip-all,-z,stack-size=262144 \
	    $(PAGE_EXPORTS:%=-Wl,--export=%) -o $@ $^
out/web/index.html: tools/page.py $(wildcard examples/web/*) tests/bench_scenes.csv build/wasm/page.wasm
	@mkdir -p $(@D)
	@echo '  page  $@'
	tools/page.py build/wasm/page.wasm $@

$(B)/%.elf: $(B)/tests/%.o $(B)/libtests.a $(PROGRAM)
	@echo '  link  $@'
	$(link)

# for every board, however small, so without the rest of the tests
$(B)/matrix.elf: $(call objects,tests/matrix.c tests/lib/plays.c) $(PROGRAM)
	@echo '  link  $@'
	$(link)

$(B)/replay.elf: $(B)/tests/replay.o $(SUPPORT) \
    $(if $(ROM_SCENES),$(B)/replay_file.o $(filter-out $(B)/small/src/draw/%,$(ENGINE:$(B)/%=$(B)/small/%))) $(B)/libcarom.a
	@echo '  link  $@'
	$(link)

# A board that is short of memory has the recording in its image, and plays it in the RAM that is left. The image holds all
# functions that change a world, so it is compiled at -Os.
$(B)/small/%.o: private CFLAGS += -ffreestanding -Os
$(B)/small/%.o: %.c $(B)/flags
	@mkdir -p $(@D)
	@echo '  cc    $< small'
	$(TARGET_CC) $(CFLAGS) -MMD -MP -c -o $@ $<
$(B)/tests/replay.o: private CFLAGS += $(if $(ROM_SCENES),-DREPLAY_BUILT_IN)
replay_file = .section .rodata\n.global replay_file, replay_file_end\nreplay_file: .incbin "$(FILE)"\nreplay_file_end:\n
$(B)/replay_file.S: force
	@mkdir -p $(@D)
	@printf '$(replay_file)' | cmp -s - $@ || printf '$(replay_file)' >$@
$(B)/replay_file.o: $(B)/replay_file.S $(FILE)
	$(TARGET_CC) $(ARCH) -c -o $@ $<

# The scenes unchanged, with each call on the world recorded.
$(B)/recorded/%.o: private CFLAGS += -include tests/lib/recorded.h
$(B)/recorded/%.o: %.c $(B)/flags
	@mkdir -p $(@D)
	@echo '  cc    $< recorded'
	$(TARGET_CC) $(CFLAGS) -MMD -MP -c -o $@ $<
# Without the game over a link: it takes frames back, which a recording cannot.
RECORDED := examples/scene.c examples/scene_look.c examples/scene_sheet.c $(filter-out %/scene_net.c,$(GAMES)) tests/record.c
$(B)/record.elf: $(patsubst %.c,$(B)/recorded/%.o,$(RECORDED)) $(SUPPORT) $(B)/libcarom.a \
    $(filter-out $(call objects,$(RECORDED)),$(SCENES_BUILT))
	@echo '  link  $@'
	$(link)

# The random calls of these tests are recorded, too.
$(B)/host_replay.elf $(B)/host_inputs.elf $(B)/fuzz.elf: $(patsubst %.c,$(B)/recorded/%.o,$(wildcard tests/lib/fuzz*.c))

$(B)/tests.elf: $(call objects,tests/main.c $(SUITES:%=tests/test_%.c)) $(B)/libtests.a $(PROGRAM)
	@echo '  link  $@'
	$(link)

$(B)/suite_%.elf: $(B)/tests/test_%.o $(B)/tests/main.o $(B)/libtests.a $(PROGRAM)
	@echo '  link  $@'
	$(link)

$(B)/fuzz.elf: private LDFLAGS += -fsanitize=fuzzer

# It watches the calls that can meet a full pool.
FAULTS_WRAP := body_add body_set body_set_filter surface_move world_step snapshot_load body_set_material \
    body_set_face_materials body_set_force_at body_set_torque body_set_gravity_scale body_set_damping \
    joint_add joint_remove query_faces
$(B)/host_faults.elf: private LDFLAGS += $(FAULTS_WRAP:%=-Wl,--wrap=carom_%)

# It makes calls within a step fail.
ERRORS_WRAP := pool_take step_note_touching world_note_through world_part_joint step_set_region step_cut step_rejoin \
    impact_solve interfere_visit_pair interfere_note_faces contact_add contact_force
$(B)/host_errors.elf: private LDFLAGS += $(ERRORS_WRAP:%=-Wl,--wrap=%)

$(B)/host_paper.elf: private LDFLAGS += $(PAPER_LINK)
$(B)/host_paper.elf: $(call objects,$(wildcard tests/paper/*.c))

# Meshes: a generator prints OBJ, and the converter turns it into a C array.
build/gen/field%: GENERATOR := tools/gen_field
$(SHAPES:%=build/gen/%.obj): GENERATOR := tools/gen_shapes
build/gen/%.obj: tools/gen_field tools/gen_shapes tools/machines.py tools/small.py tools/solids.py
	@mkdir -p $(@D)
	@echo '  mesh  $@'
	$(GENERATOR) $(*:field%=%) > $@
# one run makes them all: each is reduced from a finer one
$(HEADS:%=build/gen/%.obj) &: tools/gen_head tools/head_shape.py tools/mesh_collapse.py
	@mkdir -p $(@D)
	@echo '  mesh  $(@D)/head*.obj'
	tools/gen_head $(@D)

build/gen/%_ramps.c: tools/gen_figure8 tools/solids.py
	@mkdir -p $(@D)
	@echo '  paint $@'
	tools/gen_figure8 $(*:mandelbrot%=mandelbrot %) paint $*_ramps > $@
$(FIGURE8:%=build/gen/%.obj): build/gen/%.obj: tools/gen_figure8 tools/solids.py
	@mkdir -p $(@D)
	@echo '  mesh  $@'
	tools/gen_figure8 $(*:mandelbrot%=mandelbrot %) > $@

build/gen/field% build/gen/yard% build/gen/mandelbrot%: CONVERT := --surface
build/gen/%_mesh.c: build/gen/%.obj build/tools/carom-mesh
	@echo '  mesh  $@'
	build/tools/carom-mesh $(CONVERT) --name $*_mesh -o $@ $<

# Indexed meshes of scenes for ROM, and the list of those that a board has.
build/gen/rom/%.c: build/tools/rom_scene
	@mkdir -p $(@D)
	@echo '  mesh  $@'
	build/tools/rom_scene $* > $@

rom_id = $(subst -,_,$(1))
$(B)/gen/rom_scenes.h: port/$(BOARD)/board.mk
	@mkdir -p $(@D)
	printf 'ROM_SCENE(%s)\n' $(call rom_id,$(ROM_SCENES)) > $@
$(B)/examples/scene_rom.o: $(B)/gen/rom_scenes.h

build/gen/%.crm: build/gen/%.obj build/tools/carom-mesh
	@echo '  mesh  $@'
	build/tools/carom-mesh $(CONVERT) -b $@ $<

# Engines measured beside Carom get all optimisations; the converter is compiled fast.
build/tools/mesh_%.o build/tools/rom_%.o: private TOOL_OPT := -O1
build/tools/%.o: tools/%.cpp
	@mkdir -p $(@D)
	@echo '  c++   $<'
	$(CXX) -std=c++17 $(or $(TOOL_OPT),-O2) -Wall -Wextra -Iinclude -Isrc -Itests -Iexamples -isystem /usr/include/bullet \
	    -isystem /usr/include/eigen3 -MMD -MP -c -o $@ $<

build/tools/carom-compare: $(patsubst %.cpp,build/%.o,$(wildcard tools/compare*.cpp)) \
                           $(B)/tests/paper/paper.o $(SCENES_BUILT) \
                           $(B)/libtests.a $(B)/libcarom.a
	@echo '  link  $@'
	$(CXX) -o $@ $^ -lode -lBulletCollision -lLinearMath -lfcl -lccd -lm

build/tools/carom-heaps: $(patsubst %.cpp,build/%.o,$(wildcard tools/heaps*.cpp)) $(SCENES_BUILT) \
                         $(B)/libcarom.a
	@echo '  link  $@'
	$(CXX) -o $@ $^ -lode -lBulletDynamics -lBulletCollision -lLinearMath -lm

build/tools/heap.wasm: tools/compare_wasm/heap.c tools/heaps_box.h port/nolibc/string.c \
                       $(filter-out src/draw/%,$(wildcard src/*/*.c)) \
                       $(wildcard include/*.h src/*/*.h)
	@mkdir -p $(@D)
	@echo '  wasm  $@'
	clang --target=wasm32 -std=c11 -O3 -ffreestanding -Iport/nolibc -Iinclude -nostdlib \
	    -Wl,--no-entry,-z,stack-size=262144 -o $@ $(filter %.c,$^)

# The engine and the scenes, for tools; the link leaves out what these do not call.
build/tools/%.o: %.c
	@mkdir -p $(@D)
	@echo '  cc    $< for tools'
	$(CC) -std=c11 -O1 -ffunction-sections -Iinclude -Isrc -Iexamples -Iport -MMD -MP -c -o $@ $<

TOOL_ENGINE := $(filter-out src/draw/%,$(wildcard src/*/*.c))
build/tools/libengine.a: $(TOOL_ENGINE:%.c=build/tools/%.o)
	@echo '  ar    $@'
	rm -f $@
	$(AR) rcs $@ $^

build/tools/carom-mesh: $(addprefix build/tools/,mesh_convert.o mesh_rom.o) \
                        $(patsubst %.c,build/tools/%.o,$(wildcard src/draw/*.c)) build/tools/libengine.a
	@echo '  link  $@'
	$(CXX) -Wl,--gc-sections -o $@ $^ -lassimp -lmeshoptimizer -lpng

# The plugin that counts instructions of a program in QEMU's user mode.
build/tools/count.so: tools/count.c port/linux/count.h
	@mkdir -p $(@D)
	@echo '  cc    $@'
	$(CC) -std=c11 -O2 $(WARNINGS) -shared -fPIC -Iport/linux -o $@ $<
# Runners of boards that QEMU does not have.
build/tools/retro_run: $(wildcard tools/retro_*.[ch]) port/nds/channel.h
	@mkdir -p $(@D)
	@echo '  cc    $@'
	$(CC) -std=c11 -O2 $(WARNINGS) -DCORES='"/usr/lib/$(shell $(CC) -print-multiarch)/libretro"' -o $@ $(filter %.c,$^)
PSX_PLUGINS = /usr/lib/$(shell $(CC) -print-multiarch)/psemu
build/tools/psx_plugin.so: tools/psx_plugin.c
	@mkdir -p $(@D)
	@echo '  cc    $@'
	$(CC) -std=c11 -O2 $(WARNINGS) -shared -fPIC -o $@ $< \
	    -Wl,--no-as-needed,-rpath,$(PSX_PLUGINS) $(PSX_PLUGINS)/libDFXVideo.so
build/tools/psx_preload.so: tools/psx_preload.c
	@mkdir -p $(@D)
	@echo '  cc    $@'
	$(CC) -std=c11 -O2 $(WARNINGS) -shared -fPIC -o $@ $<
build/tools/psx_run: tools/psx_run.py build/tools/psx_plugin.so build/tools/psx_preload.so
	@echo '  copy  $@'
	install $< $@

# The link leaves out what only a world needs.
build/tools/rom_scene: $(addprefix build/tools/,rom_scene.o mesh_rom.o) \
                       $(SCENES_BUILT:$(B)/%=build/tools/%) build/tools/libengine.a
	@echo '  link  $@'
	$(CXX) -Wl,--gc-sections -o $@ $^

# Nothing is to be tried to make one of these.
%.d: ;
-include $(shell find $(B) build/tools -name '*.d' 2>/dev/null)
