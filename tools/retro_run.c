/* SPDX-License-Identifier: MIT */
/*
 * Run an image for a games machine in an emulator, without a window: retro_run IMAGE.elf [ARGUMENT...]
 *
 * The emulator is a libretro core, which this program loads. The image is the file beside the .elf
 * with the suffix of a machine; the arguments are written into the room that the image has for
 * them. The program's output goes to stdout, and its exit status is passed on. Two arguments are
 * also this program's own:
 *
 *   pictures=DIRECTORY  write the screen as DIRECTORY/frame-0001.ppm when the program asks for it
 *   press=N:KEYS,...    hold KEYS (a sum of the pad's bits) from the N-th such picture on
 */
#define _XOPEN_SOURCE 700 /* nftw, mkdtemp */
#include "retro_run.h"

#include <dlfcn.h>
#include <ftw.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ROM_BYTES_MAX = 32 << 20, ARGUMENTS_BYTES = 256 };
enum { SILENT_FRAMES_MAX = 10 * 60 * 60, NEVER_ENDED = 124 };

/* libretro, as its API version 1 has it */
enum { PIXELS_RGB565 = 2, DEVICE_PAD = 1, PAD_KEYS = 12 };
enum {
    GET_CAN_DUPLICATE = 3,
    GET_SYSTEM_DIRECTORY = 9,
    SET_PIXEL_FORMAT = 10,
    GET_VARIABLE = 15,
    GET_LOG_INTERFACE = 27,
    GET_SAVE_DIRECTORY = 31
};
struct game {
    const char *path;
    const void *data;
    size_t size;
    const char *meta;
};
struct logger {
    void (*log)(int level, const char *format, ...);
};

static const struct machine *const machines[] = {&retro_gba, &retro_nds};

static struct {
    const struct machine *machine;
    uint8_t rom[ROM_BYTES_MAX];
    char name[512], folder[64], copy[128];
    struct frame frame; /* the frame shown last */
    const char *directory, *presses;
    FILE *out;              /* the real stdout; cores that print do not get it */
    unsigned pictures, age; /* frames since the program asked for a picture */
    bool wants_picture, ended;
    int status, silent_frames;
} run;

_Noreturn void retro_die(const char *what, const char *why)
{
    fprintf(stderr, "retro_run: %s: %s\n", what, why);
    exit(NEVER_ENDED);
}

/* --------------------------------------------------- what the machines call */

/* Write out a line when it is complete. */
void retro_putc(char c)
{
    static char line[4096];
    static size_t length;

    run.silent_frames = 0;
    if (c != '\n') {
        line[length++] = c;
    }
    if (c == '\n' && length == 7 && memcmp(line, "picture", length) == 0) {
        run.wants_picture = true;
        run.age = 0;
        length = 0;
    } else if (c == '\n' || length == sizeof line) {
        fwrite(line, 1, length, run.out);
        length = 0;
        if (c == '\n') {
            fputc(c, run.out);
            fflush(run.out);
        }
    }
}

void retro_end(int status)
{
    run.ended = true;
    run.status = status;
}

uint16_t retro_pixel(const struct frame *frame, unsigned x, unsigned y)
{
    return ((const uint16_t *)(const void *)((const char *)frame->pixels + y * frame->pitch))[x];
}

/* ------------------------------------------------------- what the core calls */

static void take_log(int level, const char *format, ...)
{
    char text[512];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    text[strcspn(text, "\n")] = '\0';
    if (run.machine->log) {
        run.machine->log(level, text);
    }
}

static bool get_option(struct option *wanted)
{
    wanted->value = NULL;
    for (const struct option *option = run.machine->options; option->key; option++) {
        if (strcmp(wanted->key, option->key) == 0) {
            wanted->value = option->value;
        }
    }
    return wanted->value != NULL;
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
    case GET_SYSTEM_DIRECTORY:
    case GET_SAVE_DIRECTORY:
        *(const char **)data = run.folder;
        return true;
    case GET_VARIABLE:
        return get_option(data);
    default:
        return false;
    }
}

