/* SPDX-License-Identifier: MIT */
/*
 * Scene car: a chassis, and a hub and a wheel at each corner. A wheel turns on its hub by a hinge. The front hubs turn on the
 * chassis by hinges whose springs steer; the rear hubs go up and down by sliders whose springs carry. Motors drive the rear
 * hinges. The car drives on a yard with hills, a rim, ramps and towers, and picks up the balls that it hits.
 */
#include "carom_body.h"
#include "carom_query.h"
#include "port.h"
#include "scene_games.h"

#define FRICTION_Q16 (1u << 16)
#define CATEGORY_CAR 2

enum { MESH_CAR, MESH_WHEEL, MESH_JUMP, MESH_BALL, MESH_TOWER };

/* Masses in units of 100 kg, so forces are in 100 N. */
#define CHASSIS_KG 8
#define START_X_MM (-5500)
#define START_Y_MM (-12000)
#define RAISED_MM  670 /* height of the chassis's origin above the ground */
#define FRONT_MM   1150
#define REAR_MM    (-1050)
#define ASIDE_MM   900 /* to the middle of a wheel */
#define AXLE_MM    360 /* above the ground */

#define SPEED_MRAD_S 16000 /* 5.6 m/s at a radius of 0.35 m */
#define BACK_MRAD_S  (-6000)
#define STEER_MRAD   350

/* The wheels: rear, front; right, left. */
static bool is_front(int wheel)
{
    return wheel >= 2;
}

static carom_v3_q32 wheel_at(int wheel)
{
    carom_v3_q32 at = POSITION(START_X_MM + REAR_MM, START_Y_MM - ASIDE_MM, AXLE_MM);

    at.c[0] += is_front(wheel) ? CAROM_POSITION_MM(FRONT_MM - REAR_MM) : 0;
    at.c[1] += wheel % 2 ? CAROM_POSITION_MM(2 * ASIDE_MM) : 0;
    return at;
}

/* The hub on the chassis. */
static void mount(struct scene_parts *parts, int wheel)
{
    struct carom_joint_def def = {.kind = is_front(wheel) ? CAROM_JOINT_HINGE : CAROM_JOINT_SLIDER,
                                  .a = CAR_HUB + wheel,
                                  .b = CAR_CHASSIS,
                                  .anchor = wheel_at(wheel),
                                  .axis = {{0, 0, -CAROM_ONE_Q30}}};
    struct carom_joint_drive *drive = &def.drive;

    drive->limited = drive->spring = true;
    if (is_front(wheel)) {
        drive->lower_q32 = CAROM_RATIO(-600, 1000, 32);
        drive->upper_q32 = CAROM_RATIO(600, 1000, 32);
        drive->stiffness_q40 = CAROM_TORQUE_N_M(200, FPS);
        drive->damping_q40 = CAROM_TWIST_N_M_S(20, FPS);
    } else {
        drive->lower_q32 = CAROM_POSITION_MM(-120);
        drive->upper_q32 = CAROM_POSITION_MM(120);
        drive->stiffness_q40 = CAROM_FORCE_N(300, FPS);
        drive->damping_q40 = CAROM_IMPULSE_N_S(30, FPS);
        drive->rest_q32 = CAROM_POSITION_MM(60); /* along the axis, which points down */
    }
    scene_joint(parts, &def);
}

/* The wheel on its hub. */
static void axle(struct scene_parts *parts, int wheel)
{
    const struct carom_joint_def def = {
        .kind = CAROM_JOINT_HINGE,
        .a = CAR_WHEEL + wheel,
        .b = CAR_HUB + wheel,
        .anchor = wheel_at(wheel),
        .axis = {{0, CAROM_ONE_Q30, 0}},
        .drive = {.motor = !is_front(wheel), .motor_most_q40 = CAROM_TORQUE_N_M(2, FPS)}};

    scene_joint(parts, &def);
}

