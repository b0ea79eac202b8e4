/* SPDX-License-Identifier: MIT */
/*
 * accuracy_boyse - first times of impact against the true motion.
 *
 * Before the features meet, their gap is equal to the event gap (half the skin) for a last time: a
 * hit stops there. If the gap did not reach the event gap since the previous root, or since the
 * start, the hit stops at half of the largest gap in between, but not below the gap at the start.
 * The error is the distance between the true separation along the normal at the returned time and
 * that gap, in units of 2^-16.
 *
 * The oracle finds the true first meeting: it samples the separation over the slice and narrows
 * down every change of its sign. Failures: no hit; a hit so late that the surfaces already overlap
 * by more than 2 units; a hit for an earlier approach, in which the features do not meet.
 */
#include "lib/accuracy.h"
#include "lib/meeting.h"

#define SAMPLES  40
#define ULP      (1.0L / 65536)
#define SQUARELY (1.0L / 64) /* least normal speed over path length; least sine of edges */
#define CLEARLY  (4 * ULP)   /* a point closer than that to a border counts for either side */
#define NOISE    (ULP / 4)   /* a separation below that may have either sign */

static struct meeting meeting;

/* The true first meeting. */
struct truth {
    long double last;   /* the previous root, or the start */
    long double time;   /* time of the meeting */
    long double target; /* separation at which to stop */
    int sign;           /* the separation is sign times the gap */
};

/* The kind of a root. UNCLEAR: too close to call, or grazing. */
enum root { NOTHING, MEETING, UNCLEAR };

static long double size(long double v)
{
    return v < 0 ? -v : v;
}

/* The gap times the sine of the edges, which stays smooth when the edges become parallel. */
static long double smooth_gap(long double t)
{
    struct meeting_features f;

    meeting_at(&meeting, t, &f);
    return f.gap * f.sine;
}

static long double separation(const struct truth *truth, long double t)
{
    struct meeting_features f;

    meeting_at(&meeting, t, &f);
    return truth->sign * f.gap;
}

static enum root classify(struct truth *truth, long double t)
{
    const long double tolerance = (long double)INTERFERE_CONE_Q30 / (1 << 30);
    bool edges = meeting.candidate.kind == CANDIDATE_EDGE_EDGE;
    long double slope = meeting_slope(&meeting, t), inside, cones;
    long double grazing = SQUARELY * meeting.length;
    struct meeting_features f;

    meeting_at(&meeting, t, &f);
    if (f.sine < SQUARELY / 4) {
        return NOTHING; /* parallel edges have no normal */
    }
    truth->sign = edges && slope > 0 ? -1 : 1;
    truth->time = t;
    inside = meeting_inside(&meeting, &f) * f.sine;
    cones = meeting_in_cones(&meeting, &f, truth->sign) + tolerance;
    if (inside < -CLEARLY || cones < -SQUARELY / 4 || (!edges && slope > grazing)) {
        return NOTHING;
    }
    if (size(slope) < grazing || f.sine < SQUARELY || inside < CLEARLY || cones < SQUARELY / 4) {
        return UNCLEAR;
    }
    return MEETING;
}

/* ------------------------------------------------------------ roots in order */

/* Times in order, with the smooth gap at each: the samples, and the minima between them. */
struct samples {
    int count;
    long double t[2 * SAMPLES + 2], p[2 * SAMPLES + 2];
    bool dip[2 * SAMPLES + 2];
};

static void push(struct samples *s, long double t, long double p, bool dip)
{
    s->t[s->count] = t;
    s->p[s->count] = p;
    s->dip[s->count++] = dip;
}

/*
 * The time of the smallest |P| between two times, by ternary search, or a time at which P has
 * changed its sign.
 */
static long double nearest_approach(long double low, long double high)
{
    bool positive = smooth_gap(low) > 0;

    for (int k = 0; k < 30; k++) {
        long double a = low + (high - low) / 3, b = high - (high - low) / 3;
        long double pa = smooth_gap(a), pb = smooth_gap(b);

        if ((pa > 0) != positive) {
            return a;
        }
        if ((pb > 0) != positive) {
            return b;
        }
        if (size(pa) < size(pb)) {
            high = b;
        } else {
            low = a;
        }
    }
    return (low + high) / 2;
}

