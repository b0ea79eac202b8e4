/* SPDX-License-Identifier: MIT */
/* Numbers into and out of a snapshot, byte by byte, hashed on the way. */
#include "stream.h"

uint64_t stream_word(struct stream *s, uint64_t v, int bytes)
{
    uint64_t read = 0;

    for (int i = 0; i < bytes; i++) {
        uint8_t b = (uint8_t)(v >> (8 * i));

        if (s->loading) {
            if (s->at >= s->size) {
                s->failed = true;
                return 0;
            }
            b = s->in[s->at];
        } else if (s->out) {
            s->out[s->at] = b;
        }
        read |= (uint64_t)b << (8 * i);
        s->fnv = fnv_add(s->fnv, b);
        s->at++;
    }
    return read;
}

void stream_64(struct stream *s, int64_t *v)
{
    uint64_t read = stream_word(s, (uint64_t)*v, 8);

    if (s->loading) {
        *v = (int64_t)read;
    }
}

void stream_32(struct stream *s, int32_t *v)
{
    uint32_t read = (uint32_t)stream_word(s, (uint32_t)*v, 4);

    if (s->loading) {
        *v = (int32_t)read;
    }
}

void stream_16(struct stream *s, uint16_t *v)
{
    uint16_t read = (uint16_t)stream_word(s, *v, 2);

    if (s->loading) {
        *v = read;
    }
}

void stream_8(struct stream *s, uint8_t *v)
{
    uint8_t read = (uint8_t)stream_word(s, *v, 1);

    if (s->loading) {
        *v = read;
    }
}

void stream_expect(struct stream *s, uint32_t v, int bytes)
{
    if (stream_word(s, v, bytes) != v) {
        s->failed = true;
    }
}

void stream_vector64(struct stream *s, int64_t v[3])
{
    for (int k = 0; k < 3; k++) {
        stream_64(s, &v[k]);
    }
}

void stream_vector32(struct stream *s, int32_t *v, int n)
{
    for (int k = 0; k < n; k++) {
        stream_32(s, &v[k]);
    }
}

void stream_flag(struct stream *s, bool *v)
{
    uint8_t read = *v;

    stream_8(s, &read);
    if (s->loading) {
        s->failed = s->failed || read > 1;
        *v = read != 0;
    }
}

uint32_t stream_count(struct stream *s, uint32_t count, uint32_t most)
{
    count = (uint32_t)stream_word(s, count, 4);
    if (count > most) {
        s->failed = true;
        count = 0;
    }
    return count;
}

bool stream_section(struct stream *s, uint32_t tag, bool wanted)
{
    if (s->loading) {
        wanted = s->size - s->at > 12;
        for (uint32_t i = 0; i < 4 && wanted; i++) {
            wanted = s->in[s->at + i] == (uint8_t)(tag >> 8 * i);
        }
    }
    if (wanted) {
        stream_expect(s, tag, 4);
    }
    return wanted;
}
