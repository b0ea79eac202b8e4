/* SPDX-License-Identifier: MIT */
/*
 * A car: a chassis, and at each corner a hub and a wheel. A wheel turns on its hub by a hinge; the front
 * hubs turn on the chassis by hinges whose springs steer, the rear ones go up and down by sliders whose springs carry.
 * The rear hinges have the motors.
 */
#include "carom_body.h"
#include "carom_query.h"
#include "scene_games.h"

#define FRICTION_Q16 (1u << 16)
#define CATEGORY_CAR 2

/* Masses in units of 100 kg: then forces are 100 N. */
#define CHASSIS_KG 8
#define RAISED_MM  670 /* the chassis's origin above the ground */
#define FRONT_MM   1150
#define REAR_MM    (-1050)
#define ASIDE_MM   900 /* the middle of a wheel */
#define AXLE_MM    360 /* above the ground */

#define SPEED_MRAD_S 16000 /* 5.6 m/s at a radius of 0.35 m */
#define STEER_MRAD   350

/* The wheels: rear, front; right, left. */
static bool is_front(int wheel)
{
    return wheel >= 2;
}

static carom_v3_q32 wheel_at(int wheel)
{
    carom_v3_q32 at = POSITION(REAR_MM, -ASIDE_MM, AXLE_MM);

    at.c[0] = is_front(wheel) ? CAROM_POSITION_MM(FRONT_MM) : at.c[0];
    at.c[1] = wheel % 2 ? -at.c[1] : at.c[1];
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
        drive->rest_q32 = CAROM_POSITION_MM(60); /* along the axis, which is down */
    }
    scene_joint(parts, &def);
}

/* The wheel on its hub. */
static void axle(struct scene_parts *parts, int wheel)
{
    struct carom_joint_def def = {.kind = CAROM_JOINT_HINGE,
                                  .a = CAR_WHEEL + wheel,
                                  .b = CAR_HUB + wheel,
                                  .anchor = wheel_at(wheel),
                                  .axis = {{0, CAROM_ONE_Q30, 0}}};

    if (!is_front(wheel)) {
        def.drive.motor = true;
        def.drive.motor_speed_q40 = CAROM_SPIN_MRAD_S(SPEED_MRAD_S, FPS);
        def.drive.motor_most_q40 = CAROM_TORQUE_N_M(8, FPS);
    }
    scene_joint(parts, &def);
}

static void ramps(struct scene_parts *parts)
{
    struct carom_body_def def = {
        .stationary = true, .position = POSITION(4000, 0, 0), .friction_q16 = FRICTION_Q16};

    /* two beside each other, a lane for each side's wheels */
    def.position.c[1] = CAROM_POSITION_MM(-ASIDE_MM);
    scene_part(parts, 2, &def);
    def.position.c[1] = CAROM_POSITION_MM(ASIDE_MM);
    scene_part(parts, 2, &def);
}

static void pickups(struct scene_parts *parts)
{
    static const int32_t place_mm[CAR_PICKUPS][2] = {{2600, 0}, {12000, 600}, {14500, 3500}};

    for (int i = 0; i < CAR_PICKUPS; i++) {
        struct carom_body_def def = {
            .stationary = true, .sensor = true, .position = POSITION(0, 0, 700)};

        def.position.c[0] = CAROM_POSITION_MM(place_mm[i][0]);
        def.position.c[1] = CAROM_POSITION_MM(place_mm[i][1]);
        scene_part(parts, 3, &def);
    }
}

static int fill(const struct scene *scene, struct carom_world *world)
{
    struct carom_body_def part = {
        .position = POSITION(0, 0, RAISED_MM),
        .friction_q16 = FRICTION_Q16,
        .mass_q20 = CAROM_MASS_KG(CHASSIS_KG),
        /* the parts of the car go through each other, and the camera looks through them */
        .filter = {CATEGORY_CAR, 0xffff, -1},
    };
    struct scene_parts parts = {scene, world, CAROM_OK};

    scene_part(&parts, 0, &part);
    part.mass_q20 = CAROM_MASS_G(500);
    for (int wheel = 0; wheel < CAR_WHEELS; wheel++) {
        part.position = wheel_at(wheel);
        scene_part(&parts, 3, &part);
    }
    for (int wheel = 0; wheel < CAR_WHEELS; wheel++) {
        part.position = wheel_at(wheel);
        scene_part(&parts, 1, &part);
    }
    ramps(&parts);
    pickups(&parts);
    for (int wheel = 0; wheel < CAR_WHEELS; wheel++) {
        mount(&parts, wheel);
    }
    for (int wheel = 0; wheel < CAR_WHEELS; wheel++) {
        axle(&parts, wheel);
    }
    return parts.result;
}

/* Whatever the car drove into in the last step is picked up. */
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

/* Straight on over the ramps, then to the left. */
static int before(struct carom_world *world, int frame)
{
    int result = pick_up(world);
    struct carom_joint_state state;

    for (int wheel = 2; wheel < CAR_WHEELS && result >= 0 && frame == 200; wheel++) {
        result = carom_joint_get(world, CAR_MOUNT + wheel, &state);
        state.drive.rest_q32 = CAROM_RATIO(-STEER_MRAD, 1000, 32); /* the axis is down */
        if (result >= 0) {
            result = carom_joint_set(world, CAR_MOUNT + wheel, &state.drive);
        }
    }
    return result;
}

/* Behind the car and above it, but not behind what stands there. */
static void look(const struct carom_world *world, struct carom_camera *camera)
{
    static const struct carom_query_filter others = {.mask = 0xffff & ~CATEGORY_CAR};
    static const int64_t behind_q40[3] = {-CAROM_VELOCITY_M_S(6, 1), -CAROM_VELOCITY_M_S(3, 1), 0};
    struct carom_body_state car;
    struct carom_ray ray;
    struct carom_ray_hit hit;
    int64_t way_q40[3];

    if (carom_body_get(world, CAR_CHASSIS, &car) < 0 ||
        carom_body_world_vector(world, CAR_CHASSIS, behind_q40, way_q40) < 0) {
        return;
    }
    ray.from = camera->target = car.position;
    ray.way = (carom_v3_q32){{way_q40[0] >> 8, way_q40[1] >> 8, CAROM_POSITION_M(3)}};
    if (carom_cast_ray(world, &ray, &others, &hit) == 1) {
        camera->eye = hit.point;
        return;
    }
    for (int k = 0; k < 3; k++) {
        camera->eye.c[k] = ray.from.c[k] + ray.way.c[k];
    }
}

const struct scene_game scene_car = {
    .caps = CAROM_CAPS(CAR_PICKUP + CAR_PICKUPS, 64, 128, 512, 0, 1024, 2 * CAR_WHEELS, 0),
    .camera = {POSITION(-6000, -3000, 3600), POSITION(0, 0, 800), 1 << 16},
    .fill = fill,
    .before = before,
    .look = look,
};
