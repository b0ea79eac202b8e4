/* SPDX-License-Identifier: MIT */
/* The parts of a scene that its frames need: rules, camera, look, text. */
#include "show.h"

#include "scene_games.h"

struct show show_of(const struct scene *scene)
{
    return (struct show){scene->camera, scene->sheet, scene->game};
}

int show_before(const struct show *show, struct carom_world *world, int frame, uint32_t keys)
{
    return SCENE_GAMES && show->game ? scene_game_before(show->game, world, frame, keys)
                                     : scene_sheet_move(show->sheet, world, frame);
}

const struct carom_camera *show_camera(const struct show *show, const struct carom_world *world)
{
    static struct carom_camera camera;

    if (!SCENE_GAMES || !show->game || !show->game->look) {
        return show->camera;
    }
    camera = *show->camera;
    show->game->look(world, &camera);
    return &camera;
}

const struct carom_paint *show_paint(const struct show *show)
{
    return scene_paint(show->game);
}

void show_say(const struct show *show, const struct carom_world *world, char text[SCENE_TEXT])
{
    text[0] = 0;
    if (SCENE_GAMES && show->game && show->game->say) {
        show->game->say(world, text);
    }
}
