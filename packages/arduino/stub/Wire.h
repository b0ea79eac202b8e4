/* SPDX-License-Identifier: MIT */
/* The part of Arduino's Wire that OledBox uses: data for a display goes to stub_display. */
#ifndef CAROM_STUB_WIRE_H
#define CAROM_STUB_WIRE_H

#include <stddef.h>
#include <stdint.h>

/* The bytes of the last picture, in the order in which they were sent. */
extern uint8_t stub_display[1024];
extern size_t stub_sent;

struct StubWire {
    int control;

    void begin()
    {
    }
    void beginTransmission(int)
    {
        control = -1;
    }
    int endTransmission()
    {
        return 0;
    }
    size_t write(uint8_t byte)
    {
        if (control < 0) {
            control = byte;
        } else if (control == 0x40) {
            stub_display[stub_sent++ % sizeof stub_display] = byte;
        }
        return 1;
    }
    size_t write(const uint8_t *bytes, size_t count)
    {
        for (size_t i = 0; i < count; i++) {
            write(bytes[i]);
        }
        return count;
    }
};
static StubWire Wire __attribute__((unused));

#endif
