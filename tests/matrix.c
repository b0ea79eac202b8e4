/* SPDX-License-Identifier: MIT */
/*
 * matrix - the plays of plays.h, for tools/matrix.py. Every build of this program must print the
 * same hashes. It uses only the engine and the console, so it runs without a C library, too.
 *
 * Options: scene=NAME (else all)  frames=2000  at=500  fill=0 (the byte that memory holds at first)
 *          each=1   a line a frame: its state hash
 *          trace=N  a line for each stage that ends in frame N: a digest of the world
 *          save=1   a line with the snapshot after frame `at`, where there is memory for one
 *          reload=1 after every frame save and load the snapshot; 2: also in a world made anew, which goes on
 *          asks=0   leave what is asked out of the hashes: interfering faces may be those of the frame before
 *          load=F   go on from a snapshot file, as if it had been saved after frame `at`
 *
 * A scene's line is "scene NAME FRAMES AWAKE HASH FUTURE": the frames, and how many of them end
 * with a body awake; HASH covers the state hash, status, events and answers of every frame; FUTURE
 * covers the same of the frames after `at`, as many as before it. "absent NAME ..." is a scene
 * that does not fit into the memory.
 */
#include "lib/plays.h"
#include "port.h"
#include "world/world.h"

#ifdef SCENE_ROM
/* a board with little memory: it saves no snapshots */
#define MESH_BYTES     8
#define WORLD_BYTES    SCENE_WORLD_BYTES
#define SNAPSHOT_BYTES 8
#else
#define MESH_BYTES  SCENE_MESH_BYTES
#define WORLD_BYTES CAROM_WORLD_BYTES(SCENE_PILE_CAPS)
#ifdef __linux__
#define SNAPSHOT_BYTES CAROM_SNAPSHOT_BYTES(SCENE_PILE_CAPS)
#else
#define SNAPSHOT_BYTES 8192
#endif
#endif

/*
 * The sheet moves in one frame out of so many, because moving is expensive; so the sheet stops and
 * starts.
 */
enum { SHEET_EVERY = 4 };

static _Alignas(8) uint8_t mesh_block[MESH_BYTES];
static _Alignas(8) uint8_t world_block[WORLD_BYTES];
static uint8_t snapshot[SNAPSHOT_BYTES];

/* The options of a run. */
static struct {
    int frames, at, fill, trace;
    int reload;
    bool each, save, asks;
    const char *scene, *load;
} wanted;

/* A running play. */
struct run {
    const struct play *play;
    struct scene scene;
    struct carom_world *world;
    int bodies, awake;
    uint64_t hash, future;
};

/* ------------------------------------------------------------------------- text */

static void put(const char *text)
{
    while (*text) {
        port_putc(*text++);
    }
}

static void put_hex(uint64_t v, int digits)
{
    while (digits-- > 0) {
        port_putc("0123456789abcdef"[v >> (4 * digits) & 15]);
    }
}

static void put_number(int v)
{
    char digits[12];
    int n = sizeof digits - 1;

    digits[n] = '\0';
    do {
        digits[--n] = (char)('0' + v % 10);
        v /= 10;
    } while (v > 0);
    put(&digits[n]);
}

