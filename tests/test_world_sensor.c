/* SPDX-License-Identifier: MIT */
/* Sensors: what is in them, to the frame; and nothing else notices them. */
#include <stdlib.h>
#include <string.h>

#include "lib/boxes.h"

enum { PLATE, BOX, FLOOR, ZONE };

static uint8_t saved[4096];

static void begin(void)
{
    boxes_begin();
    boxes_make(PLATE, 2048, 2048, 16);
    boxes_make(BOX, 256, 200, 150);
    boxes_make(FLOOR, 4096, 4096, 256);
    boxes_make(ZONE, 1024, 1024, 512);
}

static int add_sensor(struct carom_world *w, int mesh, int x, int y, int z, bool stationary)
{
    struct carom_body_def def = boxes_def(mesh, x, y, z);

    def.sensor = true;
    def.stationary = stationary;
    return boxes_add(w, &def);
}

/* A box falls through a zone; its height tells when it overlaps. */
static void test_fall(void)
{
    struct carom_world *w;
    int sensor, box, begins = 0, ends = 0;
    bool was = false;

    begin();
    w = boxes_world(0);
    sensor = add_sensor(w, ZONE, 0, 0, 0, true);
    {
        struct carom_body_def def = boxes_def(BOX, 10, 20, 1500);

        box = boxes_add(w, &def);
    }
    for (int frame = 0; frame < 60; frame++) {
        int64_t z_q32;
        bool is;

        boxes_step(w, 1);
        z_q32 = boxes_state(w, box).position.c[2];
        is = carom_abs(z_q32) <= BOXES_Q32(512 + 150);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, box), is && !was);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_END, sensor, box), was && !is);
        begins += is && !was;
        ends += was && !is;
        was = is;
    }
    CHECK_EQ(begins, 1);
    CHECK_EQ(ends, 1);
}

/*
 * A fast box goes through a thin plate: both events come in one frame. A box beside the plate has
 * none.
 */
static void test_through(void)
{
    struct test_random r = {3};
    int through = 0, beside = 0;

    begin();
    boxes_config.gravity = (carom_v3_q40){{0, 0, 0}};
    for (int i = 0; i < 60; i++) {
        struct carom_world *w = boxes_world(0);
        struct carom_body_def def;
        int x = (int)test_random_range(&r, -3000, 3000), sensor, box, begins, ends;
        bool moving = i % 3 == 0, hits = x > -2048 - 256 && x < 2048 + 256;

        def = boxes_def(BOX, x, 0, 1000);
        def.velocity.c[2] = BOXES_Q40(-2500);
        def.spin.c[2] = i % 2 ? CAROM_RATIO(1, 10, 40) : 0;
        if (carom_abs(carom_abs(x) - 2048) < 400) {
            continue; /* the answer would depend on how it turns */
        }
        box = boxes_add(w, &def);
        sensor = add_sensor(w, PLATE, 0, 0, 0, !moving);
        boxes_step(w, 1);
        begins = boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, box);
        ends = boxes_events(w, CAROM_EVENT_SENSOR_END, sensor, box);
        CHECK_EQ(begins, hits);
        CHECK_EQ(ends, hits);
        CHECK_NEAR(boxes_state(w, box).position.c[2], BOXES_Q32(-1500), 64);
        boxes_step(w, 1);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, box), 0);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_END, sensor, box), 0);
        through += hits;
        beside += !hits;
    }
    CHECK_MORE(through, 10);
    CHECK_MORE(beside, 5);
}

/* Bodies that fall, hit, lie and sleep do so bit for bit as without sensors. */
static void test_unnoticed(void)
{
    int seen = 0;

    begin();
    for (int moving = 0; moving < 2; moving++) {
        struct carom_world *w[2];
        int sensor = 0;

        for (int n = 0; n < 2; n++) {
            struct carom_body_def def = boxes_def(FLOOR, 0, 0, -256);

            w[n] = boxes_world(n);
            def.stationary = true;
            CHECK_EQ(boxes_add(w[n], &def), 0);
            for (int i = 0; i < 4; i++) {
                def = boxes_def(BOX, 60 * i, 30 * i, 300 + 500 * i);
                def.restitution_q30 = CAROM_ONE_Q30 / 2;
                def.spin.c[i % 3] = CAROM_RATIO(1, 20, 40);
                CHECK_EQ(boxes_add(w[n], &def), 1 + i);
            }
        }
        if (moving) {
            struct carom_body_def def = boxes_def(BOX, 700, 0, 900);

            def.sensor = true;
            def.velocity = (carom_v3_q40){{BOXES_Q40(-8), 0, BOXES_Q40(20)}};
            def.spin = (carom_v3_q40){{BOXES_Q40(700), BOXES_Q40(300), 0}};
            sensor = boxes_add(w[1], &def);
        } else {
            sensor = add_sensor(w[1], ZONE, 100, 0, 500, true);
        }
        for (int frame = 0; frame < 160; frame++) {
            for (int n = 0; n < 2; n++) {
                boxes_step(w[n], 1);
            }
            for (int body = 1; body <= 4; body++) {
                struct carom_body_state one = boxes_state(w[0], body);
                struct carom_body_state other = boxes_state(w[1], body);

                CHECK(boxes_same(&one, &other));
                seen += boxes_events(w[1], CAROM_EVENT_SENSOR_BEGIN, sensor, body);
            }
        }
        CHECK(boxes_state(w[1], 1).asleep);
    }
    CHECK_MORE(seen, 5);
}

