# SPDX-License-Identifier: MIT
# Everything that is built goes to build/, everything that is found out to out/. See `make help`.

BOARD ?= versatilepb
SCENE ?= $(if $(MESH),user,head)
FRAMES ?= 600
OPT ?= -O2
DEBUG ?=

BOARDS := $(patsubst port/%/board.mk,%,$(wildcard port/*/board.mk))
ifeq ($(filter $(BOARD),$(BOARDS)),)
$(error BOARD=$(BOARD) is none of: $(BOARDS))
endif
include port/$(BOARD)/board.mk

# ---------------------------------------------------------------- tools, flags

B := build/$(BOARD)$(if $(DEBUG),-debug)
TARGET_CC := $(if $(CROSS),$(CROSS)gcc,$(CC))
TARGET_AR := $(CROSS)ar
WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Werror
comma := ,
SANITIZE := $(if $(DEBUG),$(if $(CROSS),,-fsanitize=address$(comma)undefined -fno-sanitize-recover))
CFLAGS := -std=c11 $(OPT) -g $(WARNINGS) $(ARCH) $(SANITIZE) -ffunction-sections -fdata-sections \
          -Iinclude -Isrc -Iport -Iport/arm -Iexamples $(if $(DEBUG),-DCAROM_DEBUG) \
          $(if $(ICOUNT_SHIFT),-DPORT_ICOUNT_SHIFT=$(ICOUNT_SHIFT))
LDFLAGS := $(ARCH) $(SANITIZE) -Wl,--gc-sections
ifdef CROSS
LDFLAGS += -Wl,-z,noexecstack --specs=nano.specs -nostartfiles -Llinker -T$(BOARD).ld
LINKER_FILES := linker/$(BOARD).ld linker/sections.ld
PORT += port/newlib/syscalls.c port/arm/semihost.c port/arm/start.c port/arm/icount.c
endif

# ---------------------------------------------------------------------- files

objects = $(addprefix $(B)/,$(addsuffix .o,$(basename $(1))))
ENGINE := $(call objects,$(wildcard src/*.c))
SUPPORT := $(call objects,$(PORT) port/option.c port/print.c port/assert.c) $(LINKER_FILES)
# the null port proves that port.h can be met; nothing links it
ALSO := $(call objects,port/null/null.c)
# examples are for the host, head is for every board
EXAMPLES := $(if $(CROSS),examples/head.c,$(filter-out examples/scene%,$(wildcard examples/*.c)))
PROGRAMS := $(EXAMPLES:examples/%.c=$(B)/%.elf)
SCENES := $(call objects,$(wildcard examples/scene*.c) build/gen/head_mesh.c build/gen/field_mesh.c)
TEST_RUNNER := $(wildcard tests/main.c tests/test_*.c)
TESTS := $(call objects,$(TEST_RUNNER))
# programs of their own, and what tests share
HOST_TESTS := $(patsubst tests/%.c,build/host/%.elf,$(wildcard tests/host_*.c))
ACCURACY := $(patsubst tests/%.c,build/host/%.elf,$(wildcard tests/accuracy_*.c))
TEST_TOOLS := $(call objects,$(filter-out $(TEST_RUNNER) tests/host_% tests/accuracy_%,\
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

.PHONY: help run test accuracy oracle check size build clean force

help: ## list the commands
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/\1|\2/p' Makefile | \
	    while IFS='|' read -r name text; do printf '  make %-8s %s\n' "$$name" "$$text"; done
	@echo '  BOARD is one of: $(filter-out null,$(BOARDS))'

run: ## a scene on a board; BOARD= SCENE=head|box|pile|sheet FRAMES=600 MESH=file AWAKE=1 FRAMES_PNG=0|1
	@tools/need $(NEED_MESHES) $(if $(CROSS),$(NEED_BOARD),$(NEED_HOST)) pil
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
PROGRAM := $(SUPPORT) $(SCENES) $(B)/libcarom.a | $(ALSO)

$(B)/%.elf: $(B)/examples/%.o $(PROGRAM)
	@echo '  link  $@'
	$(link)

$(B)/%.elf: $(B)/tests/%.o $(B)/libtests.a $(PROGRAM)
	@echo '  link  $@'
	$(link)

$(B)/tests.elf: $(TESTS) $(B)/libtests.a $(PROGRAM)
	@echo '  link  $@'
	$(link)

# Meshes: a generator prints OBJ, the converter makes it a C array.
build/gen/%.obj: tools/gen_%
	@mkdir -p $(@D)
	@echo '  mesh  $@'
	tools/gen_$* > $@

build/gen/head_mesh.c: build/gen/head.obj build/tools/carom-mesh
	@echo '  mesh  $@'
	build/tools/carom-mesh --name head_mesh -o $@ $<

build/gen/field_mesh.c: build/gen/field.obj build/tools/carom-mesh
	@echo '  mesh  $@'
	build/tools/carom-mesh --surface --name field_mesh -o $@ $<

build/tools/carom-mesh: tools/mesh_convert.cpp
	@mkdir -p $(@D)
	@echo '  c++   $@'
	$(CXX) -std=c++17 -O2 -Wall -Wextra -Iinclude -MMD -MP -MF $@.d -o $@ $< -lassimp

-include $(shell find $(B) -name '*.d' 2>/dev/null) build/tools/carom-mesh.d
