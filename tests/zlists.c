/* SPDX-License-Identifier: MIT */
/*
 * zlists - the z-lists that a step uses, for tools/zlists.py, which draws them. The program plays
 * a scene in the viewer up to its first hit, and writes two rows of cells in section: one of the
 * moving body's mesh, and one of the ground's mesh with the leaf of the body that had the most
 * candidates in the frame of the hit.
 *
 * The program is linked with -Wl,--wrap=interfere_leaves, so it sees the step's own gathers.
 *
 * Options: scene=NAME (of scene.h)  pictures=DIRECTORY (two pictures of the viewer: cells, leaves)
 */
#include <stdio.h>
#include <string.h>

#include "interfere/narrow.h"
#include "port.h"
#include "scene.h"
#include "view.h"

enum { FRAMES_MOST = 600, FACES_MOST = 65536 };

void __real_interfere_leaves(struct interfere *w);
void __wrap_interfere_leaves(struct interfere *w);

/*
 * A leaf as a gather left it. Per face of b: `met` says that the leaf reaches its plane, `found`
 * that it has candidates.
 */
struct seen {
    struct interfere_leaf leaf;
    const struct carom_mesh *a, *b;
    uint32_t candidates;
    uint8_t met[FACES_MOST], found[FACES_MOST];
};
static struct seen now, best;
static void (*step_meets)(struct interfere *w, struct target *t);

static int expect(int result, const char *what)
{
    if (result < 0) {
        printf("%s: %s\n", what, carom_result_text(result));
        port_exit(1);
    }
    return result;
}

/* ------------------------------------------------------------------- the step */

static void end_leaf(void)
{
    if (now.candidates > best.candidates) {
        best = now;
    }
    memset(&now, 0, sizeof now);
}

static void meet(struct interfere *w, struct target *t)
{
    uint32_t before = w->candidate_pool->used;

    if (now.leaf.leaf != w->leaf->leaf) {
        end_leaf();
    }
    step_meets(w, t);
    now.leaf = *w->leaf;
    now.a = w->a->def.mesh;
    now.b = w->b->def.mesh;
    now.met[t->number] = 1;
    now.found[t->number] = w->candidate_pool->used > before;
    now.candidates += w->candidate_pool->used - before;
}

void __wrap_interfere_leaves(struct interfere *w)
{
    step_meets = w->meet;
    w->meet = meet;
    __real_interfere_leaves(w);
    end_leaf();
}

/* ------------------------------------------------------------------ a section */

/*
 * The fate of an entry of a cell below the leaf: the first cull that drops it, in the order of the
 * culls.
 */
static const char *fate(const struct seen *s, const struct carom_zref *entry)
{
    if (entry->z1 < s->leaf.quanta_low[2]) {
        return "below";
    }
    if (entry->z0 > s->leaf.quanta_high[2]) {
        return "above";
    }
    return s->found[entry->face] ? "candidate" : s->met[entry->face] ? "near" : "parted";
}

/* A row of a mesh's cells; `s` is a leaf over some of them, or NULL. */
static void print_row(const char *name, const struct carom_mesh *mesh, int32_t row,
                      const struct seen *s)
{
    struct interfere_cells under = {{1, 0}, {1, 0}};

    if (s) {
        under = interfere_cells_under(mesh, s->leaf.quanta_low, s->leaf.quanta_high);
    }
    printf("row %s faces %d cells %d %d side %d x0 %d y %d of %d\n", name,
           (int)mesh->raw.face_count, mesh->grid_nx, mesh->grid_ny, 1 << mesh->grid_shift,
           mesh->grid_x0, mesh->grid_y0 + (2 * row + 1) * (1 << mesh->grid_shift) / 2, row);
    for (int32_t col = 0; col < mesh->grid_nx; col++) {
        uint32_t cell = (uint32_t)(row * mesh->grid_nx + col);
        bool asked = col >= under.col[0] && col <= under.col[1];

        for (uint32_t i = mesh->cell_start[cell]; i < mesh->cell_start[cell + 1]; i++) {
            const struct carom_zref *entry = &mesh->zrefs[i];

            printf("entry %d %d %d %d %s", col, entry->z0, entry->z1, entry->face,
                   asked ? fate(s, entry) : "unasked");
            for (int k = 0; k < 9; k++) {
                printf(" %d", mesh->raw.vertices[mesh->raw.faces[entry->face][k / 3]][k % 3]);
            }
            printf("\n");
        }
    }
}

/* The row below the leaf in which most entries have candidates. */
static int32_t richest_row(const struct seen *s)
{
    struct interfere_cells under =
        interfere_cells_under(s->b, s->leaf.quanta_low, s->leaf.quanta_high);
    int32_t richest = under.row[0], most = -1;

    for (int32_t row = under.row[0]; row <= under.row[1]; row++) {
        int32_t count = 0;

        for (int32_t col = under.col[0]; col <= under.col[1]; col++) {
            uint32_t cell = (uint32_t)(row * s->b->grid_nx + col);

            for (uint32_t i = s->b->cell_start[cell]; i < s->b->cell_start[cell + 1]; i++) {
                count += s->found[s->b->zrefs[i].face];
            }
        }
        if (count > most) {
            most = count;
            richest = row;
        }
    }
    return richest;
}

/* The leaf's swept box and its faces at mid-span, in quanta of b from b's origin. */
static void print_leaf(const struct seen *s)
{
    const struct interfere_leaf *l = &s->leaf;
    double one = 1 << (20 - s->b->raw.quantum_bits);

    printf("leaf faces %d candidates %d leaves %d box", l->leaf->face_count, (int)s->candidates,
           (int)s->a->leaf_count);
    for (int k = 0; k < 6; k++) {
        printf(" %d", k < 3 ? l->quanta_low[k] : l->quanta_high[k - 3]);
    }
    printf("\n");
    for (uint32_t i = 0; i < l->leaf->face_count; i++) {
        const uint8_t *corner = s->a->leaf_corners[l->leaf->first_face + i];

        printf("leafface");
        for (int k = 0; k < 9; k++) {
            printf(" %.2f",
                   (l->p[corner[k / 3]].c[k % 3] + (s->b->mass.centre.c[k % 3] >> 2)) / one);
        }
        printf("\n");
    }
}

/* ------------------------------------------------------------------ pictures */

static void picture(uint32_t toggles)
{
    view_toggles(toggles);
    expect(view_draw(), "draw");
    port_present();
}

int main(void)
{
    const char *name = port_option("scene") ? port_option("scene") : "head";
    struct carom_picture shown = {.format = CAROM_XRGB8888};
    struct port_fb fb;
    int frame = 0;

    port_init();
    fb = port_fb();
    shown.pixels = fb.pixels;
    shown.width = fb.width;
    shown.height = fb.height;
    shown.stride = fb.stride;
    expect(view_open(name, NULL), name);
    expect(view_size(&shown), "size");
    view_pause(false);
    view_slow(1);
    do {
        best.candidates = 0;
        expect(view_frame(), "step");
        if (++frame > FRAMES_MOST) {
            printf("it hits nothing\n");
            port_exit(1);
        }
    } while (view_stats()->hits == 0 || best.candidates == 0);
    printf("frame %d\n", frame);
    print_row("a", best.a, best.a->grid_ny / 2, NULL);
    print_leaf(&best);
    print_row("b", best.b, richest_row(&best), &best);
    view_zoom(4);
    picture(VIEW_FACES | VIEW_CELLS);
    picture(VIEW_FACES | VIEW_LEAVES);
    port_exit(0);
}
