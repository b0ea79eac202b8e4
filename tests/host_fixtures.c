/* SPDX-License-Identifier: MIT */
/*
 * host_fixtures - published and special scenes. Each is judged by an independent checker of
 * crossings, and by its own rule: hold, stand, fall, turn or slide. A row says
 *
 *   frames, frames with crossings and the deepest in skins, frames cut short, the longest run of
 *   frames in which a body stood still that had to move, how far the farthest body is from where it
 *   began, what the scene should do and whether it did, milliseconds of the worst step and of all
 *
 *   host_fixtures              the short form
 *   host_fixtures long         every scene in full
 *   host_fixtures NAME...      these in full
 *   host_fixtures NAME frames  a line for each frame
 *   host_fixtures list         their names
 *   host_fixtures csv ...      rows as CSV
 */
#include <stdio.h>
#include <string.h>

#include "lib/fixture.h"

#define BRIEF_SECONDS 4
#define LONG_SECONDS  120

static const struct fixture_scene *const groups[] = {
    fixture_stacks, fixture_links, fixture_arches, fixture_cards, fixture_movers, fixture_contacts};
#define GROUPS (sizeof groups / sizeof *groups)

static struct {
    bool whole, csv, talk;
} options;

static void play(const struct fixture_scene *scene)
{
    struct fixture *f = fixture_new(scene);
    const struct fixture_tally *t = &f->tally;

    fixture_run(f, options.whole ? scene->frames : scene->brief,
                options.whole ? LONG_SECONDS : BRIEF_SECONDS, options.talk);
    if (options.csv) {
        printf("%s,%ld,%ld,%.2f,%ld,%ld,%.5f,%s,%s,%.2f,%.0f,\"%s\"\n", scene->name, t->frames,
               t->crossed, t->depth, t->cut, t->still, fixture_farthest(f), scene->should,
               f->passed ? "yes" : "no", t->worst_ms, t->total_ms, f->said);
        fflush(stdout);
    } else {
        char name[80];

        snprintf(name, sizeof name, "%s %s", scene->name, scene->should);
        lab_report(f->passed, name,
                   "%ld frames, %ld cross, deepest %.2f skin, %ld cut short, %ld still, drift "
                   "%.5f, worst %.2f ms, total %.0f ms; %s",
                   t->frames, t->crossed, t->depth, t->cut, t->still, fixture_farthest(f),
                   t->worst_ms, t->total_ms, f->said);
    }
    fixture_free(f);
}

int main(int argc, char **argv)
{
    bool list = lab_given("list", argc, argv), all = lab_given("long", argc, argv);
    int flags;

    options.talk = lab_given("frames", argc, argv);
    options.csv = lab_given("csv", argc, argv);
    flags = list + all + options.talk + options.csv;
    options.whole = all || argc - 1 > flags;
    if (options.csv && !list) {
        puts("scene,frames,crossed,deepest_skins,cut_short,still,drift,should,does,worst_ms,total_"
             "ms,note");
    }
    for (size_t g = 0; g < GROUPS; g++) {
        for (const struct fixture_scene *scene = groups[g]; scene->name; scene++) {
            bool asked = lab_given(scene->name, argc, argv);

            if (list) {
                puts(scene->name);
            } else if (options.whole ? all || asked : scene->brief > 0) {
                play(scene);
            }
        }
    }
    return list || options.csv ? 0 : lab_finish();
}
