/* SPDX-License-Identifier: MIT */
/*
 * Run a Game Boy Advance image in mGBA, without a window: gba_run IMAGE.elf [ARGUMENT...]
 *
 * mGBA comes as a libretro core, which this loads: of libretro's interface only what is used here is
 * declared. The image is the .gba file beside the .elf; the arguments are written into the room that
 * port/gba/start.S leaves for them. What the program logs goes to stdout, its exit status is passed
 * on. Two arguments are also this program's own:
 *
 *   pictures=DIRECTORY  write the screen as DIRECTORY/frame-0001.ppm when the program asks for it
 *   press=N:KEYS,...    hold KEYS (a sum of the pad's bits) from the N-th such picture on
 */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROM_BYTES_MAX = 32 << 20, ARGUMENTS_AT = 0xc0, ARGUMENTS_BYTES = 256 };
enum { SILENT_FRAMES_MAX = 60 * 60, NEVER_ENDED = 124 };

/* libretro, as its API version 1 has it */
enum { PIXELS_RGB565 = 2, DEVICE_PAD = 1, PAD_KEYS = 12 };
enum { GET_CAN_DUPLICATE = 3, SET_PIXEL_FORMAT = 10, GET_VARIABLE = 15, GET_LOG_INTERFACE = 27 };
struct game {
    const char *path;
    const void *data;
    size_t size;
    const char *meta;
};
struct variable {
    const char *key, *value;
};
struct logger {
    void (*log)(int level, const char *format, ...);
};
enum { LOG_INFO = 1, LOG_WARN = 2, LOG_ERROR = 3 };

static struct {
    uint8_t rom[ROM_BYTES_MAX];
    const void *pixels; /* of the frame that was shown last */
    unsigned width, height;
    size_t pitch;
    const char *directory, *presses;
    unsigned pictures;
    bool wants_picture, ended;
    int status, silent_frames;
} run;

static void die(const char *what, const char *why)
{
    fprintf(stderr, "gba_run: %s: %s\n", what, why);
    exit(NEVER_ENDED);
}

/* ------------------------------------------------------- what the core calls */

/*
 * The program's lines come by mGBA's debug port, cut in pieces: a piece that is not the last of its
 * line as a warning, the exit status as an error.
 */
static void take_log(int level, const char *format, ...)
{
    static const char source[] = "GBA Debug: ";
    static bool inside;
    char text[512];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    text[strcspn(text, "\n")] = '\0';
    if (strncmp(text, source, sizeof source - 1) != 0) {
        return;
    }
    run.silent_frames = 0;
    if (level == LOG_ERROR) {
        run.ended = true;
        run.status = atoi(text + sizeof source - 1);
    } else if (!inside && strcmp(text + sizeof source - 1, "picture") == 0) {
        run.wants_picture = true;
    } else {
        inside = level == LOG_WARN;
        printf("%s%s", text + sizeof source - 1, inside ? "" : "\n");
        fflush(stdout);
    }
}

static bool environment(unsigned command, void *data)
{
    switch (command) {
    case GET_CAN_DUPLICATE:
        *(bool *)data = true;
        return true;
    case SET_PIXEL_FORMAT:
        return *(const int *)data == PIXELS_RGB565;
    case GET_LOG_INTERFACE:
        ((struct logger *)data)->log = take_log;
        return true;
    case GET_VARIABLE: {
        struct variable *variable = data;
        /* loops that wait must take the time they take */
        bool idle = strcmp(variable->key, "mgba_idle_optimization") == 0;

        variable->value = idle ? "Don't Remove" : NULL;
        return idle;
    }
    default:
        return false;
    }
}

static void take_frame(const void *pixels, unsigned width, unsigned height, size_t pitch)
{
    run.pixels = pixels ? pixels : run.pixels;
    run.width = width;
    run.height = height;
    run.pitch = pitch;
}

static void take_sample(int16_t left, int16_t right)
{
    (void)left;
    (void)right;
}

static size_t take_samples(const int16_t *samples, size_t frames)
{
    (void)samples;
    return frames;
}

static void poll_pad(void)
{
}

/* The keys that are held: of the last entry of `press` whose picture has come. */
static unsigned held(void)
{
    unsigned keys = 0, from;
    char *next;

    for (const char *entry = run.presses; entry && *entry; entry = *next ? next + 1 : next) {
        from = (unsigned)strtoul(entry, &next, 10);
        unsigned value = *next == ':' ? (unsigned)strtoul(next + 1, &next, 10) : 0;

        keys = from <= run.pictures ? value : keys;
        if (*next && *next != ',') {
            die("press", "not N:KEYS,...");
        }
    }
    return keys;
}