/* A place, and the cosine and sine of half the turn about z of the body that stands there. */
struct place {
    int32_t x_mm, y_mm, cosine_q30, sine_q30;
};

static void stand(struct scene_parts *parts, int mesh, const struct place *at, int32_t z_mm)
{
    const struct carom_body_def def = {
        .stationary = true,
        .position = {{at->x_mm * CAROM_POSITION_MM(1), at->y_mm * CAROM_POSITION_MM(1),
                      z_mm * CAROM_POSITION_MM(1)}},
        .rotation = {{at->cosine_q30, 0, 0, at->sine_q30}},
        /* the car would get wedged between a rough tower and a ramp */
        .friction_q16 = mesh == MESH_TOWER ? FRICTION_Q16 / 8 : FRICTION_Q16,
        .sensor = mesh == MESH_BALL};

    scene_part(parts, mesh, &def);
}

/* Ramps on the circle, a third of it apart. */
static const struct place ramps[CAR_RAMPS] = {
    {0, -12000, CAROM_ONE_Q30, 0},
    {10392, 6000, 536870912, 929887697},
    {-10392, 6000, -536870912, 929887697},
};
/* Towers outside the circle, away from the ramps; they come between the car and the camera. */
static const struct place towers[CAR_TOWERS] = {
    {7000, -13000, 1025033084, 319763936},
    {2500, 14500, 976891013, 445664022},
    {-13500, -5500, 1064243069, 142497571},
};
/* Balls: six on the circle, one beside it, one in the middle. */
static const struct place balls[CAR_PICKUPS] = {
    {2000, -11800, CAROM_ONE_Q30, 0}, {8500, -8500, CAROM_ONE_Q30, 0},
    {12000, 0, CAROM_ONE_Q30, 0},     {6000, 10400, CAROM_ONE_Q30, 0},
    {-6000, 10400, CAROM_ONE_Q30, 0}, {-12000, 0, CAROM_ONE_Q30, 0},
    {-8500, -8500, CAROM_ONE_Q30, 0}, {0, 0, CAROM_ONE_Q30, 0},
};

static int fill(const struct scene *scene, struct carom_world *world)
{
    struct carom_body_def part = {
        .position = POSITION(START_X_MM, START_Y_MM, RAISED_MM),
        .friction_q16 = FRICTION_Q16,
        .mass_q20 = CAROM_MASS_KG(CHASSIS_KG),
        /* the parts of the car go through each other, and the camera looks through them */
        .filter = {CATEGORY_CAR, 0xffff, -1},
    };
    struct scene_parts parts = {scene, world, CAROM_OK};

    scene_part(&parts, MESH_CAR, &part);
    part.mass_q20 = CAROM_MASS_G(500);
    for (int i = 0; i < 2 * CAR_WHEELS; i++) {
        part.position = wheel_at(i % CAR_WHEELS);
        scene_part(&parts, i < CAR_WHEELS ? MESH_BALL : MESH_WHEEL, &part);
    }
    for (int i = 0; i < CAR_RAMPS; i++) {
        stand(&parts, MESH_JUMP, &ramps[i], 0);
    }
    for (int i = 0; i < CAR_TOWERS; i++) {
        stand(&parts, MESH_TOWER, &towers[i], 0);
    }
    for (int i = 0; i < CAR_PICKUPS; i++) {
        stand(&parts, MESH_BALL, &balls[i], i == 0 ? 1200 : 800);
    }
    for (int wheel = 0; wheel < CAR_WHEELS; wheel++) {
        mount(&parts, wheel);
    }
    for (int wheel = 0; wheel < CAR_WHEELS; wheel++) {
        axle(&parts, wheel);
    }
    return parts.result;
}

/* ------------------------------------------------------------------------ balls */

