/* SPDX-License-Identifier: MIT */
/* Lay a grid over a mesh, and list in each cell the faces above it: the mesh's own z-lists. */
#include "build.h"

/*
 * The number of cells of 2^shift quanta that cover an extent, and where they begin. Both ends share
 * the overhang, so that vertices on a regular grid do not fall on sides of cells. If that would
 * need a cell too many, an extent of whole cells gets no overhang.
 */
FIX_APART static int32_t fit_cells(int32_t low, int32_t high, int shift, int32_t *start)
{
    int32_t side = (int32_t)1 << shift;
    int32_t n = (high - low) / side + 1;

    if (n > MESH_GRID_SIDE_MAX && (high - low) % side == 0) {
        n--;
    }
    *start = low - (n * side - (high - low)) / 2;
    return n;
}

/* Lay the grid with cells of 2^shift quanta. Returns false if there are too many cells. */
static bool lay_grid(struct carom_mesh *mesh, int shift)
{
    int32_t nx = fit_cells(mesh->box[0][0], mesh->box[1][0], shift, &mesh->grid_x0);
    int32_t ny = fit_cells(mesh->box[0][1], mesh->box[1][1], shift, &mesh->grid_y0);

    if (nx > MESH_GRID_SIDE_MAX || ny > MESH_GRID_SIDE_MAX) {
        return false;
    }
    mesh->grid_shift = (uint8_t)shift;
    mesh->grid_nx = (uint8_t)nx;
    mesh->grid_ny = (uint8_t)ny;
    /* at least 3/2 faces a cell, hence up to 6; a single cell is always allowed */
    return nx * ny == 1 || (uint32_t)(3 * nx * ny) <= 2 * mesh->raw.face_count;
}

void mesh_scan_face(struct scan_cells *s, const struct carom_mesh *mesh, uint32_t face)
{
    struct scan_grid grid = mesh_grid(mesh);
    int32_t xy[3][2];

    for (int i = 0; i < 3; i++) {
        xy[i][0] = mesh->raw.vertices[mesh->raw.faces[face][i]][0];
        xy[i][1] = mesh->raw.vertices[mesh->raw.faces[face][i]][1];
    }
    scan_cells_begin(s, &grid, (const int32_t(*)[2])xy, 3, 0);
}

/* Count every cell's entries; returns their number. */
static uint32_t count_entries(const struct carom_mesh *mesh, uint32_t *count)
{
    uint32_t total = 0;

    memset(count, 0, (size_t)mesh->grid_nx * mesh->grid_ny * sizeof count[0]);
    for (uint32_t f = 0; f < mesh->raw.face_count; f++) {
        struct scan_cells scan;
        struct scan_run run;

        mesh_scan_face(&scan, mesh, f);
        while (scan_cells_next(&scan, &run)) {
            for (int32_t col = run.x0; col < run.x1; col++) {
                count[run.y * mesh->grid_nx + col]++;
                total++;
            }
        }
    }
    return total;
}

struct zface mesh_zface(const struct carom_mesh *mesh, uint32_t face)
{
    struct zface z;

    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            z.p[i][k] = mesh->raw.vertices[mesh->raw.faces[face][i]][k];
        }
    }
    z.grow = 0;
    return z;
}

bool mesh_list_face(const struct carom_mesh *mesh, uint32_t face, struct zlist *lists,
                    uint32_t *cells)
{
    struct scan_grid grid = mesh_grid(mesh);
    struct zface z = mesh_zface(mesh, face);
    struct scan_cells scan;
    struct scan_run run;
    uint32_t cell = 0;

    mesh_scan_face(&scan, mesh, face);
    while (scan_cells_next(&scan, &run)) {
        for (int32_t col = run.x0; col < run.x1; col++) {
            int16_t z0, z1;

            if (cell++ < *cells) {
                continue;
            }
            zface_interval(&z, &grid, col, run.y, &z0, &z1);
            if (!zlist_enter(lists, (uint32_t)(run.y * grid.nx + col), z0, z1, (uint16_t)face)) {
                return false;
            }
            ++*cells;
        }
    }
    return true;
}