/* Whether |P| may have a minimum between the neighbours of sample k that reaches 0. */
static bool dips(const long double p[SAMPLES + 1], int k)
{
    int before = k > 0 ? k - 1 : 0, after = k < SAMPLES ? k + 1 : SAMPLES;

    /* P changes no faster than its rate: path length times distance of the edges */
    return (p[before] > 0) == (p[k] > 0) && (p[after] > 0) == (p[k] > 0) &&
           size(p[k]) <= size(p[before]) && size(p[k]) <= size(p[after]) &&
           size(p[k]) < 8 * meeting.length / SAMPLES;
}

static void sample(struct samples *s)
{
    long double p[SAMPLES + 1];

    for (int k = 0; k <= SAMPLES; k++) {
        p[k] = smooth_gap((long double)k / SAMPLES);
    }
    s->count = 0;
    for (int k = 0; k <= SAMPLES; k++) {
        long double t = (long double)k / SAMPLES, near = t;

        if (dips(p, k)) {
            near = nearest_approach(k > 0 ? t - 1.0L / SAMPLES : 0,
                                    k < SAMPLES ? t + 1.0L / SAMPLES : 1);
        }
        if (near < t && k > 0) {
            push(s, near, smooth_gap(near), true);
        }
        push(s, t, p[k], false);
        if (near > t && k < SAMPLES) {
            push(s, near, smooth_gap(near), true);
        }
    }
}

static long double change_of_sign(long double low, long double high)
{
    bool positive = smooth_gap(low) > 0;

    for (int k = 0; k < 50; k++) {
        long double t = (low + high) / 2;

        if ((smooth_gap(t) > 0) == positive) {
            low = t;
        } else {
            high = t;
        }
    }
    return low;
}

/* Find the first meeting. UNCLEAR when a root before it is too close to call. */
static enum root first_meeting(const struct samples *s, struct truth *truth)
{
    truth->last = 0;
    for (int k = 1; k < s->count; k++) {
        if ((s->p[k - 1] > 0) != (s->p[k] > 0)) {
            long double t = change_of_sign(s->t[k - 1], s->t[k]);
            enum root root = classify(truth, t);

            if (root != NOTHING) {
                return root;
            }
            truth->last = t;
        } else if (s->dip[k] && s->t[k] < 1 && size(s->p[k]) < NOISE) {
            return UNCLEAR;
        }
    }
    return NOTHING;
}

/*
 * The largest separation between two times, by ternary search around the best sample; or the first
 * sample above `enough`.
 */
static long double largest_opening(const struct truth *truth, long double enough)
{
    long double step = (truth->time - truth->last) / SAMPLES, best = -1, low, high;
    int at = 0;

    for (int k = 0; k <= SAMPLES; k++) {
        long double open = separation(truth, truth->last + k * step);

        if (open > enough) {
            return open;
        }
        if (open > best) {
            best = open;
            at = k;
        }
    }
    low = truth->last + (at > 0 ? at - 1 : 0) * step;
    high = truth->last + (at < SAMPLES ? at + 1 : SAMPLES) * step;
    for (int k = 0; k < 30; k++) {
        long double a = low + (high - low) / 3, b = high - (high - low) / 3;

        if (separation(truth, a) > separation(truth, b)) {
            high = b;
        } else {
            low = a;
        }
    }
    high = separation(truth, (low + high) / 2);
    return high > best ? high : best;
}

/*
 * Find the separation at which to stop. False when the case cannot be judged: the features nearly
 * touch at the start, or their largest separation is close to the event gap, or the surfaces hardly
 * overlap before the slice ends.
 */
static bool find_target(struct truth *truth)
{
    int32_t skin_a = meeting.body[0].def.skin_q22, skin_b = meeting.body[1].def.skin_q22;
    long double event = (skin_a > skin_b ? skin_a : skin_b) / 2 * MEETING_UNIT, open, deepest = 0;
    long double start = separation(truth, 0);

    for (int k = 1; k <= 8; k++) {
        long double depth = -separation(truth, truth->time + (1 - truth->time) * k / 8);

        deepest = depth > deepest ? depth : deepest;
    }
    if (deepest < NOISE || (size(start) < event + NOISE && start < NOISE)) {
        return false;
    }
    open = largest_opening(truth, event + event / 64);
    truth->target = open < event ? open / 2 : event;
    if (open < event && truth->last == 0 && truth->target < start) {
        truth->target = start;
    }
    return size(open - event) > event / 64;
}

