/* SPDX-License-Identifier: MIT */
/*
 * A plugin of QEMU (qemu-mips -plugin count.so PROGRAM) that counts the instructions of a program and lets the program read
 * the count while it runs.
 *
 * QEMU translates a program in blocks, which always run from their first instruction on. A block
 * adds its length to the count when it begins, so two readings by the same instruction differ by
 * exactly the instructions in between. The used parts of the interface are declared here, as in
 * QEMU's documentation of its TCG plugins (version 1).
 */
#define _GNU_SOURCE
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/mman.h>
#include <unistd.h>

#include "count.h"

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "port/linux/counter.c reads a little-endian count"
#endif

#define VISIBLE __attribute__((visibility("default")))

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id,
                                           void (*translated)(qemu_plugin_id_t,
                                                              struct qemu_plugin_tb *));
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb *block, enum qemu_plugin_op op,
                                              void *number, uint64_t operand);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *block);

VISIBLE extern int qemu_plugin_version;
VISIBLE int qemu_plugin_install(qemu_plugin_id_t id, const void *info, int argc, char **argv);

int qemu_plugin_version = 1;

static uint64_t *count;

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb *block)
{
    (void)id;
    qemu_plugin_register_vcpu_tb_exec_inline(block, QEMU_PLUGIN_INLINE_ADD_U64, count,
                                             qemu_plugin_tb_n_insns(block));
}

int qemu_plugin_install(qemu_plugin_id_t id, const void *info, int argc, char **argv)
{
    int file = memfd_create("count", 0);

    (void)info;
    (void)argc;
    (void)argv;
    if (file < 0 || ftruncate(file, COUNT_BYTES) || dup2(file, COUNT_FILE) < 0) {
        perror("count");
        return -1;
    }
    close(file);
    count = mmap(NULL, COUNT_BYTES, PROT_READ | PROT_WRITE, MAP_SHARED, COUNT_FILE, 0);
    if (count == MAP_FAILED) {
        perror("count");
        return -1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    return 0;
}
