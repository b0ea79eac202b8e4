/* SPDX-License-Identifier: MIT */
/* Motions with a known outcome: worlds to measure in, and rows of the table. */
#include <math.h>
#include <stdio.h>

#include "ball.h"
#include "carom_body.h"
#include "carom_joint.h"
#include "physics.h"
#include "real.h"

struct fixture *physics_begin(const char *name, double mu)
{
    static struct fixture_scene scene;
    struct fixture *f;

    scene = (struct fixture_scene){.name = name, .mu = mu};
    f = fixture_begin(&scene);
    f->config.caps.joints = 8;
    f->config.caps.extras = 48;
    return f;
}

void physics_gravity(struct fixture *f, double x, double y, double z)
{
    const double gravity[3] = {x, y, z};

    for (int k = 0; k < 3; k++) {
        f->config.gravity.c[k] = lab_fixed(gravity[k] / PHYSICS_FPS / PHYSICS_FPS, 40);
    }
}

static void roll_freely(struct fixture *f, int body)
{
    struct carom_material material;

    lab_expect(carom_body_material(f->world, body, &material), "material");
    material.rolling_q16 = 0;
    lab_expect(carom_body_set_material(f->world, body, &material), "material");
}

void physics_start(struct fixture *f, double e)
{
    for (int i = 0; i < f->body_count; i++) {
        f->bodies[i].def.restitution_q30 = (int32_t)lab_fixed(e, 30);
    }
    fixture_start(f);
    for (int i = 0; i < f->body_count; i++) {
        if (f->bodies[i].mass > 0) {
            roll_freely(f, i);
        }
    }
}

void physics_step(struct fixture *f)
{
    lab_expect(carom_world_step(f->world), f->scene->name);
}

int physics_joint(struct fixture *f, int kind, int a, int b, const double anchor[3],
                  const double axis[3])
{
    struct carom_joint_def def = {.kind = (uint8_t)kind, .a = a, .b = b};

    for (int k = 0; k < 3; k++) {
        def.anchor.c[k] = lab_fixed(anchor[k], 32);
        def.axis.c[k] = (int32_t)lab_fixed(axis[k], 30);
    }
    return lab_expect(carom_joint_add(f->world, &def), "joint");
}

int physics_box(struct fixture *f, double x, double y, double z)
{
    fixture_shape_box(&f->shape, x, y, z);
    return fixture_mesh(f);
}

int physics_roller(struct fixture *f, double radius, double length, int sides)
{
    double corner[256][2];

    for (int i = 0; i < sides; i++) {
        double angle = 2 * REAL_PI * i / sides;

        corner[i][0] = radius * cos(angle);
        corner[i][1] = radius * sin(angle);
    }
    fixture_shape_prism(&f->shape, (const double(*)[2])corner, sides, -length / 2, length / 2);
    return fixture_mesh(f);
}

int physics_ball(struct fixture *f, double radius, int cuts)
{
    ball_make(cuts);
    fixture_shape_begin(&f->shape);
    for (uint32_t v = 0; v < ball_raw.vertex_count; v++) {
        const int16_t *p = ball_vertices[v];
        double scale = radius / BALL_QUANTA;

        fixture_shape_vertex(&f->shape, scale * p[0], scale * p[1], scale * p[2]);
    }
    for (uint32_t n = 0; n < ball_raw.face_count; n++) {
        const uint16_t *face = ball_raw.faces[n];

        fixture_shape_face(&f->shape, face[0], face[1], face[2]);
    }
    return fixture_mesh(f);
}

struct oracle_body physics_body(const struct fixture *f, int body)
{
    struct oracle_body now = f->meshes[f->bodies[body].mesh].weight;

    now.mass = f->bodies[body].mass;
    lab_read(&now, f->world, body);
    for (int k = 0; k < 3; k++) {
        now.velocity[k] *= PHYSICS_FPS;
        now.spin[k] *= PHYSICS_FPS;
    }
    return now;
}

void physics_axis(const struct oracle_body *body, int axis, double out[3])
{
    double m[3][3];

    real_matrix(m, body->quaternion);
    for (int k = 0; k < 3; k++) {
        out[k] = m[k][axis];
    }
}

void physics_local(const struct oracle_body *body, const double world[3], double out[3])
{
    double m[3][3];

    real_matrix(m, body->quaternion);
    real_rotate_back(out, m, world);
}

double physics_hit(const struct fixture *f, int a, int b)
{
    const struct carom_event *events;
    int n = carom_events(f->world, &events);
    double speed = 0;

    for (int i = 0; i < n; i++) {
        if (events[i].kind == CAROM_EVENT_HIT &&
            ((events[i].a == a && events[i].b == b) || (events[i].a == b && events[i].b == a))) {
            speed = fmax(speed, PHYSICS_FPS * lab_double(events[i].speed_q40, 40));
        }
    }
    return speed;
}

void physics_cross(struct physics_crossings *c, double now)
{
    if (c->frames > 0 && c->before < 0 && now >= 0) {
        c->last = ((double)c->frames - now / (now - c->before)) / PHYSICS_FPS;
        c->first = c->count == 0 ? c->last : c->first;
        c->count++;
    }
    c->before = now;
    c->frames++;
}

double physics_period(const struct physics_crossings *c)
{
    return c->count > 1 ? (c->last - c->first) / (double)(c->count - 1) : 0;
}

double physics_elliptic(double k)
{
    double a = 1, b = sqrt(1 - k * k);

    for (int i = 0; i < 30; i++) {
        double mean = (a + b) / 2;

        b = sqrt(a * b);
        a = mean;
    }
    return REAL_PI / 2 / a;
}

double physics_threshold(bool (*holds)(double x), double low, double high, int halvings)
{
    if (!holds(low) || holds(high)) {
        return HUGE_VAL;
    }
    for (int i = 0; i < halvings; i++) {
        double middle = (low + high) / 2;

        if (holds(middle)) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return (low + high) / 2;
}