/*
 * Whether the edges stay far enough from parallel between the event and the root. The gap between
 * nearly parallel lines says little about the surfaces.
 */
static bool stays_square(const struct truth *truth)
{
    struct meeting_features f;

    for (int k = 0; k <= 64; k++) {
        long double t = truth->time * (64 - k) / 64;

        meeting_at(&meeting, t, &f);
        if (f.sine < SQUARELY) {
            return false;
        }
        if (separation(truth, t) >= truth->target) {
            break;
        }
    }
    return true;
}

/* --------------------------------------------------------------------- cases */

/* Whether the gap stays small from the hit to the root, so that both belong to one approach. */
static bool approaches(const struct truth *truth, long double t)
{
    for (int k = 1; k <= 16; k++) {
        if (separation(truth, t + (truth->time - t) * k / 16) > truth->target + 2 * ULP) {
            return false;
        }
    }
    return true;
}

/* Judge one case. False when the random case cannot be judged; the caller then makes another. */
static bool judge(struct accuracy *a)
{
    struct samples samples;
    struct truth truth;
    struct boyse_hit hit;
    uint32_t roots = 0;
    long double t, apart;

    sample(&samples);
    if (first_meeting(&samples, &truth) != MEETING || !find_target(&truth) ||
        !stays_square(&truth)) {
        return false;
    }
    if (!boyse_first(&meeting.pair, &meeting.candidate, &hit, &roots)) {
        accuracy_fail(a);
        return true;
    }
    t = (long double)hit.t_q30 / CAROM_ONE_Q30;
    apart = separation(&truth, t);
    if (apart < -2 * ULP || (t < truth.time && !approaches(&truth, t))) {
        accuracy_fail(a);
    } else {
        accuracy_add(a, (double)(size(apart - truth.target) / ULP));
    }
    return true;
}

/* The bar: 0.2 units of 2^-16 for all but one case in a thousand, 2 units for all. */
static void row(int argc, char **argv, const char *kernel, struct meeting_plan plan,
                const int kinds[4])
{
    struct accuracy a = accuracy_begin(kernel, accuracy_cases(argc, argv, 200000));
    size_t wanted = a.wanted, turns = 24, n = 0;
    bool both = plan.both;
    struct test_random r = {wanted};

    for (size_t turn = 0; turn < turns; turn++) {
        plan.both = both && turn % 2 == 1;
        meeting_shapes(&meeting, (unsigned)turn / 2, &plan);
        while (n < wanted * (turn + 1) / turns) {
            plan.kind = kinds[n % 4];
            meeting_make(&meeting, &r, &plan);
            n += judge(&a);
        }
    }
    accuracy_end(&a, &(struct accuracy_bar){.p999 = 0.2, .max = 2});
}

int main(int argc, char **argv)
{
    static const int faces[4] = {CANDIDATE_VERTEX_FACE, CANDIDATE_FACE_VERTEX,
                                 CANDIDATE_VERTEX_FACE, CANDIDATE_FACE_VERTEX};
    static const int edges[4] = {CANDIDATE_EDGE_EDGE, CANDIDATE_EDGE_EDGE, CANDIDATE_EDGE_EDGE,
                                 CANDIDATE_EDGE_EDGE};
    static const int all[4] = {CANDIDATE_VERTEX_FACE, CANDIDATE_EDGE_EDGE, CANDIDATE_FACE_VERTEX,
                               CANDIDATE_EDGE_EDGE};
    const struct meeting_plan translate = {.translate = true}, rotate = {.turn = true};
    const struct meeting_plan together = {.translate = true, .turn = true, .both = true};

    row(argc, argv, "boyse_vf_translate", translate, faces);
    row(argc, argv, "boyse_ee_translate", translate, edges);
    row(argc, argv, "boyse_vf_rotate", rotate, faces);
    row(argc, argv, "boyse_ee_rotate", rotate, edges);
    row(argc, argv, "boyse_combined", together, all);
    return accuracy_finish();
}
