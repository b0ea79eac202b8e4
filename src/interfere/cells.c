/* SPDX-License-Identifier: MIT */
/* The cells of b's grid under a box, and the highest z of b in them. */
#include "narrow.h"

/* Cell of a coordinate (quanta) along one axis of the grid, clamped to the grid. */
static int32_t clamp_cell(int32_t x, int32_t x0, int shift, int32_t n)
{
    int32_t cell = (x - x0) >> shift;

    return cell < 0 ? 0 : cell >= n ? n - 1 : cell;
}

struct interfere_cells interfere_cells_under(const struct carom_mesh *mb, const int32_t low[3],
                                             const int32_t high[3])
{
    int shift = mb->grid_shift;

    return (struct interfere_cells){
        {clamp_cell(low[0], mb->grid_x0, shift, mb->grid_nx),
         clamp_cell(high[0], mb->grid_x0, shift, mb->grid_nx)},
        {clamp_cell(low[1], mb->grid_y0, shift, mb->grid_ny),
         clamp_cell(high[1], mb->grid_y0, shift, mb->grid_ny)},
    };
}

/* Highest z of b in a cell; below every vertex if the cell is empty. */
static inline int32_t cell_top(const struct interfere *in, uint32_t cell)
{
    const struct carom_mesh *mb = in->b->def.mesh;
    const uint32_t *start = &mb->cell_start[cell];

    if (in->pooled) {
        uint16_t head = in->lists.head[cell];

        return head == ZLIST_NONE ? INT16_MIN - 1 : in->lists.entry[head].z1;
    }
    return start[0] == start[1] ? INT16_MIN - 1 : mb->zrefs[start[0]].z1;
}

int32_t interfere_highest(const struct interfere *in, const int32_t low[3], const int32_t high[3],
                          int32_t enough)
{
    const struct carom_mesh *mb = in->b->def.mesh;
    struct interfere_cells cells = interfere_cells_under(mb, low, high);
    int32_t top = INT16_MIN - 1;

    for (int32_t row = cells.row[0]; row <= cells.row[1]; row++) {
        uint32_t cell = (uint32_t)(row * mb->grid_nx + cells.col[0]);

        for (int32_t n = cells.col[1] - cells.col[0]; n >= 0; n--) {
            int32_t z = cell_top(in, cell++);

            top = z > top ? z : top;
            if (z >= enough) {
                return z;
            }
        }
    }
    return top;
}

bool interfere_reaches_leaf(const struct interfere *in)
{
    const struct interfere_leaf *l = in->leaf;
    int32_t low = l->quanta_low[2];

    return interfere_highest(in, l->quanta_low, l->quanta_high, low) >= low;
}