/* A world with a box that falls asleep on a floor, number 0. Returns its number. */
static int add_sleeper(struct carom_world **w)
{
    struct carom_body_def def = boxes_def(FLOOR, 0, 0, -256);
    int box;

    begin();
    *w = boxes_world(0);
    def.stationary = true;
    boxes_add(*w, &def);
    def = boxes_def(BOX, 0, 0, 151);
    box = boxes_add(*w, &def);
    boxes_step(*w, 60);
    CHECK(boxes_state(*w, box).asleep);
    return box;
}

/* A new sensor finds a sleeping body, a removed one loses it, and the body sleeps on. */
static void test_asleep(void)
{
    struct carom_world *w;
    int box = add_sleeper(&w), sensor, size;

    sensor = add_sensor(w, ZONE, 0, 0, 0, true);
    CHECK(boxes_state(w, box).asleep);
    boxes_step(w, 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, box), 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, 0), 0);
    boxes_step(w, 5);
    size = carom_snapshot_save(w, saved, sizeof saved);
    CHECK_MORE(size, 0);
    CHECK_EQ(boxes_set(w, sensor, 5000, 0, 0, 0), CAROM_OK);
    CHECK(boxes_state(w, box).asleep);
    boxes_step(w, 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_END, sensor, box), 1);
    /* as before: the body is inside, and that is no new event */
    CHECK_EQ(carom_snapshot_load(w, saved, (size_t)size), CAROM_OK);
    boxes_step(w, 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, box), 0);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_END, sensor, box), 0);
    CHECK(boxes_state(w, box).asleep);
    /* a body that is set outside */
    CHECK_EQ(boxes_set(w, box, 0, 3000, 151, 0), CAROM_OK);
    boxes_step(w, 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_END, sensor, box), 1);
    /* a sensor that is removed while a body is inside */
    CHECK_EQ(boxes_set(w, box, 0, 0, 151, 0), CAROM_OK);
    boxes_step(w, 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, box), 1);
    CHECK_EQ(carom_body_remove(w, sensor), CAROM_OK);
    boxes_step(w, 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_END, sensor, box), 0);
}

/*
 * Two sensors do not see each other; filters apply; a body may be wholly inside, and be set there.
 */
static void test_who(void)
{
    struct carom_world *w;
    struct carom_body_def def;
    int sensor, inside, filtered;
    const struct carom_event *events;

    begin();
    boxes_config.gravity = (carom_v3_q40){{0, 0, 0}};
    w = boxes_world(0);
    sensor = add_sensor(w, ZONE, 0, 0, 0, true);
    add_sensor(w, BOX, 0, 0, 0, false);
    def = boxes_def(BOX, 0, 0, 0);
    inside = boxes_add(w, &def);
    def = boxes_def(BOX, 700, 0, 0);
    def.filter = (struct carom_filter){1, 0xfffe, 0};
    filtered = boxes_add(w, &def);
    boxes_step(w, 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, inside), 1);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, filtered), 0);
    CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor + 1, inside), 1);
    CHECK_EQ(carom_events(w, &events), 2);
    CHECK_EQ(boxes_state(w, inside).velocity.c[0], 0);
}

/*
 * A sensor is put around a box that sleeps, and the next step reports the box: also if a load was refused in between, and if a
 * snapshot of that moment was loaded.
 */
static void test_put_around(void)
{
    for (int load = 0; load < 3; load++) {
        struct carom_world *w;
        int box = add_sleeper(&w), sensor, bytes;

        sensor = add_sensor(w, ZONE, 0, 0, 600, true);
        CHECK(boxes_state(w, box).asleep);
        bytes = carom_snapshot_save(w, saved, sizeof saved);
        CHECK_MORE(bytes, 0);
        if (load == 1) {
            saved[bytes - 1] ^= 1;
            CHECK_EQ(carom_snapshot_load(w, saved, (size_t)bytes), CAROM_ERR_FORMAT);
        } else if (load == 2) {
            CHECK_EQ(carom_snapshot_load(w, saved, (size_t)bytes), CAROM_OK);
        }
        boxes_step(w, 1);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, box), 1);
        boxes_step(w, 1);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, box), 0);
    }
}

