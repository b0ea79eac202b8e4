/* SPDX-License-Identifier: MIT */
/*
 * host_view - the viewer of examples/view.h, tested from outside: distances and places of the
 * camera, in double; a hand that does not make a body swing; pause and slow motion; toggles. Each
 * toggle must change the picture, and switching it off must restore the picture.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "carom_body.h"
#include "lib/lab.h"
#include "scene.h"
#include "view.h"
#include "lib/viewed.h"

#define ALL 255u

/* -------------------------------------------------------------------- camera */

static void arm_of(const struct carom_camera *camera, double arm[3])
{
    for (int k = 0; k < 3; k++) {
        arm[k] = lab_double(camera->eye.c[k] - camera->target.c[k], 32);
    }
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Distance in the picture between a place and a pixel's middle, pixels. */
static double seen_off(const struct carom_camera *camera, const carom_v3_q32 *place, int x, int y)
{
    struct carom_ray ray;
    double way[3], to[3], along = 0, off = 0, length = 0;

    lab_expect(carom_view_ray(camera, WIDTH, HEIGHT, 256 * x, 256 * y, &ray), "ray");
    for (int k = 0; k < 3; k++) {
        way[k] = lab_double(ray.way.c[k], 32);
        to[k] = lab_double(place->c[k] - camera->eye.c[k], 32);
        length += way[k] * way[k];
    }
    for (int k = 0; k < 3; k++) {
        along += way[k] * to[k] / length;
    }
    for (int k = 0; k < 3; k++) {
        off += pow(to[k] - along * way[k], 2);
    }
    return sqrt(off) / length_of(to) * HEIGHT;
}

static void test_orbit(void)
{
    struct carom_camera first, camera;
    double before[3], after[3], most = 0, turn;
    carom_v3_q32 middle;

    viewed_open("head");
    viewed_show(WIDTH, HEIGHT);
    first = *view_camera();
    arm_of(&first, before);
    for (int i = 0; i < 20000; i++) {
        view_orbit(viewed_range(-60, 60), viewed_range(-60, 60));
        camera = *view_camera();
        arm_of(&camera, after);
        most = fmax(most, fabs(length_of(after) / length_of(before) - 1));
        most = fmax(most, memcmp(&camera.target, &first.target, sizeof first.target) ? 1 : 0);
    }
    lab_report(most < 1e-6, "view/orbit_keeps_distance", "%.1e off after 20000 turns", most);
    view_home();
    camera = *view_camera();
    lab_report(!memcmp(&camera, &first, sizeof first), "view/home", "the scene's camera");
    view_orbit(100, 0);
    arm_of(view_camera(), after);
    turn = atan2(before[0] * after[1] - before[1] * after[0],
                 before[0] * after[0] + before[1] * after[1]);
    lab_report(turn < -0.3 && turn > -1 && fabs(after[2] - before[2]) < 1e-5, "view/orbit_turns",
               "by %.3f radians, %.1e up", turn, after[2] - before[2]);
    view_home();
    view_zoom(3);
    arm_of(view_camera(), after);
    most = length_of(after) / length_of(before) - pow(7. / 8, 3);
    lab_report(fabs(most) < 1e-6, "view/zoom", "%.1e off", most);
    view_zoom(-3);
    arm_of(view_camera(), after);
    most = length_of(after) / length_of(before) - 1;
    lab_report(fabs(most) < 1e-6, "view/zoom_back", "%.1e off", most);
    view_home();
    middle = view_camera()->target;
    view_pan(40, -30);
    most = seen_off(view_camera(), &middle, WIDTH / 2 + 40, HEIGHT / 2 - 30);
    lab_report(most < 0.5, "view/pan", "the place is %.2f pixels off the pointer", most);
}

/* ---------------------------------------------------------------------- hand */

static void place_of(int body, double place[3])
{
    struct carom_body_state state;

    lab_expect(carom_body_get(view_world(), body, &state), "body");
    for (int k = 0; k < 3; k++) {
        place[k] = lab_double(state.position.c[k], 32);
    }
}

/* A pixel that shows a moving body, near the middle of its visible part. */
static bool find_body(int *x, int *y)
{
    long sum_x = 0, sum_y = 0, count = 0;

    for (int j = 0; j < HEIGHT; j += 2) {
        for (int i = 0; i < WIDTH; i += 2) {
            struct carom_ray_hit hit;
            const struct carom_picture picture = {.width = WIDTH, .height = HEIGHT};

            if (carom_draw_pick(view_world(), view_camera(), &picture, i, j, NULL, &hit) == 1 &&
                hit.body == SCENE_BODY) {
                sum_x += i;
                sum_y += j;
                count++;
            }
        }
    }
    if (count > 0) {
        *x = (int)(sum_x / count);
        *y = (int)(sum_y / count);
    }
    return count > 0;
}

/* The place of the box that a pixel shows. */
static carom_v3_q32 place_at(int x, int y)
{
    const struct carom_picture picture = {.width = WIDTH, .height = HEIGHT};
    struct carom_ray_hit hit;
    carom_v3_q32 local;

    lab_expect(carom_draw_pick(view_world(), view_camera(), &picture, x, y, NULL, &hit), "pick");
    lab_expect(carom_body_local_point(view_world(), SCENE_BODY, &hit.point, &local), "place");
    return local;
}

static double place_off(const carom_v3_q32 *local, int x, int y)
{
    carom_v3_q32 point;

    lab_expect(carom_body_world_point(view_world(), SCENE_BODY, local, &point), "place");
    return seen_off(view_camera(), &point, x, y);
}

/*
 * A grabbed place of a box goes to the pointer and not beyond. A box that is let go on the way
 * flies on.
 */
static void test_hand(void)
{
    double rest[3], held[3], later[3], off, nearest = 1e9, swing = 0, far = 0;
    int x = 0, y = 0;
    carom_v3_q32 place;
    bool grabbed;

    viewed_open("box");
    viewed_show(WIDTH, HEIGHT);
    viewed_run(150);
    place_of(SCENE_BODY, rest);
    grabbed = find_body(&x, &y) && view_grab(x, y);
    place = place_at(x, y);
    viewed_run(30);
    place_of(SCENE_BODY, held);
    for (int k = 0; k < 3; k++) {
        far = fmax(far, fabs(held[k] - rest[k]));
    }
    lab_report(grabbed && far < 0.02, "view/hand_at_rest", "%.4f off where it was held still", far);
    y -= 50;
    view_drag(x, y);
    for (int i = 0; i < 120; i++) {
        viewed_run(1);
        off = place_off(&place, x, y);
        nearest = fmin(nearest, off);
        swing = fmax(swing, off - nearest);
    }
    place_of(SCENE_BODY, held);
    lab_report(off < 1.5 && swing < 2 && held[2] > rest[2] + 0.3, "view/hand_lifts",
               "%.2f pixels off, %.2f back at most, %.2f up", off, swing, held[2] - rest[2]);
    while (x < WIDTH - 8) {
        x += 8;
        view_drag(x, y);
        viewed_run(1);
    }
    place_of(SCENE_BODY, held);
    view_drop();
    viewed_run(10);
    place_of(SCENE_BODY, later);
    far = hypot(later[0] - held[0], later[1] - held[1]);
    lab_report(far > 0.3 && later[2] < held[2] + 0.3, "view/hand_throws", "%.2f on in 10 frames",
               far);
    lab_report(!view_grab(2, 2) && !view_grab(-5, 900), "view/hand_of_nothing",
               "the sky is not taken");
}

/* ---------------------------------------------------------------------- time */

static void test_time(void)
{
    int steps = 0;

    viewed_open("box");
    view_pause(true);
    steps += view_frame();
    view_single();
    view_single();
    lab_report(steps == 0 && view_step_count() == 2, "view/pause", "%d steps, then %d", steps,
               (int)view_step_count());
    view_pause(false);
    lab_report(view_single() == 0, "view/single_when_paused", "else nothing");
    view_slow(4);
    for (int i = 0; i < 12; i++) {
        steps += view_frame();
    }
    lab_report(steps == 3 && view_step_count() == 5, "view/slow", "%d of 12", steps);
    lab_expect(view_restart(), "restart");
    lab_report(view_step_count() == 0, "view/restart", "frame %d", (int)view_step_count());
}

/* --------------------------------------------------------------------- looks */

static int differ(const uint32_t (*a)[STRIDE])
{
    int count = 0;

    for (int y = 0; y < HEIGHT + 2 * SPARE_Y; y++) {
        for (int x = 0; x < STRIDE; x++) {
            count += a[y][x] != viewed_pixels[y][x];
        }
    }
    return count;
}

/* Run to a frame that has contacts to show. */
static void run_to_contact(int least)
{
    const struct carom_face_ref *faces;

    for (int i = 0; i < 300; i++) {
        viewed_run(1);
        if (view_stats()->contacts > 0 && carom_interfering_faces(view_world(), &faces) >= least) {
            return;
        }
    }
}

/*
 * Each toggle changes the picture of this scene, and leaves no trace when it is off; no pixel
 * outside of the picture is written.
 */
static void test_toggles(const char *scene, int least_faces, uint32_t toggles)
{
    static uint32_t plain[HEIGHT + 2 * SPARE_Y][STRIDE];
    int least = WIDTH * HEIGHT, trace = 0, outside = 0, twice = 0;
    char name[64];

    viewed_open(scene);
    viewed_show(WIDTH, HEIGHT);
    run_to_contact(least_faces);
    view_toggles(0);
    lab_expect(view_draw(), "draw");
    memcpy(plain, viewed_pixels, sizeof plain);
    for (uint32_t bit = 1; bit <= toggles; bit *= 2) {
        static uint32_t once[HEIGHT + 2 * SPARE_Y][STRIDE];
        int count;

        if (!(toggles & bit)) {
            continue;
        }
        view_toggles(bit);
        lab_expect(view_draw(), "draw");
        count = differ((const uint32_t(*)[STRIDE])plain);
        if (count < 20) {
            printf("# toggle %u changes %d pixels\n", bit, count);
        }
        least = count < least ? count : least;
        memcpy(once, viewed_pixels, sizeof once);
        lab_expect(view_draw(), "draw");
        /* the bars show the time of the picture itself */
        twice += bit == VIEW_BARS ? 0 : differ((const uint32_t(*)[STRIDE])once);
        view_toggles(0);
        lab_expect(view_draw(), "draw");
        trace += differ((const uint32_t(*)[STRIDE])plain);
    }
    view_toggles(ALL);
    lab_expect(view_draw(), "draw");
    for (int y = 0; y < HEIGHT + 2 * SPARE_Y; y++) {
        for (int x = 0; x < STRIDE; x++) {
            const bool in = y >= SPARE_Y && y < SPARE_Y + HEIGHT && x < WIDTH;

            outside += !in && viewed_pixels[y][x] != UNTOLD;
        }
    }
    snprintf(name, sizeof name, "view/toggles_%s", scene);
    lab_report(least >= 20 && trace == 0 && twice == 0 && outside == 0, name,
               "the least shows in %d pixels, %d stay, %d change, %d outside", least, trace, twice,
               outside);
}

int main(void)
{
    test_orbit();
    test_hand();
    test_time();
    test_toggles("head", 30, ALL);
    test_toggles("car", 4, ALL);
    return lab_finish();
}
