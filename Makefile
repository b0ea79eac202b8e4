# SPDX-License-Identifier: MIT
# Everything that is built goes to build/, everything that is found out to out/. See `make help`.

BOARD ?= versatilepb
FRAMES ?= 600
OPT ?= -O2
LABEL ?= $(if $(PAPER),paper)
DEBUG ?=
PAPER ?=

BOARDS := $(patsubst port/%/board.mk,%,$(wildcard port/*/board.mk))
ifeq ($(filter $(BOARD),$(BOARDS)),)
$(error BOARD=$(BOARD) is none of: $(BOARDS))
endif
include port/$(BOARD)/board.mk
ifdef FAMILY
include port/$(FAMILY)/family.mk
endif
# the scene that a board shows when it is not told
SCENE ?= $(if $(MESH),user,$(firstword $(ROM_SCENES) head))

# ---------------------------------------------------------------- tools, flags

B := build/$(BOARD)$(if $(DEBUG),-debug)
TARGET_CC := $(if $(CROSS),$(CROSS)gcc,$(CC))
TARGET_AR := $(CROSS)ar
WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Werror
comma := ,
SANITIZE := $(if $(DEBUG),$(if $(CROSS),,-fsanitize=address$(comma)undefined -fno-sanitize-recover))
CFLAGS := -std=c11 $(OPT) -g $(WARNINGS) $(ARCH) $(SANITIZE) -ffunction-sections -fdata-sections \
          -Iinclude -Isrc -Iport $(if $(FAMILY),-Iport/$(FAMILY) -Iport/bare) $(FAMILY_CFLAGS) -Iexamples \
          $(if $(DEBUG),-DCAROM_DEBUG) $(if $(ICOUNT_SHIFT),-DPORT_ICOUNT_SHIFT=$(ICOUNT_SHIFT)) \
          $(if $(ROM_SCENES),-DSCENE_ROM -I$(B)/gen) $(if $(CAPS),-DBOARD_CAPS=$(CAPS)) \
          $(if $(DRAW_BYTES),-DBOARD_DRAW_BYTES=$(DRAW_BYTES))
LDFLAGS := $(ARCH) $(SANITIZE) -Wl,--gc-sections
PAPER_LINK := -Wl,--wrap=interfere_visit
ENGINE_SOURCES := $(wildcard src/*.c)
ifneq ($(PAPER),)
# The paper's interference detection in place of ours; its z-list buffer leaves less for a mesh.
ENGINE_SOURCES += $(wildcard src/paper/*.c)
CFLAGS += -DUSER_VERTICES=4000 -DBENCH_MESH_BYTES=3000000
LDFLAGS += $(PAPER_LINK)
endif
ifdef CROSS
LDFLAGS += -Wl,-z,noexecstack -nostartfiles -Llinker -T$(BOARD).ld $(FAMILY_LDFLAGS)
LINKER_FILES := linker/$(BOARD).ld linker/sections.ld
endif

# ---------------------------------------------------------------------- files

objects = $(addprefix $(B)/,$(addsuffix .o,$(basename $(1))))
ENGINE := $(call objects,$(ENGINE_SOURCES))
SUPPORT := $(call objects,$(PORT) port/option.c port/print.c port/assert.c) $(LINKER_FILES)
# the null port proves that port.h can be met; nothing links it
ALSO := $(call objects,port/null/null.c)
# examples are for the host, head is for every board
EXAMPLES := $(if $(CROSS),examples/head.c,$(filter-out examples/scene%,$(wildcard examples/*.c)))
PROGRAMS := $(EXAMPLES:examples/%.c=$(B)/%.elf)
# what the generators make, by the number of faces; without one, that of the paper
HEADS := head head48 head80 head100 head450 head836
FIELDS := field field128 field386 field512 field12012 field49928
# the scenes, with meshes that are indexed when a scene is loaded
SCENES_BUILT := $(call objects,examples/scene.c examples/scene_sheet.c examples/scene_built.c \
    $(patsubst %,build/gen/%_mesh.c,$(HEADS) $(FIELDS)))
# or, on a board that says which, with indexed ones in ROM
SCENES_IN_ROM := $(call objects,examples/scene.c examples/scene_sheet.c examples/scene_rom.c \
    $(ROM_SCENES:%=build/gen/rom/%.c))
SCENE_FILES := $(if $(ROM_SCENES),$(SCENES_IN_ROM),$(SCENES_BUILT))
TEST_RUNNER := $(wildcard tests/main.c tests/test_*.c)
TESTS := $(call objects,$(TEST_RUNNER))
# programs of their own, and what tests share
HOST_TESTS := $(patsubst tests/%.c,build/host/%.elf,$(wildcard tests/host_*.c))
ACCURACY := $(patsubst tests/%.c,build/host/%.elf,$(wildcard tests/accuracy_*.c))
TEST_TOOLS := $(call objects,$(filter-out $(TEST_RUNNER) tests/bench.c tests/bare_% tests/host_% tests/accuracy_%,\
                $(wildcard tests/*.c)))
SHELL_TESTS := $(wildcard tests/*.sh)

# ------------------------------------------------------------------- commands

export PYTHONDONTWRITEBYTECODE := 1

# V=1 shows the commands themselves.
ifndef V
MAKEFLAGS += -s --no-print-directory
endif

# A sub-make knows the board, and has two jobs unless it is given a number.
SUBMAKE = $(MAKE) $(if $(findstring jobserver,$(MAKEFLAGS)),,-j2)
NEED_MESHES := python3 c++ assimp
NEED_HOST := cc libc png
NEED_BOARD := arm newlib qemu-arm
NEED_THIS := $(or $(NEED),$(NEED_HOST))
NEED_COMPARE := ode bullet fcl valgrind

# Scenes of the comparison: what moves, what stands still.
mesh_pair = $(1)=build/gen/$(2).crm,build/gen/$(3).crm
COMPARE_SCENES := $(call mesh_pair,head,head1876,field3034) \
                  $(call mesh_pair,head450,head450,field386) \
                  $(call mesh_pair,head836,head836,field512)
COMPARE_MESHES := $(filter %.crm,$(subst $(comma), ,$(subst =, ,$(COMPARE_SCENES))))

.PHONY: help run test accuracy oracle bench figures compare check size build clean force

help: ## list the commands
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/\1|\2/p' Makefile | \
	    while IFS='|' read -r name text; do printf '  make %-8s %s\n' "$$name" "$$text"; done
	@echo '  BOARD is one of: $(filter-out null,$(BOARDS))'

run: ## a scene on a board; BOARD= SCENE=head|box|pile|sheet|... FRAMES=600 MESH=file AWAKE=1 FRAMES_PNG=0|1 PAPER=1
	@tools/need $(NEED_MESHES) $(NEED_THIS) pil
	@$(SUBMAKE) $(B)/head.elf $(if $(MESH),build/tools/carom-mesh)
	@$(if $(MESH),build/tools/carom-mesh $(MESH_FLAGS) -b build/gen/user.crm '$(MESH)')
	@tools/run_scene.py --board $(BOARD) --frames $(FRAMES) --out out/$(SCENE) \
	    --pictures $(or $(FRAMES_PNG),$(PICTURES)) $(if $(BUDGET),--budget $(BUDGET)) \
	    $(B)/head.elf scene=$(SCENE) $(if $(MESH),mesh=build/gen/user.crm) $(if $(AWAKE),awake=1)

test: ## every test, on the host and on a board; TEST= selects by a part of a name
	@tools/need $(NEED_MESHES) $(NEED_HOST) $(NEED_BOARD) clang
	@$(SUBMAKE) BOARD=host build/host/tests.elf $(HOST_TESTS) $(ACCURACY) build/tools/carom-mesh
	@$(SUBMAKE) BOARD=host DEBUG=1 build/host-debug/tests.elf
	@$(SUBMAKE) BOARD=mps2-an385 build/mps2-an385/tests.elf
	@tools/run_tests.py --select '$(TEST)' $(HOST_TESTS) $(SHELL_TESTS) \
	    build/host/tests.elf build/host-debug/tests.elf build/mps2-an385/tests.elf

accuracy: ## the integer kernels against independent oracles, to out/accuracy.csv
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host $(ACCURACY)
	@mkdir -p out
	@echo 'kernel,cases,p50,p999,p9999,max,failures' | tee out/accuracy.csv
	@status=0; for program in $(ACCURACY); do \
	    $$program >out/accuracy.part || status=1; tee -a out/accuracy.csv <out/accuracy.part; \
	done; rm -f out/accuracy.part; exit $$status

oracle: ## first hits of 10,000 motions against every pair of features, to out/oracle.csv
	@tools/need $(NEED_MESHES) $(NEED_HOST)
	@$(SUBMAKE) BOARD=host build/host/host_first_hit.elf
	@mkdir -p out
	@status=0; build/host/host_first_hit.elf all >out/oracle.csv || status=1; \
	    cat out/oracle.csv; exit $$status

bench: ## instructions by stage on a Cortex-M3, to out/bench.csv; SCENES= BASELINE=1 GATE=1 PAPER=1
	@tools/need $(NEED_MESHES) $(NEED_HOST) $(NEED_BOARD)
	@$(SUBMAKE) BOARD=host build/host/bench.elf
	@$(SUBMAKE) BOARD=mps2-an385 build/mps2-an385/bench.elf
	@tools/bench.py build/host/bench.elf build/mps2-an385/bench.elf --label '$(LABEL)' \
	    --scenes '$(SCENES)' $(if $(BASELINE),--baseline) $(if $(GATE),--gate)

figures: ## the paper's figures 7 and 8 from out/bench.csv, to out/figures
	@tools/need python3 gnuplot
	@test -e out/bench.csv || $(MAKE) bench
	@tools/figures.py out/figures

compare: ## ODE, Bullet and FCL beside Carom on the same meshes and poses, to out/compare.csv
	@tools/need $(NEED_MESHES) $(NEED_HOST) $(NEED_COMPARE)
	@$(SUBMAKE) BOARD=host build/tools/carom-compare $(COMPARE_MESHES)
	@tools/compare.py build/tools/carom-compare $(COMPARE_SCENES)

check: ## the gates: format, layers, symbols, sizes, stack
	@tools/need $(NEED_HOST) $(NEED_BOARD) python3 clang clang-format
	@status=0; for gate in $(sort $(wildcard tools/check_*)); do \
	    if [ -x $$gate ]; then echo "== $$gate"; $$gate || status=1; fi; done; exit $$status

size: ## code and data of the engine, by board
	@tools/need $(NEED_HOST) arm newlib
	@for board in host mps2-an385 versatilepb; do \
	    $(SUBMAKE) BOARD=$$board build/$$board/libcarom.a >/dev/null && \
	    echo "== $$board" && size -t build/$$board/libcarom.a || exit 1; done

build: $(PROGRAMS) ## the programs of BOARD, without running them

clean: ## remove build/ and out/
	rm -rf build out

# ---------------------------------------------------------------------- rules

.SECONDARY:
.DELETE_ON_ERROR:

# Objects are made again when the compiler or its options change.
$(B)/flags: force
	@mkdir -p $(@D)
	@echo '$(TARGET_CC) $(CFLAGS) $(LDFLAGS)' | cmp -s - $@ || \
	    echo '$(TARGET_CC) $(CFLAGS) $(LDFLAGS)' > $@

$(B)/src/%.o: CFLAGS += -ffreestanding
$(B)/tests/%.o: CFLAGS += $(if $(CROSS)$(DEBUG),,-DTEST_LONG)

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

link = $(TARGET_CC) $(LDFLAGS) -o $@ $(filter %.o %.a,$^) $(LIBS)
PROGRAM := $(SUPPORT) $(SCENE_FILES) $(B)/libcarom.a | $(ALSO)

$(B)/%.elf: $(B)/examples/%.o $(PROGRAM)
	@echo '  link  $@'
	$(link)

$(B)/%.elf: $(B)/tests/%.o $(B)/libtests.a $(PROGRAM)
	@echo '  link  $@'
	$(link)

$(B)/tests.elf: $(TESTS) $(B)/libtests.a $(PROGRAM)
	@echo '  link  $@'
	$(link)

$(B)/host_paper.elf: private LDFLAGS += $(PAPER_LINK)
$(B)/host_paper.elf: $(call objects,$(wildcard src/paper/*.c))

# Meshes: a generator prints OBJ, the converter makes it a C array.
build/gen/head%: GENERATOR := tools/gen_head
build/gen/field%: GENERATOR := tools/gen_field
build/gen/%.obj: tools/gen_head tools/gen_field
	@mkdir -p $(@D)
	@echo '  mesh  $@'
	$(GENERATOR) $(patsubst field%,%,$(*:head%=%)) > $@

build/gen/field%: CONVERT := --surface
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

build/tools/%.o: tools/%.cpp
	@mkdir -p $(@D)
	@echo '  c++   $<'
	$(CXX) -std=c++17 -O2 -Wall -Wextra -Iinclude -Isrc -Itests -Iexamples -isystem /usr/include/bullet \
	    -isystem /usr/include/eigen3 -MMD -MP -c -o $@ $<

build/tools/carom-compare: $(patsubst %.cpp,build/%.o,$(wildcard tools/compare*.cpp)) \
                           $(B)/src/paper/paper.o $(filter %/scene.o %/scene_sheet.o %_mesh.o,$(PROGRAM)) \
                           $(B)/libtests.a $(B)/libcarom.a
	@echo '  link  $@'
	$(CXX) -o $@ $^ -lode -lBulletCollision -lLinearMath -lfcl -lccd -lm

# The part of the engine that indexes meshes, and the scenes, for tools.
build/tools/%.o: %.c
	@mkdir -p $(@D)
	@echo '  cc    $< for tools'
	$(CC) -std=c11 -O1 -ffunction-sections -Iinclude -Isrc -Iexamples -MMD -MP -c -o $@ $<

TOOL_ENGINE := $(wildcard src/fix*.c src/arena.c src/scan.c src/zlist.c src/mass.c src/mesh*.c \
                 src/world_report.c)
build/tools/libmesh.a: $(TOOL_ENGINE:%.c=build/tools/%.o)
	@echo '  ar    $@'
	rm -f $@
	$(AR) rcs $@ $^

build/tools/carom-mesh: $(addprefix build/tools/,mesh_convert.o mesh_rom.o libmesh.a)
	@echo '  link  $@'
	$(CXX) -Wl,--gc-sections -o $@ $^ -lassimp

# What only a world needs is left out at the link.
build/tools/rom_scene: $(addprefix build/tools/,rom_scene.o mesh_rom.o) \
                       $(SCENES_BUILT:$(B)/%=build/tools/%) build/tools/libmesh.a
	@echo '  link  $@'
	$(CXX) -Wl,--gc-sections -o $@ $^

-include $(shell find $(B) build/tools -name '*.d' 2>/dev/null)