/* Pick up the balls that the car hit in the last step. */
static int pick_up(struct carom_world *world)
{
    int taken[CAR_PICKUPS] = {0}, result = CAROM_OK;
    const struct carom_event *events;
    int count = carom_events(world, &events);

    for (int i = 0; i < count; i++) {
        if (events[i].kind == CAROM_EVENT_SENSOR_BEGIN && events[i].a >= CAR_PICKUP) {
            taken[events[i].a - CAR_PICKUP] = 1;
        }
    }
    for (int i = 0; i < CAR_PICKUPS && result >= 0; i++) {
        result = taken[i] ? carom_body_remove(world, CAR_PICKUP + i) : CAROM_OK;
    }
    return result;
}

static int balls_left(const struct carom_world *world)
{
    int left = 0;

    for (int i = 0; i < CAR_PICKUPS; i++) {
        left += carom_body_mesh(world, CAR_PICKUP + i) != NULL;
    }
    return left;
}

/* ---------------------------------------------------------------------- driving */

static int drive(struct carom_world *world, uint32_t keys)
{
    const int side = !!(keys & PORT_PAD_RIGHT) - !!(keys & PORT_PAD_LEFT);
    const int64_t speed_q40 = keys & PORT_PAD_UP     ? CAROM_SPIN_MRAD_S(SPEED_MRAD_S, FPS)
                              : keys & PORT_PAD_DOWN ? CAROM_SPIN_MRAD_S(BACK_MRAD_S, FPS)
                                                     : 0;
    int result = CAROM_OK;

    for (int wheel = 0; wheel < CAR_WHEELS && result >= 0; wheel++) {
        const int joint = (is_front(wheel) ? CAR_MOUNT : CAR_AXLE) + wheel;
        struct carom_joint_state state;

        result = carom_joint_get(world, joint, &state);
        if (is_front(wheel)) { /* the axis points down: a turn to the right is positive */
            state.drive.rest_q32 = side * CAROM_RATIO(STEER_MRAD, 1000, 32);
        } else {
            state.drive.motor_speed_q40 = speed_q40;
            state.drive.motor_most_q40 =
                speed_q40 != 0 ? CAROM_TORQUE_N_M(8, FPS) : CAROM_TORQUE_N_M(2, FPS);
        }
        result = result < 0 ? result : carom_joint_set(world, joint, &state.drive);
    }
    return result;
}

/*
 * Lift a car that is stuck or lies on its roof: turn it until its z axis points up and, with up or down, move it along, up
 * to 2 m/s.
 */
static int lift(struct carom_world *world, uint32_t keys)
{
    const int on = !!(keys & PORT_PAD_UP) - !!(keys & PORT_PAD_DOWN);
    const int64_t push_q40[3] = {on * CAROM_IMPULSE_N_S(CHASSIS_KG / 4, FPS), 0, 0};
    static const int64_t up_q40[3] = {0, 0, CAROM_TWIST_N_M_S(3, FPS)};
    struct carom_body_state car;
    carom_v3_q40 impulse, twist;
    int64_t z_q40[3];
    int result = carom_body_get(world, CAR_CHASSIS, &car);

    result = result < 0 ? result : carom_body_world_vector(world, CAR_CHASSIS, up_q40, z_q40);
    result = result < 0 ? result : carom_body_world_vector(world, CAR_CHASSIS, push_q40, impulse.c);
    if (result < 0 || car.velocity.c[2] > CAROM_VELOCITY_MM_S(2000, FPS)) {
        return result;
    }
    impulse.c[2] += CAROM_IMPULSE_N_S(CHASSIS_KG, FPS);
    /* the cross product of the car's z axis and the world's */
    twist = (carom_v3_q40){{z_q40[1], -z_q40[0], 0}};
    result = carom_body_push_centre(world, CAR_CHASSIS, &impulse);
    return result < 0 ? result : carom_body_twist(world, CAR_CHASSIS, &twist);
}

static int before(struct carom_world *world, int frame, uint32_t keys)
{
    int result = pick_up(world);

    (void)frame;
    result = result < 0 ? result : drive(world, keys);
    return result >= 0 && keys & PORT_PAD_A ? lift(world, keys) : result;
}