static void take_frame(const void *pixels, unsigned width, unsigned height, size_t pitch)
{
    run.frame = (struct frame){pixels ? pixels : run.frame.pixels, width, height, pitch};
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

/* The held keys: those of the last entry of `press` whose picture has arrived. */
static unsigned held(void)
{
    unsigned keys = 0, from;
    char *next;

    for (const char *entry = run.presses; entry && *entry; entry = *next ? next + 1 : next) {
        from = (unsigned)strtoul(entry, &next, 10);
        unsigned value = *next == ':' ? (unsigned)strtoul(next + 1, &next, 10) : 0;

        keys = from <= run.pictures ? value : keys;
        if (*next && *next != ',') {
            retro_die("press", "not N:KEYS,...");
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
        retro_die(name, "cannot be written");
    }
    fprintf(file, "P6 %u %u 255\n", run.machine->width, run.machine->height);
    for (unsigned y = 0; y < run.machine->height; y++) {
        for (unsigned x = 0; x < run.machine->width; x++) {
            uint16_t pixel = retro_pixel(&run.frame, x, y);

            fputc((pixel >> 11) * 255 / 31, file);
            fputc((pixel >> 5 & 63) * 255 / 63, file);
            fputc((pixel & 31) * 255 / 31, file);
        }
    }
    fclose(file);
}

/* The image beside the program, and its machine. */
static size_t read_rom(const char *image)
{
    size_t length = strlen(image), bytes;
    FILE *file = NULL;

    length -= length > 4 && strcmp(image + length - 4, ".elf") == 0 ? 4 : 0;
    for (size_t i = 0; i < sizeof machines / sizeof machines[0] && !file; i++) {
        run.machine = machines[i];
        snprintf(run.name, sizeof run.name, "%.*s%s", (int)length, image, run.machine->suffix);
        file = fopen(run.name, "rb");
    }
    if (!file) {
        retro_die(image, "there is no image of a machine beside it");
    }
    bytes = fread(run.rom, 1, sizeof run.rom, file);
    fclose(file);
    return bytes;
}

/* The arguments, the image's name first, each ended by a space. */
static void write_arguments(int count, char **arguments)
{
    char *room = (char *)run.rom + run.machine->arguments_at;
    size_t used = 0;

    for (int i = 0; i < count; i++) {
        size_t length = strlen(arguments[i]);

        if (used + length + 2 > ARGUMENTS_BYTES) {
            retro_die("arguments", "too long");
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

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *place)
{
    (void)status;
    (void)kind;
    (void)place;
    return remove(path);
}

static void remove_folder(void)
{
    nftw(run.folder, remove_entry, 4, FTW_DEPTH);
}

/*
 * For cores that read a file: write the image with its arguments to a folder that exists during the
 * run. A core may write a cartridge's saved data to it.
 */
static void write_rom(size_t bytes)
{
    FILE *file;

    snprintf(run.folder, sizeof run.folder, "/tmp/retro_run-XXXXXX");
    if (!mkdtemp(run.folder)) {
        retro_die(run.folder, "cannot be made");
    }
    atexit(remove_folder);
    snprintf(run.copy, sizeof run.copy, "%s/image%s", run.folder, run.machine->suffix);
    file = fopen(run.copy, "wb");
    if (!file || fwrite(run.rom, 1, bytes, file) != bytes || fclose(file) != 0) {
        retro_die(run.copy, "cannot be written");
    }
}

/* Some cores print to stdout; keep the real one. */
static void keep_stdout(void)
{
    run.out = fdopen(dup(STDOUT_FILENO), "w");
    if (!run.out || !freopen("/dev/null", "w", stdout)) {
        retro_die("stdout", "cannot be kept");
    }
}

/*
 * Load a function of the core; through memcpy, because C has no cast from an object to a function.
 */
static void load(void *core, const char *name, void *function)
{
    void *symbol = dlsym(core, name);

    if (!symbol) {
        retro_die(name, "not in the core");
    }
    memcpy(function, &symbol, sizeof symbol);
}

static void *open_core(void)
{
    char name[512];
    void *core, (*set)(void (*)(void));
    static const struct {
        const char *name;
        void (*callback)(void);
    } callbacks[] = {{"retro_set_environment", (void (*)(void))environment},
                     {"retro_set_video_refresh", (void (*)(void))take_frame},
                     {"retro_set_audio_sample", (void (*)(void))take_sample},
                     {"retro_set_audio_sample_batch", (void (*)(void))take_samples},
                     {"retro_set_input_poll", poll_pad},
                     {"retro_set_input_state", (void (*)(void))pad_key}};

    snprintf(name, sizeof name, "%s/%s", CORES, run.machine->core);
    core = dlopen(name, RTLD_NOW);
    if (!core) {
        retro_die(name, dlerror());
    }
    for (size_t i = 0; i < sizeof callbacks / sizeof callbacks[0]; i++) {
        load(core, callbacks[i].name, &set);
        set(callbacks[i].callback);
    }
    return core;
}

/* Run frame by frame until the program ends. */
static void play(void (*step)(void))
{
    while (!run.ended) {
        if (run.silent_frames++ > SILENT_FRAMES_MAX) {
            retro_die(run.name, "has said nothing for ten minutes");
        }
        step();
        if (run.machine->look) {
            run.machine->look(&run.frame);
        }
        if (run.wants_picture && run.age++ >= run.machine->late) {
            write_picture();
            run.wants_picture = false;
        }
    }
}

int main(int count, char **arguments)
{
    void *core;
    void (*init)(void), (*step)(void);
    bool (*load_game)(const struct game *);
    struct game game = {.path = run.copy, .data = run.rom};

    if (count < 2) {
        retro_die("usage", "retro_run IMAGE.elf [ARGUMENT...]");
    }
    game.size = read_rom(arguments[1]);
    write_arguments(count - 1, arguments + 1);
    write_rom(game.size);
    keep_stdout();
    core = open_core();
    load(core, "retro_init", &init);
    load(core, "retro_load_game", &load_game);
    load(core, "retro_run", &step);
    init();
    if (!load_game(&game)) {
        retro_die(run.name, "the core does not take it");
    }
    play(step);
    return run.status;
}