/* A turn about an axis whose cosine and sine are c / 5 and s / 5, and its quaternion's w and part along the axis. */
static const struct {
    int c, s;
    int32_t w_q30, v_q30;
} turns[] = {{5, 0, CAROM_ONE_Q30, 0}, {3, 4, 960383883, 480191942}, {4, 3, 1018640935, 339546978}};

/* A box as seen from above: centre, half sides, turn. */
struct rectangle {
    int x, y, half[2], turn;
};

/* The gap between two rectangles along the sides of `of`, in 25ths of a unit; below 0 if they overlap there. */
static int gap_along(const struct rectangle *of, const struct rectangle *a,
                     const struct rectangle *b)
{
    int most = INT32_MIN;

    for (int side = 0; side < 2; side++) {
        const int c = turns[of->turn].c, s = turns[of->turn].s;
        const int along[2] = {side == 0 ? c : -s, side == 0 ? s : c};
        int gap = 5 * abs((b->x - a->x) * along[0] + (b->y - a->y) * along[1]);

        for (int n = 0; n < 2; n++) {
            const struct rectangle *r = n == 0 ? a : b;
            const int rc = turns[r->turn].c, rs = turns[r->turn].s;

            gap -= r->half[0] * abs(rc * along[0] + rs * along[1]) +
                   r->half[1] * abs(rc * along[1] - rs * along[0]);
        }
        most = gap > most ? gap : most;
    }
    return most;
}

/*
 * A sensor and a box whose faces lie in one plane, or the box touches the plane of the sensor's top with an edge: the box is in
 * the sensor only where they overlap as seen from above. In the plane, that is asked of faces that no plane of theirs separates.
 */
static void test_in_one_plane(void)
{
    struct test_random r = {5};
    int within = 0, beside = 0;

    begin();
    boxes_config.gravity = (carom_v3_q40){{0, 0, 0}};
    boxes_make(ZONE, 400, 40, 150);
    boxes_make(BOX, 300, 60, 150);
    for (int i = 0; i < 300; i++) {
        const int rolled = i % 2;
        struct rectangle a = {0, 0, {400, 40}, (int)test_random_range(&r, 0, 2)};
        struct rectangle b = {(int)test_random_range(&r, -500, 500),
                              (int)test_random_range(&r, -500, 500),
                              {300, 60},
                              (int)test_random_range(&r, 0, 2)};
        const int64_t w_q30 = turns[b.turn].w_q30, v_q30 = turns[b.turn].v_q30;
        struct carom_body_def def;
        struct carom_world *w = boxes_world(0);
        int sensor, box, gap, along_b;

        def = boxes_def(ZONE, 0, 0, 0);
        def.sensor = true;
        def.stationary = true;
        def.rotation = (carom_quat_q30){{turns[a.turn].w_q30, 0, 0, turns[a.turn].v_q30}};
        sensor = boxes_add(w, &def);
        def = boxes_def(BOX, b.x, b.y, rolled ? 150 + (60 * 4 + 150 * 3) / 5 : 0);
        def.rotation = (carom_quat_q30){{turns[b.turn].w_q30, 0, 0, turns[b.turn].v_q30}};
        if (rolled) { /* then about its x, by the second turn */
            const int64_t rw_q30 = turns[1].w_q30, rv_q30 = turns[1].v_q30;

            def.rotation = (carom_quat_q30){
                {(int32_t)(w_q30 * rw_q30 >> 30), (int32_t)(w_q30 * rv_q30 >> 30),
                 (int32_t)(v_q30 * rv_q30 >> 30), (int32_t)(v_q30 * rw_q30 >> 30)}};
            b.half[1] = (60 * 3 + 150 * 4) / 5;
        }
        box = boxes_add(w, &def);
        gap = gap_along(&a, &a, &b);
        along_b = gap_along(&b, &a, &b);
        gap = along_b > gap ? along_b : gap;
        if (abs(gap) < 50 || (rolled && gap < 0)) {
            continue; /* too near to say; or the edge is at the sensor's top */
        }
        boxes_step(w, 1);
        CHECK_EQ(boxes_events(w, CAROM_EVENT_SENSOR_BEGIN, sensor, box), gap < 0);
        within += gap < 0;
        beside += gap > 0;
    }
    CHECK_MORE(within, 20);
    CHECK_MORE(beside, 100);
}

const struct test tests_world_sensor[] = {{"world_sensor/fall", test_fall},
                                          {"world_sensor/through", test_through},
                                          {"world_sensor/unnoticed", test_unnoticed},
                                          {"world_sensor/asleep", test_asleep},
                                          {"world_sensor/put_around", test_put_around},
                                          {"world_sensor/who", test_who},
                                          {"world_sensor/in_one_plane", test_in_one_plane},
                                          {0}};