/* Places on the circle that the script drives, to the left, a twelfth of a turn apart. */
#define ROUND_PLACES 12
static const int16_t round_mm[ROUND_PLACES][2] = {
    {12000, 0},  {10392, 6000},   {6000, 10392},   {0, 12000},  {-6000, 10392}, {-10392, 6000},
    {-12000, 0}, {-10392, -6000}, {-6000, -10392}, {0, -12000}, {6000, -10392}, {10392, -6000},
};

/* The way from a place to the next one on the circle. */
static void way_on(const int64_t at_mm[2], int64_t way_mm[2])
{
    int64_t most = INT64_MIN;
    int nearest = 0;

    for (int i = 0; i < ROUND_PLACES; i++) {
        const int64_t along = at_mm[0] * round_mm[i][0] + at_mm[1] * round_mm[i][1];

        nearest = along > most ? i : nearest;
        most = along > most ? along : most;
    }
    for (int k = 0; k < 2; k++) {
        way_mm[k] = round_mm[(nearest + 1) % ROUND_PLACES][k] - at_mm[k];
    }
}

/*
 * The script: steer along the way. If something stops the car, drive back for a while with the wheels turned the other way, and
 * at last lift the car.
 */
static uint32_t script(const struct carom_world *world, int frame)
{
    static const int64_t ahead_q30[3] = {CAROM_ONE_Q30, 0, 0};
    struct carom_body_state car;
    int64_t x_q30[3], at_mm[2], way_mm[2], aside, along, speed_q40;

    if (carom_body_get(world, CAR_CHASSIS, &car) < 0 ||
        carom_body_world_vector(world, CAR_CHASSIS, ahead_q30, x_q30) < 0) {
        return 0;
    }
    for (int k = 0; k < 2; k++) {
        at_mm[k] = CAROM_TO_MM(car.position.c[k]);
    }
    way_on(at_mm, way_mm);
    along = x_q30[0] * way_mm[0] + x_q30[1] * way_mm[1];
    aside = x_q30[0] * way_mm[1] - x_q30[1] * way_mm[0];
    speed_q40 = (car.velocity.c[0] >> 30) * x_q30[0] + (car.velocity.c[1] >> 30) * x_q30[1];
    if (speed_q40 < CAROM_VELOCITY_MM_S(300, FPS) && frame % 256 >= 156) {
        return PORT_PAD_DOWN | (aside > 0 ? PORT_PAD_RIGHT : PORT_PAD_LEFT) |
               (frame % 1024 >= 984 ? PORT_PAD_A : 0);
    }
    return PORT_PAD_UP | (8 * aside > along    ? PORT_PAD_LEFT
                          : -8 * aside > along ? PORT_PAD_RIGHT
                                               : 0);
}

/* ---------------------------------------------------------------------- picture */

/* Place the camera behind and above the car, but in front of any body that stands there. */
static void look(const struct carom_world *world, struct carom_camera *camera)
{
    static const struct carom_query_filter others = {.mask = 0xffff & ~CATEGORY_CAR};
    static const int64_t behind_q32[3] = {CAROM_POSITION_MM(-5600), CAROM_POSITION_MM(-1900), 0};
    struct carom_body_state car;
    struct carom_ray ray;
    struct carom_ray_hit hit;
    int64_t way_q32[3], part_q30 = CAROM_ONE_Q30;

    if (carom_body_get(world, CAR_CHASSIS, &car) < 0 ||
        carom_body_world_vector(world, CAR_CHASSIS, behind_q32, way_q32) < 0) {
        return;
    }
    ray.from = camera->target = car.position;
    ray.way = (carom_v3_q32){{way_q32[0], way_q32[1], CAROM_POSITION_MM(3000)}};
    if (carom_cast_ray(world, &ray, &others, &hit) == 1) {
        part_q30 = hit.t_q30 - CAROM_ONE_Q30 / 32; /* a little nearer */
    }
    for (int k = 0; k < 3; k++) {
        camera->eye.c[k] = ray.from.c[k] + (ray.way.c[k] >> 15) * part_q30 / (1 << 15);
    }
}

