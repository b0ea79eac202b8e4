/* SPDX-License-Identifier: MIT */
/* The part of Arduino's header that the sketches use, for a machine without a core: Serial prints, no time passes. */
#ifndef CAROM_STUB_ARDUINO_H
#define CAROM_STUB_ARDUINO_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#define bitWrite(value, bit, on)                                                                   \
    ((value) = (uint8_t)((on) ? (value) | 1u << (bit) : (value) & ~(1u << (bit))))

struct StubSerial {
    void begin(unsigned long)
    {
    }
    void print(const char *text)
    {
        fputs(text, stdout);
    }
    void print(long number)
    {
        printf("%ld", number);
    }
    void println(const char *text)
    {
        puts(text);
    }
    void println(long number)
    {
        printf("%ld\n", number);
    }
};
static StubSerial Serial __attribute__((unused));

inline void delay(unsigned long)
{
}

void setup();
void loop();

#endif
