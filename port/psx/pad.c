/* SPDX-License-Identifier: MIT */
/*
 * The pad in the first socket, a byte at a time: its address, "give me your state", and three bytes more, in which it answers with its
 * kind and the keys that are held.
 */
#include "port.h"
#include "psx.h"

#define PAD_DATA      REGISTER8(0x1f801040)
#define PAD_STATUS    REGISTER16(0x1f801044) /* the lower half: pcsxr has no other */
#define PAD_MODE      REGISTER16(0x1f801048)
#define PAD_CONTROL   REGISTER16(0x1f80104a)
#define PAD_BAUD      REGISTER16(0x1f80104e)
#define CAN_SEND      (1u << 0)
#define HAS_ANSWER    (1u << 1)
#define ACKNOWLEDGED  (1u << 9)
#define SELECTED      0x1003u /* the pad may answer, and raise an interrupt with each byte */
#define TAKE_BACK     0x0010u
#define RESET         0x0040u
#define BITS_8        0x000du
#define BAUD_250000   0x0088u
#define PAD_INTERRUPT (1u << 7)
#define WAITS_MOST    300 /* reads of the status: 100 microseconds and more */

enum { ADDRESS, ASK, SIGN, KEYS, MORE_KEYS, BYTES };
#define PAD_SIGN 0x5a

/* The pad's bits, the lowest first, by the bits of port.h; 0 for keys that programs do not know. */
static const uint8_t keys_of[16] = {PORT_PAD_SELECT,
                                    0,
                                    0,
                                    PORT_PAD_START,
                                    PORT_PAD_UP,
                                    PORT_PAD_RIGHT,
                                    PORT_PAD_DOWN,
                                    PORT_PAD_LEFT,
                                    0,
                                    0,
                                    0,
                                    0,
                                    0,
                                    PORT_PAD_B,
                                    PORT_PAD_A,
                                    0};

void pad_start(void)
{
    PAD_CONTROL = RESET;
    PAD_MODE = BITS_8;
    PAD_BAUD = BAUD_250000;
}

/* Wait for a bit of the status. True if it came. */
static int wait_for(uint32_t bit)
{
    for (int i = 0; i < WAITS_MOST; i++) {
        if (PAD_STATUS & bit) {
            return 1;
        }
    }
    return 0;
}

/* Send a byte and get one; -1 if nobody answers. A pad acknowledges all but the last byte. */
static int exchange(uint8_t byte, int is_last)
{
    int answer;

    if (!wait_for(CAN_SEND)) {
        return -1;
    }
    PAD_DATA = byte;
    if (!wait_for(HAS_ANSWER)) {
        return -1;
    }
    answer = PAD_DATA;
    if (!is_last && !wait_for(ACKNOWLEDGED)) {
        return -1;
    }
    PAD_CONTROL = SELECTED | TAKE_BACK;
    INTERRUPTS = ~PAD_INTERRUPT;
    return answer;
}

uint32_t port_input(void)
{
    static const uint8_t ask[BYTES] = {0x01, 0x42, 0, 0, 0};
    int answer[BYTES] = {0};
    uint32_t held, keys = 0;

    PAD_CONTROL = SELECTED;
    for (int i = 0; i < BYTES && answer[i ? i - 1 : 0] >= 0; i++) {
        answer[i] = exchange(ask[i], i == BYTES - 1);
    }
    PAD_CONTROL = 0;
    if (answer[SIGN] != PAD_SIGN || answer[MORE_KEYS] < 0) {
        return 0;
    }
    held = ~((uint32_t)answer[MORE_KEYS] << 8 | (uint32_t)answer[KEYS]);
    for (int i = 0; i < 16; i++) {
        keys |= held >> i & 1 ? keys_of[i] : 0u;
    }
    return keys;
}