static void say(const struct carom_world *world, char text[SCENE_TEXT])
{
    struct carom_body_state car;
    int64_t square = 0, dm_s = 0;
    int taken = CAR_PICKUPS - balls_left(world);

    if (carom_body_get(world, CAR_CHASSIS, &car) >= 0) {
        for (int k = 0; k < 3; k++) {
            const int64_t mm_s = CAROM_TO_MM_S(car.velocity.c[k], FPS);

            square += mm_s * mm_s;
        }
    }
    while ((dm_s + 1) * (dm_s + 1) * 10000 <= square) {
        dm_s++;
    }
    text = scene_say_number(text, taken, " of ");
    text = scene_say_number(text, CAR_PICKUPS, " balls  ");
    text = scene_say_number(text, (int)(dm_s * 36 / 100), " km/h");
}

#define GLASS     SCENE_DARK, SCENE_DARK
#define TWO(ramp) ramp, ramp
#define SIX(ramp) TWO(ramp), TWO(ramp), TWO(ramp)
/* Two sides of 9 faces, and two faces for each edge of the outline: windows in front of and behind the roof. */
static const uint8_t car_faces[40] = {
    SIX(SCENE_RED), SIX(SCENE_RED), SIX(SCENE_RED), SIX(SCENE_RED), SIX(SCENE_RED),
    TWO(SCENE_RED), GLASS,          TWO(SCENE_RED), GLASS,          TWO(SCENE_RED)};
static const struct carom_body_paint paints[] = {
    [SCENE_GROUND] = {scene_yard_faces, 0},  [CAR_CHASSIS] = {car_faces, 0},
    [CAR_HUB] = {NULL, SCENE_RED},           [CAR_HUB + 1] = {NULL, SCENE_RED},
    [CAR_HUB + 2] = {NULL, SCENE_RED},       [CAR_HUB + 3] = {NULL, SCENE_RED},
    [CAR_WHEEL] = {NULL, SCENE_DARK},        [CAR_WHEEL + 1] = {NULL, SCENE_DARK},
    [CAR_WHEEL + 2] = {NULL, SCENE_DARK},    [CAR_WHEEL + 3] = {NULL, SCENE_DARK},
    [CAR_RAMP] = {NULL, SCENE_WOOD},         [CAR_RAMP + 1] = {NULL, SCENE_WOOD},
    [CAR_RAMP + 2] = {NULL, SCENE_WOOD},     [CAR_TOWER] = {NULL, SCENE_WOOD},
    [CAR_TOWER + 1] = {NULL, SCENE_WOOD},    [CAR_TOWER + 2] = {NULL, SCENE_WOOD},
    [CAR_PICKUP] = {NULL, SCENE_YELLOW},     [CAR_PICKUP + 1] = {NULL, SCENE_YELLOW},
    [CAR_PICKUP + 2] = {NULL, SCENE_YELLOW}, [CAR_PICKUP + 3] = {NULL, SCENE_YELLOW},
    [CAR_PICKUP + 4] = {NULL, SCENE_YELLOW}, [CAR_PICKUP + 5] = {NULL, SCENE_YELLOW},
    [CAR_PICKUP + 6] = {NULL, SCENE_YELLOW}, [CAR_PICKUP + 7] = {NULL, SCENE_YELLOW},
};

const struct scene_game scene_car = {
    .caps = CAROM_CAPS(CAR_PICKUP + CAR_PICKUPS, 64, 128, 512, 0, 1024, 2 * CAR_WHEELS, 0),
    .camera = {POSITION(-12000, -14000, 3600), POSITION(START_X_MM, START_Y_MM, 800), 1 << 16},
    .fill = fill,
    .script = script,
    .before = before,
    .look = look,
    .say = say,
    .paints = paints,
    .paint_count = sizeof paints / sizeof paints[0],
};
