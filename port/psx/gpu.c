/* SPDX-License-Identifier: MIT */
/*
 * The display: a picture is drawn in the processor's memory; when it is complete, it is sent to the half of the graphics processor's
 * memory that is not shown.
 */
#include "port.h"
#include "psx.h"

enum { WIDTH = 320, HEIGHT = 240, HALF = 256 /* rows from one picture to the other */ };

#define GPU_DATA      REGISTER32(0x1f801810)
#define GPU_CONTROL   REGISTER32(0x1f801814)
#define GPU_READY     (1u << 26)
#define GPU_WANTS     (1u << 28) /* a block of data */
#define DMA_CONTROL   REGISTER32(0x1f8010f0)
#define DMA_GPU       (8u << 8)
#define DMA2_ADDRESS  REGISTER32(0x1f8010a0)
#define DMA2_BLOCKS   REGISTER32(0x1f8010a4)
#define DMA2_CONTROL  REGISTER32(0x1f8010a8)
#define DMA2_SEND     0x01000201u /* blocks, at the device's request */
#define DMA2_RUNS     0x01000000u
#define BLOCK_WORDS   16u
#define VERTICAL_SYNC 1u

/* Commands of the control register. */
#define RESET        0x00000000u
#define DISPLAY_ON   0x03000000u
#define TAKE_DMA     0x04000002u
#define SHOW_FROM(y) (0x05000000u | (uint32_t)(y) << 10)
#define COLUMNS_SHOWN                                                                              \
    0x06000000u | 0x260u | (0x260u + 8 * WIDTH) << 12 /* the left edge of a television */
#define ROWS_SHOWN    0x07000000u | 0x10u | (0x10u + HEIGHT) << 10
#define MODE_320_NTSC 0x08000001u

#define SEND_RECTANGLE  0xa0000000u
#define FORGET_TEXTURES 0x01000000u

static _Alignas(4) uint16_t pixels[HEIGHT][WIDTH];

void gpu_start(void)
{
    GPU_CONTROL = RESET;
    GPU_CONTROL = TAKE_DMA;
    GPU_CONTROL = COLUMNS_SHOWN;
    GPU_CONTROL = ROWS_SHOWN;
    GPU_CONTROL = MODE_320_NTSC;
    GPU_CONTROL = DISPLAY_ON;
    DMA_CONTROL |= DMA_GPU;
}

struct port_fb port_fb(void)
{
    struct port_fb fb = {.pixels = pixels,
                         .width = WIDTH,
                         .height = HEIGHT,
                         .stride = sizeof pixels[0],
                         .format = PORT_BGR555};

    return fb;
}

/* Send the framebuffer to the rows from y on of the graphics processor's memory. */
static void send(uint32_t y)
{
    while (!(GPU_CONTROL & GPU_READY)) {
    }
    GPU_DATA = FORGET_TEXTURES;
    GPU_DATA = SEND_RECTANGLE;
    GPU_DATA = y << 16;
    GPU_DATA = HEIGHT << 16 | WIDTH;
    while (!(GPU_CONTROL & GPU_WANTS)) {
    }
    DMA2_ADDRESS = (uint32_t)(uintptr_t)pixels;
    DMA2_BLOCKS = sizeof pixels / 4 / BLOCK_WORDS << 16 | BLOCK_WORDS;
    DMA2_CONTROL = DMA2_SEND;
    while (DMA2_CONTROL & DMA2_RUNS) {
    }
}

void port_present(void)
{
    static uint32_t shown;
    uint32_t next = HALF - shown;

    send(next);
    INTERRUPTS = ~VERTICAL_SYNC;
    while (!(INTERRUPTS & VERTICAL_SYNC)) {
    }
    GPU_CONTROL = SHOW_FROM(next);
    shown = next;
}