static int16_t pad_key(unsigned port, unsigned device, unsigned index, unsigned id)
{
    /* the pad's bits by libretro's numbers: B Y Select Start Up Down Left Right A X L R */
    static const uint16_t bit[PAD_KEYS] = {2, 0, 4, 8, 64, 128, 32, 16, 1, 0, 512, 256};

    return port == 0 && device == DEVICE_PAD && index == 0 && id < PAD_KEYS &&
           (held() & bit[id]) != 0;
}

/* ------------------------------------------------------------------ the rest */

static void write_picture(void)
{
    char name[512];
    FILE *file;

    run.pictures++;
    if (!run.directory) {
        return;
    }
    snprintf(name, sizeof name, "%s/frame-%04u.ppm", run.directory, run.pictures);
    file = fopen(name, "wb");
    if (!file) {
        die(name, "cannot be written");
    }
    fprintf(file, "P6 %u %u 255\n", run.width, run.height);
    for (unsigned y = 0; y < run.height; y++) {
        const uint16_t *row = (const void *)((const char *)run.pixels + y * run.pitch);

        for (unsigned x = 0; x < run.width; x++) {
            fputc((row[x] >> 11) * 255 / 31, file);
            fputc((row[x] >> 5 & 63) * 255 / 63, file);
            fputc((row[x] & 31) * 255 / 31, file);
        }
    }
    fclose(file);
}

static size_t read_rom(const char *image)
{
    size_t length = strlen(image), bytes;
    char name[512];
    FILE *file;

    snprintf(name, sizeof name, "%.*s.gba",
             (int)(length > 4 && strcmp(image + length - 4, ".elf") == 0 ? length - 4 : length),
             image);
    file = fopen(name, "rb");
    if (!file) {
        die(name, "cannot be read");
    }
    bytes = fread(run.rom, 1, sizeof run.rom, file);
    fclose(file);
    return bytes;
}

/* The arguments, the image's name first, each ended by a space. */
static void write_arguments(int count, char **arguments)
{
    char *room = (char *)run.rom + ARGUMENTS_AT;
    size_t used = 0;

    for (int i = 0; i < count; i++) {
        size_t length = strlen(arguments[i]);

        if (used + length + 2 > ARGUMENTS_BYTES) {
            die("arguments", "too long");
        }
        memcpy(room + used, arguments[i], length);
        room[used + length] = ' ';
        used += length + 1;
        if (strncmp(arguments[i], "pictures=", 9) == 0) {
            run.directory = arguments[i] + 9;
        } else if (strncmp(arguments[i], "press=", 6) == 0) {
            run.presses = arguments[i] + 6;
        }
    }
}

/* A function of the core; through memcpy, because C has no cast from an object to a function. */
static void load(void *core, const char *name, void *function)
{
    void *symbol = dlsym(core, name);

    if (!symbol) {
        die(name, "not in the core");
    }
    memcpy(function, &symbol, sizeof symbol);
}

int main(int count, char **arguments)
{
    void *core = dlopen(MGBA_CORE, RTLD_NOW);
    void (*init)(void), (*step)(void), (*set)(void (*)(void));
    bool (*load_game)(const struct game *);
    struct game game = {.data = run.rom};
    static const struct {
        const char *name;
        void (*callback)(void);
    } callbacks[] = {{"retro_set_environment", (void (*)(void))environment},
                     {"retro_set_video_refresh", (void (*)(void))take_frame},
                     {"retro_set_audio_sample", (void (*)(void))take_sample},
                     {"retro_set_audio_sample_batch", (void (*)(void))take_samples},
                     {"retro_set_input_poll", poll_pad},
                     {"retro_set_input_state", (void (*)(void))pad_key}};

    if (count < 2 || !core) {
        die(count < 2 ? "usage" : MGBA_CORE,
            count < 2 ? "gba_run IMAGE.elf [ARGUMENT...]" : dlerror());
    }
    game.size = read_rom(arguments[1]);
    write_arguments(count - 1, arguments + 1);
    for (size_t i = 0; i < sizeof callbacks / sizeof callbacks[0]; i++) {
        load(core, callbacks[i].name, &set);
        set(callbacks[i].callback);
    }
    load(core, "retro_init", &init);
    load(core, "retro_load_game", &load_game);
    load(core, "retro_run", &step);
    init();
    if (!load_game(&game)) {
        die(arguments[1], "mGBA does not take it");
    }
    while (!run.ended) {
        bool asked = run.wants_picture;

        if (run.silent_frames++ > SILENT_FRAMES_MAX) {
            die(arguments[1], "has said nothing for a minute");
        }
        step();
        if (asked) { /* the frame before was not drawn to its end when it asked */
            write_picture();
            run.wants_picture = false;
        }
    }
    return run.status;
}