/*
 * Fill the lists from their ends, last face first: `cell` holds the end of each list and is left
 * with its start, and a cell's faces are in ascending order.
 */
static void fill_lists(const struct carom_mesh *mesh, uint32_t *cell, struct carom_zref *zrefs)
{
    struct scan_grid grid = mesh_grid(mesh);

    for (uint32_t f = mesh->raw.face_count; f-- > 0;) {
        struct zface z = mesh_zface(mesh, f);
        struct scan_cells scan;
        struct scan_run run;

        mesh_scan_face(&scan, mesh, f);
        while (scan_cells_next(&scan, &run)) {
            for (int32_t col = run.x0; col < run.x1; col++) {
                struct carom_zref *entry = &zrefs[--cell[run.y * grid.nx + col]];

                zface_interval(&z, &grid, col, run.y, &entry->z0, &entry->z1);
                entry->face = (uint16_t)f;
            }
        }
    }
}

/* Sort a list by z1, highest first; equal ones keep their order. By insertion: lists are short. */
static void sort_list(struct carom_zref *list, uint32_t n)
{
    for (uint32_t i = 1; i < n; i++) {
        struct carom_zref entry = list[i];
        uint32_t place = i;

        for (; place > 0 && list[place - 1].z1 < entry.z1; place--) {
            list[place] = list[place - 1];
        }
        list[place] = entry;
    }
}

/*
 * True if a side of face f has all of face g outside or on it, seen from above. Bounds: differences
 * are < 2^16, the cross product < 2^33.
 */
static bool side_separates(const struct carom_mesh_raw *raw, uint32_t f, uint32_t g)
{
    for (int k = 0; k < 3; k++) {
        const int16_t *a = raw->vertices[raw->faces[f][k]];
        const int16_t *b = raw->vertices[raw->faces[f][fix_next(k)]];
        int outside = 0;

        for (int i = 0; i < 3; i++) {
            const int16_t *p = raw->vertices[raw->faces[g][i]];

            outside +=
                (int64_t)(b[0] - a[0]) * (p[1] - a[1]) - (int64_t)(b[1] - a[1]) * (p[0] - a[0]) <=
                0;
        }
        if (outside == 3) {
            return true;
        }
    }
    return false;
}

/* True if two faces of a list overlap seen from above: then the surface has two heights there. */
static bool list_overlaps(const struct carom_mesh_raw *raw, const struct carom_zref *list,
                          uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = 0; j < i; j++) {
            uint32_t f = list[i].face, g = list[j].face;

            if (!side_separates(raw, f, g) && !side_separates(raw, g, f)) {
                return true;
            }
        }
    }
    return false;
}

int mesh_build_zlists(struct mesh_builder *b)
{
    struct carom_mesh *mesh = b->mesh;
    const uint32_t n = mesh->raw.face_count;
    struct carom_zref *zrefs;
    uint32_t *cell;
    uint32_t total, end = 0, cells;
    int shift = 0;

    ARENA_CARVE(&b->arena, cell, CAROM_MESH_CELLS_(n) + 1);
    do {
        while (!lay_grid(mesh, shift)) {
            shift++;
        }
        total = count_entries(mesh, cell);
        shift++;
    } while (total > CAROM_MESH_ENTRIES_(n));
    cells = (uint32_t)mesh->grid_nx * mesh->grid_ny;
    for (uint32_t c = 0; c < cells; c++) {
        end += cell[c];
        cell[c] = end;
    }
    cell[cells] = total;
    ARENA_CARVE(&b->arena, zrefs, total);
    fill_lists(mesh, cell, zrefs);
    for (uint32_t c = 0; c < cells; c++) {
        struct carom_zref *list = &zrefs[cell[c]];

        sort_list(list, cell[c + 1] - cell[c]);
        if (mesh->raw.kind == CAROM_SURFACE &&
            list_overlaps(&mesh->raw, list, cell[c + 1] - cell[c])) {
            return CAROM_ERR_MESH_SURFACE;
        }
    }
    mesh->zref_count = total;
    mesh->cell_start = cell;
    mesh->zrefs = zrefs;
    return CAROM_OK;
}
