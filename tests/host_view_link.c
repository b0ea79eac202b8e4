/* SPDX-License-Identifier: MIT */
/*
 * host_view_link - links of the viewer. A link of a random session leads to the same states, no
 * matter what the viewer shows meanwhile. Text that is no link is refused and changes nothing.
 */
#include <stdio.h>
#include <string.h>

#include "lib/lab.h"
#include "view.h"
#include "lib/viewed.h"

#define FRAMES 240
#define LOOKS  4 /* states of a session that are compared */
#define LINK   (1 << 18)

/* One random action of a user in a frame, or a change of the view alone. */
static void act(int *grabs)
{
    switch (viewed_range(0, 11)) {
    case 0:
        view_keys((uint32_t)viewed_range(0, 255));
        break;
    case 1:
    case 2:
        for (int tries = 0, held = 0; tries < 12 && !held; tries++) {
            held = view_grab(viewed_range(0, WIDTH - 1), viewed_range(0, HEIGHT - 1));
            *grabs += held;
        }
        break;
    case 3:
        view_drop();
        break;
    default:
        view_drag(viewed_range(-20, WIDTH + 20), viewed_range(-20, HEIGHT + 20));
    }
}

static void look(void)
{
    switch (viewed_range(0, 7)) {
    case 0:
        view_orbit(viewed_range(-50, 50), viewed_range(-50, 50));
        break;
    case 1:
        view_zoom(viewed_range(-1, 1));
        break;
    case 2:
        view_toggles((uint32_t)viewed_range(0, 255));
        lab_expect(view_draw(), "draw");
        break;
    case 3:
        view_pan(viewed_range(-5, 5), viewed_range(-5, 5));
        break;
    default:
        break;
    }
}

struct session {
    char link[LINK];
    int32_t frame[LOOKS];
    uint64_t hash[LOOKS];
    int grabs;
};

static void play(struct session *s, const char *scene)
{
    viewed_open(scene);
    s->grabs = 0;
    for (int i = 0; i < LOOKS; i++) {
        for (int n = 0; n < FRAMES / LOOKS && view_frame() > 0; n++) {
            look();
            if (n % 4 == 0) {
                act(&s->grabs);
            }
        }
        view_frame(); /* an action is a part of the link after its frame */
        s->frame[i] = view_step_count();
        s->hash[i] = view_hash();
    }
    lab_expect(view_link(s->link, LINK), "link");
}

/* Follow the link in a view of another size whose camera and toggles change meanwhile. */
static bool follows(const struct session *s)
{
    static char again[LINK];
    int last, ignored = 0;

    viewed_open("box");
    viewed_show(WIDTH / 2, HEIGHT / 3);
    last = view_follow(s->link);
    if (last < 0 || last > s->frame[LOOKS - 1]) {
        return false;
    }
    for (int i = 0; i < LOOKS; i++) {
        while (view_step_count() < s->frame[i] && view_frame() > 0) {
            look();
            if (view_step_count() < last) {
                act(&ignored);
            }
        }
        if (view_step_count() != s->frame[i] || view_hash() != s->hash[i]) {
            printf("# %s: frame %d, not %d\n", view_scene(), (int)view_step_count(),
                   (int)s->frame[i]);
            return false;
        }
    }
    return ignored == 0 && view_link(again, LINK) > 0 && strcmp(again, s->link) == 0;
}

static void test_links(void)
{
    static const char *const scenes[] = {"box",     "pile",     "stack10", "sheet",
                                         "car",     "walker",   "door",    "chain",
                                         "crusher", "conveyor", "lockstep"};
    static struct session s;
    int grabs = 0, touched = 0, failed = 0, count = 0;

    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        viewed_show(WIDTH, HEIGHT);
        play(&s, scenes[i]);
        grabs += s.grabs;
        failed += !follows(&s);
        viewed_open(scenes[i]);
        viewed_run(s.frame[LOOKS - 1]);
        touched += view_hash() != s.hash[LOOKS - 1];
        count++;
    }
    lab_report(failed == 0, "view/links_replay", "%d of %d scenes differ", failed, count);
    /* a hand has no effect on a crusher's block and on packets that the scene places, and may
     * miss */
    lab_report(grabs >= 20 && touched >= count / 2, "view/hands_matter",
               "%d grabs, %d scenes go otherwise", grabs, touched);
}

/* Links that are cut, changed or invented are refused and change nothing, or are valid. */
static void test_hostile(void)
{
    /* clang-format off */
    static const char *const bad[] = {
        "", "~", "bo", "user", "box~", "box~A", "box~B", "box~BE~", "box~BG______H", "box~______HAA", "box ", "box~BE/",
        "box~BFAgggggggggggggggggggggg", "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa~BE"};
    /* clang-format on */
    static struct session s;
    static char text[LINK];
    uint64_t hash;
    size_t length;
    int cut = 0, taken = 0, kept = 0, ran = 0;

    viewed_show(WIDTH, HEIGHT);
    play(&s, "pile");
    viewed_open("box");
    viewed_run(20);
    hash = view_hash();
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        taken += view_follow(bad[i]) >= 0;
    }
    length = strlen(s.link);
    for (size_t n = 5; n < length; n++) {
        memcpy(text, s.link, n);
        text[n] = 0;
        cut += view_follow(text) >= 0;
    }
    lab_report(taken == 0 && cut == 0, "view/bad_links", "%d made up, %d of %d cut ones are taken",
               taken, cut, (int)length - 5);
    lab_report(view_hash() == hash && view_step_count() == 20 && !strcmp(view_scene(), "box"),
               "view/bad_links_change_nothing", "frame %d of %s", (int)view_step_count(),
               view_scene());
    for (int i = 0; i < 2000; i++) {
        memcpy(text, s.link, length + 1);
        for (int n = viewed_range(1, 4); n > 0; n--) {
            text[viewed_range(5, (int)length - 1)] = (char)viewed_range(32, 126);
        }
        if (view_follow(text) >= 0) {
            kept++;
            for (int n = 0; n < 40 && view_frame() > 0; n++) {
                ran++;
            }
        }
    }
    lab_report(kept > 20 && kept < 2000 && ran > 20 * kept, "view/changed_links",
               "%d of 2000 are links, which run %d frames", kept, ran);
}

/* -------------------------------------------------------------------- a mesh */

static void test_user(void)
{
    static int16_t vertices[4][3] = {
        {9000, 9000, 9000}, {9000, -9000, -9000}, {-9000, 9000, -9000}, {-9000, -9000, 9000}};
    static uint16_t faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    struct carom_mesh_raw raw = {
        (const int16_t(*)[3])vertices, (const uint16_t(*)[3])faces, 4, 4, 12, CAROM_SOLID};
    char text[64];
    uint64_t first;

    lab_expect(view_open("user", &raw), "user");
    memset(vertices, 0, sizeof vertices); /* the viewer has its own copy */
    viewed_run(60);
    first = view_hash();
    lab_expect(view_restart(), "restart");
    viewed_run(60);
    lab_report(view_hash() == first && view_step_count() == 60, "view/user", "twice the same");
    lab_report(view_link(text, sizeof text) == CAROM_ERR_ARGUMENT, "view/user_has_no_link", "none");
    lab_report(view_open("none", NULL) < 0 && view_frame() < 0 && view_draw() < 0 &&
                   view_link(text, sizeof text) < 0 && !view_grab(5, 5),
               "view/no_scene", "nothing goes on");
}

int main(void)
{
    test_links();
    test_hostile();
    test_user();
    return lab_finish();
}