static bool same(const char *a, const char *b)
{
    while (*a && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

static int number(const char *name, int otherwise)
{
    const char *digits = port_option(name);
    int v = 0;

    while (digits && *digits >= '0' && *digits <= '9') {
        v = 10 * v + (*digits++ - '0');
    }
    return digits ? v : otherwise;
}

/* Accept a result that is not an error; print an error and exit. */
static int expect(const struct run *run, int frame, int result, const char *what)
{
    if (result < 0) {
        put("error ");
        put(run->play->name);
        put(", frame ");
        put_number(frame);
        put(", ");
        put(what);
        put(": ");
        put(carom_result_text(result));
        put("\n");
        port_exit(1);
    }
    return result;
}

/* ------------------------------------------------------------------------ trace */

/*
 * The engine reads the clock when a step begins, at the end of every stage and once more. Here the
 * clock counts its readings, so each stage that ends adds one to its own time. The next reading
 * shows which stage it was.
 */
static struct {
    struct carom_world *world; /* NULL: not tracing */
    uint32_t time, booked[CAROM_STAGE_COUNT];
    bool open;
    uint64_t state, found;
} trace;

/* Print what the last stage left. */
static void trace_close(void)
{
    const uint32_t *booked = trace.world->stats.ticks;
    int stage = -1;

    for (int i = 0; i < CAROM_STAGE_COUNT; i++) {
        stage = booked[i] > 0 && booked[i] != trace.booked[i] ? i : stage;
        trace.booked[i] = booked[i];
    }
    if (trace.open && stage >= 0) {
        put("mark ");
        put(carom_stage_name(stage));
        put(" ");
        put_hex(trace.state, 16);
        put(" ");
        put_hex(trace.found, 16);
        put("\n");
    }
    trace.open = false;
}

/* The same number, if a machine stored the halves in either order. */
static uint64_t halves(int64_t v)
{
    return (uint64_t)(uint32_t)v + ((uint64_t)v >> 32);
}

/* After a solve, and until a path is set, the path's numbers lie where v and g were. */
static uint64_t fold_path(const struct body_path *path, uint64_t digest)
{
    for (int k = 0; k < 3; k++) {
        digest = play_fold(digest, halves(path->v.c[k]));
        digest = play_fold(digest, halves(path->g.c[k]));
        digest = play_fold(digest, (uint64_t)(int64_t)path->u.c[k]);
    }
    return digest;
}

/* Fold the findings of stages that no state holds: paths, pairs and counts. */
static uint64_t fold_found(const struct carom_world *w)
{
    const struct carom_stats *stats = &w->stats;
    const uint32_t counts[] = {stats->substeps,   stats->hits,  stats->gathers,
                               stats->candidates, stats->roots, stats->refinements,
                               stats->contacts,   stats->sweeps};
    uint64_t digest = PLAY_DIGEST;

    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        digest = play_fold(digest, counts[i]);
    }
    for (uint32_t i = 0; i < w->body_count; i++) {
        if (broad_active(&w->bodies[i], &world_now(w)->bodies[i])) {
            digest = fold_path(&w->bodies[i].path, digest);
        }
    }
    for (uint32_t i = 0; i < w->pools[CAROM_POOL_pairs].used; i++) {
        digest = play_fold(digest, (uint64_t)w->pairs[i].a << 16 | w->pairs[i].b);
    }
    return digest;
}

static uint32_t tick(void)
{
    struct carom_world *w = trace.world;

    if (w) {
        struct world_state *now = w->now;

        trace_close();
        /* a step builds the state that is not current */
        w->now = world_next(w);
        trace.state = carom_world_hash(w);
        w->now = now;
        trace.found = fold_found(w);
        trace.open = true;
    }
    return ++trace.time;
}

/* ------------------------------------------------------------------------- a play */

/* Make the world of the run's scene, with nothing done to it yet. */
static int make_world(struct run *run)
{
    struct carom_config config = scene_config();

    config.caps = run->scene.caps;
    config.ticks = wanted.trace ? tick : NULL;
    return scene_make(&run->scene, &config, world_block, sizeof world_block, &run->world);
}

/*
 * Build the meshes and make the world. An error means too little memory, or a fault of the scene.
 */
static int load(struct run *run, const struct play *play)
{
    struct scene *scene = &run->scene;
    int result;

    memset(mesh_block, wanted.fill, sizeof mesh_block);
    memset(world_block, wanted.fill, sizeof world_block);
    run->play = play;
    run->awake = 0;
    run->hash = run->future = PLAY_DIGEST;
    result = scene_load(scene, play->scene, NULL, mesh_block, sizeof mesh_block);
    if (result < 0) {
        return result;
    }
    scene->other_count = play->bodies ? play->bodies - 1 : scene->other_count;
    run->bodies = 1 + scene->other_count;
    scene->body.mass_q20 = 1 << 20;
    if (play->arrange) {
        play->arrange(scene);
    }
    return make_world(run);
}

/* Load the snapshot that was saved after frame `at`. */
static void go_on(struct run *run)
{
    long bytes = port_read_file(wanted.load, snapshot, sizeof snapshot);
    int result = CAROM_OK;

    if (run->scene.sheet) {
        scene_sheet_shape(run->scene.sheet->vertices, wanted.at / SHEET_EVERY);
        result = carom_surface_set(run->world, SCENE_GROUND,
                                   (const int16_t(*)[3])run->scene.sheet->vertices);
    }
    expect(run, wanted.at, result, "surface");
    expect(run, wanted.at, bytes < 0 ? CAROM_ERR_FORMAT : CAROM_OK, wanted.load);
    expect(run, wanted.at, carom_snapshot_load(run->world, snapshot, (size_t)bytes), "load");
}

static void save(const struct run *run)
{
    int bytes = carom_snapshot_save(run->world, snapshot, sizeof snapshot);

    if (bytes == CAROM_ERR_MEMORY) {
        return;
    }
    expect(run, wanted.at, bytes, "save");
    put("snapshot ");
    put(run->play->name);
    put(" ");
    for (int i = 0; i < bytes; i++) {
        put_hex(snapshot[i], 2);
    }
    put("\n");
}

static void take_back(struct run *run, int frame, int bytes, uint64_t hash)
{
    expect(run, frame, carom_snapshot_load(run->world, snapshot, (size_t)bytes), "reload");
    expect(run, frame, carom_world_hash(run->world) == hash ? CAROM_OK : CAROM_ERR_FORMAT, "hash");
}

/* Save, and load in this world; then in one made anew, which goes on in its place. */
static void reload(struct run *run, int frame)
{
    const struct carom_caps *c = &run->scene.caps;
    const size_t most = CAROM_SNAPSHOT_BYTES(c->bodies, c->pairs, c->contacts, c->faces, c->entries,
                                             c->candidates, c->joints, c->extras, c->hits);
    const uint64_t hash = carom_world_hash(run->world);
    const int bytes =
        expect(run, frame, carom_snapshot_save(run->world, snapshot, sizeof snapshot), "save");

    expect(run, frame, (size_t)bytes <= most ? CAROM_OK : CAROM_ERR_MEMORY, "size");
    take_back(run, frame, bytes, hash);
    if (wanted.reload > 1) {
        expect(run, frame, make_world(run), "make");
        take_back(run, frame, bytes, hash);
    }
}

static bool is_awake(const struct run *run)
{
    for (int body = SCENE_BODY; body <= run->bodies; body++) {
        struct carom_body_state state;

        if (carom_body_get(run->world, body, &state) >= 0 && !state.asleep && !state.out) {
            return true;
        }
    }
    return false;
}

/* Fold a frame's results. */
static uint64_t fold_frame(struct run *run, int frame, int status, uint64_t digest)
{
    digest = play_fold_step(run->world, status, digest);
    if (run->play->ask && wanted.asks) {
        expect(run, frame, run->play->ask(run->world, &run->scene, frame, &digest), "ask");
    }
    return digest;
}

static void step(struct run *run, int frame)
{
    const bool traced = frame == wanted.trace;
    uint64_t seen;
    int status;

    if (run->scene.sheet && frame % SHEET_EVERY == 0) {
        expect(run, frame, scene_before(&run->scene, run->world, frame / SHEET_EVERY), "scene");
    }
    if (run->play->act) {
        expect(run, frame, run->play->act(run->world, run->bodies, frame), "act");
    }
    trace.world = traced ? run->world : NULL;
    trace.open = false;
    memset(trace.booked, 0, sizeof trace.booked);
    status = expect(run, frame, carom_world_step(run->world), "step");
    if (traced) {
        trace_close();
    }
    trace.world = NULL;

    seen = fold_frame(run, frame, status, PLAY_DIGEST);
    run->hash = play_fold(run->hash, seen);
    run->future =
        frame > wanted.at && frame <= 2 * wanted.at ? play_fold(run->future, seen) : run->future;
    run->awake += is_awake(run);
    if (wanted.each) {
        put("frame ");
        put_number(frame);
        put(" ");
        put_hex(seen, 16);
        put("\n");
    }
}

static void perform(const struct play *play)
{
    static struct run run;
    int result = load(&run, play);

    if (result < 0) {
        put("absent ");
        put(play->name);
        put(" ");
        put(carom_result_text(result));
        put("\n");
        return;
    }
    if (wanted.load) {
        go_on(&run);
    }
    for (int frame = wanted.load ? wanted.at + 1 : 1; frame <= wanted.frames; frame++) {
        step(&run, frame);
        if (wanted.save && frame == wanted.at) {
            save(&run);
        }
        if (wanted.reload) {
            reload(&run, frame);
        }
    }
    put("scene ");
    put(play->name);
    put(" ");
    put_number(wanted.frames);
    put(" ");
    put_number(run.awake);
    put(" ");
    put_hex(run.hash, 16);
    put(" ");
    put_hex(run.future, 16);
    put("\n");
}

int main(void)
{
    port_init();
    wanted.frames = number("frames", 2000);
    wanted.at = number("at", 500);
    wanted.fill = number("fill", 0);
    wanted.trace = number("trace", 0);
    wanted.each = number("each", 0) != 0;
    wanted.save = number("save", 0) != 0;
    wanted.asks = number("asks", 1) != 0;
    wanted.reload = number("reload", 0);
    wanted.scene = port_option("scene");
    wanted.load = port_option("load");
    for (int i = 0; i < PLAYS; i++) {
        if (!wanted.scene || same(wanted.scene, plays[i].name)) {
            perform(&plays[i]);
        }
    }
    port_exit(0);
}
