/* SPDX-License-Identifier: MIT */
/*
 * A joint in the sweeps: all of its rows at once, the last one by the law of its limits, motor or
 * spring.
 */
#include "joint_parts.h"

/* V - wanted V of a row now; V of the last row. Two ways may differ by more than 32 bits hold. */
int32_t joint_present(const struct joint_work *work, int row)
{
    const bool slides = !joint_is_angular(work, row);
    uint64_t turn = (uint64_t)1 << 31;
    int64_t way = 0;

    for (int s = 0; s < 2; s++) {
        const struct joint_lever *lever = &work->lever[s];
        int64_t own_turn, own_way;

        if (!lever->body) {
            continue;
        }
        own_turn = carom_dot(lever->turn[row], body_solved(lever->body)->du);
        own_way = slides ? carom_dot(work->direction[row], body_solved(lever->body)->dv) : 0;
        turn += (uint64_t)(s == 0 ? own_turn : -own_turn);
        way += s == 0 ? own_way : -own_way;
    }
    way = carom_round(way, 30 + REST_FINER_BITS + work->down);
    return rest_clamp(work->before[row] + way + ((int64_t)turn >> 32));
}

/* If K is all but singular an impulse is long though its effect is short. */
#define IMPULSE_BITS   58
#define WAY_FINER_BITS 8

/* Extra bits of turn sums below du: as many as the shift leaves. */
static int finer_bits(const struct body *b)
{
    int s = rest_turn_shift(b, JOINT_FINE_BITS);

    return s > WAY_FINER_BITS ? WAY_FINER_BITS : s - 1;
}

void joint_add_effect(const struct joint_work *work, int side, const int64_t change[JOINT_ROWS],
                      struct joint_sum *sum)
{
    const struct joint_lever *lever = &work->lever[side];
    const int s = rest_turn_shift(lever->body, JOINT_FINE_BITS) - finer_bits(lever->body);
    const int down = 30 + work->down + JOINT_FINE_BITS - REST_FINER_BITS - WAY_FINER_BITS;

    for (int i = 0; i < work->rows; i++) {
        int64_t own = side == 0 ? change[i] : -change[i];

        own = lever->share_q30 == CAROM_ONE_Q30 ? own : fix_mul_q30(own, lever->share_q30);
        for (int k = 0; k < 3; k++) {
            sum->way[k] +=
                joint_is_angular(work, i) ? 0 : (uint64_t)fix_mul(own, work->direction[i][k], down);
            sum->turn[k] += (uint64_t)fix_mul(own, lever->turn[i][k], s);
        }
    }
}

void joint_round_sum(const struct body *b, const struct joint_sum *sum, int64_t dv[3],
                     int64_t du[3])
{
    for (int k = 0; k < 3; k++) {
        dv[k] = carom_round((int64_t)sum->way[k], WAY_FINER_BITS);
        du[k] = fix_round_shift((int64_t)sum->turn[k], -finer_bits(b));
    }
}

void joint_move(struct body *b, const struct joint_sum *sum)
{
    struct body_path *in = body_solve(b);
    int64_t dv[3], du[3];

    joint_round_sum(b, sum, dv, du);
    for (int k = 0; k < 3; k++) { /* beyond 2^30 it is noticed as having outgrown the unit */
        in->used |= rest_add(&in->dv[k], rest_within(dv[k], CAROM_ONE_Q30)) |
                    rest_add(&in->du[k], rest_within(du[k], CAROM_ONE_Q30));
    }
}

void joint_note(struct joint_work *work, const int64_t change[JOINT_ROWS])
{
    for (int i = 0; i < work->rows; i++) {
        work->impulse[i] = joint_limited(work->impulse[i] + change[i], IMPULSE_BITS);
        work->gain[i] = rest_clamp(work->gain[i] + change[i]);
    }
}

void joint_push(struct joint_work *work, const int64_t change[JOINT_ROWS])
{
    joint_note(work, change);
    for (int s = 0; s < 2; s++) {
        struct joint_sum sum = {{0, 0, 0}, {0, 0, 0}};

        if (work->lever[s].body) {
            joint_add_effect(work, s, change, &sum);
            joint_move(work->lever[s].body, &sum);
        }
    }
}

/*
 * The impulse that the last row is to have. `now` is the impulse at which the held rows hold, and V
 * is v then. The result is the motor's, the spring's, or none, plus what the limits ask for beyond
 * that.
 */
static int64_t by_law(const struct joint_work *work, int64_t now, int32_t v)
{
    const struct joint_law *law = &work->law;
    int last = work->rows - 1, bits = work->inverse_bits - JOINT_FINE_BITS;
    int64_t own = work->inverse[last][last], impulse = 0, least;

#define LEADS_TO(wanted) (now + fix_round_shift(((int64_t)(wanted) - (v)) * own, -bits))
    if (law->motor) {
        impulse = LEADS_TO(law->motor_v);
        impulse = impulse > law->most ? law->most : impulse < -law->most ? -law->most : impulse;
    } else if (law->spring) {
        impulse = law->push + fix_mul_q30(LEADS_TO(law->spring_v), law->soft_q30);
    }
    if (law->lower) {
        least = LEADS_TO(law->low_v);
        impulse = impulse > least ? impulse : least;
    }
    if (law->upper) {
        least = LEADS_TO(law->high_v);
        impulse = impulse < least ? impulse : least;
    }
#undef LEADS_TO
    return joint_limited(impulse, IMPULSE_BITS);
}

int64_t joint_sweep(struct joint *j, int32_t quiet)
{
    struct joint_work *work = &j->work;
    int64_t change[JOINT_ROWS], moved = 0;
    int32_t error[JOINT_ROWS];
    int last = work->rows - 1;

    for (int i = 0; i < work->held; i++) {
        error[i] = -rest_within(joint_present(work, i), 1 << 29);
        moved = fix_larger((int32_t)moved, fix_abs32(error[i]));
    }
    for (int i = 0; i < work->rows; i++) {
        int64_t sum = 0;

        /* six products of numbers below 2^30 and 2^29 */
        for (int k = 0; k < work->held; k++) {
            sum += (int64_t)work->inverse[i][k] * error[k];
        }
        change[i] =
            joint_limited(fix_round_shift(sum, JOINT_FINE_BITS - work->inverse_bits), IMPULSE_BITS);
    }
    if (work->held < work->rows) {
        int64_t more = by_law(work, work->impulse[last] + change[last], joint_present(work, last)) -
                       work->impulse[last];

        for (int i = 0; i < last; i++) {
            change[i] += fix_mul(more - change[last], work->ratio_q28[i], 28);
        }
        change[last] = more;
        more = carom_abs(more) >> JOINT_FINE_BITS;
        moved = more > moved ? more : moved;
    }
    if (moved < quiet) {
        return 0;
    }
    joint_push(work, change);
    return moved;
}
