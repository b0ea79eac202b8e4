/* SPDX-License-Identifier: MIT */
/*
 * tuning - every number of the engine that was tuned, in one table, by stage.
 *
 * Each has its unit, its reason, and after "in" the file that uses it. SPEC.md, section 6, says
 * what a step does with them. The reason begins with where the number comes from:
 *
 *   derived   it follows from other numbers or from geometry; change those
 *   measured  runs of scenes gave it; what was seen with others is said
 *   chosen    in a range that gives good results; change it and run make soak, fixtures and bench
 *   cost      results do not depend on it, only what a step costs (make bench)
 *
 * All but those of `cost` change results: with another value every golden hash is another one.
 * Limits of formats (ranges, bits, the noise of roundings) stand where the format is used. Times
 * are parts of a frame in q30; a DIVISOR gives that part of a skin, or of a skin a frame, unless
 * something else is said.
 */
#ifndef CAROM_SRC_TUNING_H
#define CAROM_SRC_TUNING_H

#include "carom_fix.h"

/* ------------------------------------------------------------------- lengths */

/*
 * Skins: the margin within which features are contacts. Chosen; in body/, interfere/, step/,
 * world/.
 */
#define BODY_MARGIN_SKINS 5
/*
 * The same of bodies that bounce for ever. Chosen: a wider margin holds them; in step/contacts.c.
 */
#define BODY_BOUNCE_MARGIN_SKINS 2

/* --------------------------------------------------------------------- paths */

/* Radians that one slice may turn. Derived: |u| <= 0.31 then (SPEC 5.1); in body/. */
#define BODY_TURN_MAX_Q30 (CAROM_ONE_Q30 / 2)
/* Radii that a slice may go. Chosen: bounds what one path sweeps; in step/clock.c, body/route.c. */
#define BODY_SLICE_RADII 8
/* Frames that a region lasts at most. Cost; in step/regions.c. */
#define BODY_REGION_FRAMES 64

/* ----------------------------------------------------------------- interfere */

/*
 * Cosine tolerance of the normal cones, 0.02. Chosen; in interfere/, boyse/touch.c, query/ahead.c.
 */
#define INTERFERE_CONE_Q30 21474836
/*
 * Slots that remember faces of b which the leaf was tested against: a face lies in several cells.
 * Cost: a face that takes the slot of another one makes the engine test that one again.
 */
#define INTERFERE_SEEN 64
/* Faces at the list's end in which a repetition is sought. Cost; in interfere/faces.c. */
#define INTERFERE_LAST_FACES 8
/*
 * Other candidates are dropped when less than this part of the pool would be free. Cost; in
 * keep.c.
 */
#define INTERFERE_FREE_DIVISOR 8
/* Z-lists extend beyond the area that is asked by this part of it. Cost; in interfere/lists.c. */
#define INTERFERE_AREA_DIVISOR 256

/* --------------------------------------------------------------------- boyse */

/*
 * Units of q22 by which a surface counts as nearer for a pair that starts clear. Derived: a place
 * on a path is within 3 units of the pose committed there; two bodies, at the end of one path and
 * at the start of the next. In boyse/boyse.c.
 */
#define BOYSE_ROOT_LEVEL_Q22 12
/* A pair that touches may approach by this part of that level. Chosen; in boyse/boyse.c. */
#define BOYSE_TOUCHING_DIVISOR 64
/* Number of divisions of the level by 4 for edges that become parallel. Chosen; in boyse/boyse.c. */
#define BOYSE_LEVELS 6
/* First step back from a root to its event. Chosen; it doubles; in boyse/boyse.c. */
#define BOYSE_BACK_Q30 (1 << 12)
/* First stride over a root that is no hit. Chosen; it doubles; in boyse/roots.c. */
#define BOYSE_STRIDE_Q30 16

/* ------------------------------------------------------------------- contact */

/* Contacts share a normal above this cosine, 1 - 1e-4. Chosen; in contact/. */
#define CONTACT_SAME_NORMAL_Q30 (CAROM_ONE_Q30 - 107374)
/* Faces lie on each other when no part of their normals differs by more. Chosen. */
#define CONTACT_LEAN_MAX_Q30 (CAROM_ONE_Q30 >> 10)
/*
 * A corner stands out if it does by this part of the way between its neighbours. Chosen; in
 * thin.c.
 */
#define CONTACT_STANDS_OUT_DIVISOR 32
/* Contacts that hold a face. Derived: three hold a plane, four a quadrangle; in contact/thin.c. */
#define CONTACT_ENOUGH 4

/* --------------------------------------------------------------------- solve */

/*
 * Sweeps at most. Chosen: what has not settled goes on in the next frame, so rest needs fewer than
 * an impact that must end in one solve. In solve/sweep.c.
 */
#define REST_SWEEPS_MAX    16  /* impacts of several bodies */
#define REST_SWEEPS_CALM   60  /* without momentum */
#define REST_SWEEPS_EXACT  120 /* an impact of a body or two, without momentum */
#define REST_SWEEPS_FEW    40  /* resting contact at REST_FEW places or fewer */
#define REST_SWEEPS_MANY   48  /* resting contact at more */
#define REST_SWEEPS_JOINTS 150 /* islands with joints */
/* Places that are few. Chosen: contacts of a body or two creep by what sweeps leave. */
#define REST_FEW 8
/* Sweeps end when no velocity changes by more, solver units: the larger, the sooner. Chosen. */
#define REST_RESIDUAL_EXACT    1
#define REST_RESIDUAL_IMPACT   (1 << (REST_BITS - 20))
#define REST_RESIDUAL_REST     (1 << (REST_BITS - 13))
#define REST_RESIDUAL_REST_FEW (1 << (REST_BITS - 16))
/*
 * Contacts slower than this part of the residual are skipped. Chosen: at the whole residual they
 * never get below it, and sweeps run on. In solve/sweep.c.
 */
#define REST_DEAD_DIVISOR 8
/* Contacts, or fewer, that are swept without momentum. Chosen; in solve/sweep.c. */
#define REST_UNHURRIED 3
/*
 * Number of times that sweeps may outgrow their unit; with momentum and warm impulses. Chosen; in
 * solve/sweep.c.
 */
#define REST_OUTGREW_MAX     6
#define REST_OUTGREW_HURRIED 2
/*
 * Number of times that an exact solve sums up its impulses anew, because each push rounds. Chosen;
 * in solve/sweep.c.
 */
#define REST_EXACT_SUMS 2
/* Skins a frame above which a body moves. Chosen: far above what sweeps leave; in solve/rest.c. */
#define REST_MOVES_SKINS 8
/* For bodies that move: a smaller change of velocity is none. Chosen; in solve/rest.c. */
#define REST_LOOSE_DIVISOR 8
/* A slower approach leaves the gap open for many frames. Chosen; in solve/part.c. */
#define REST_SLOW_DIVISOR 32
/* V.N may change by this much where parallel faces share a normal. Chosen; in solve/share.c. */
#define REST_SHARE_DIVISOR 64
/*
 * Parts of a radius: a contact that moved by less than the first stayed where it was; one that
 * moved by more than the second is another contact. Chosen; in solve/warm.c.
 */
#define REST_STAYED_DIVISOR 1024
#define REST_MOVED_DIVISOR  20

/*
 * Targets of contacts (solve/target.c). Contacts rest at a gap of half a skin (the event gap) to
 * 1 + 1/8 skins, where nothing is asked: targets that differ by a hair would shift the weight from
 * corner to corner. Chosen, but for the last.
 */
#define REST_NEAR_DIVISOR 8
/* A nearer gap opens by this much, evenly for the same reason, ... */
#define REST_LIFT_DIVISOR 64
/* ... and by this part of what it lacks to half a skin. */
#define REST_RECOVERY_DIVISOR 5
/* An impact at a gap below this part of a skin opens it again: hits stop at half of one. */
#define REST_TOO_NEAR_DIVISOR 4
/* A slower approach is no impact in lasting contact. */
#define REST_LASTING_DIVISOR 4
/* Bodies that bounce for ever rest below this part of what gravity gives in a frame. */
#define REST_CALM_DIVISOR 8
/* Shortest time to close a gap. Derived: bounds the wanted velocity. */
#define REST_CLOSING_MIN_Q30 (CAROM_ONE_Q30 / 170)

/*
 * The arm of rolling friction in skins, 1/64 of a radius. Derived: a body one skin deep in what
 * gives way has a patch of radius r / 32; the half that it rolls into carries it, and the middle of
 * that half is half as far out. In solve/roll.c.
 */
#define REST_ROLL_SKINS 32
/*
 * The arm of a body that begins to roll down: a body that is to right itself rolls down from rest, where
 * a whole arm would hold it. The arm is whole at the speed that gravity gives in ROLL_FRAMES.
 * A body that rolls up has the whole arm, so one that rocks in a hollow comes to rest. Chosen.
 */
#define REST_ROLL_SKINS_DOWN 2
#define REST_ROLL_FRAMES     2

/* Frames that a body is quiet before it may fall asleep. Chosen; in solve/sleep.c. */
#define REST_QUIET_FRAMES 20
/*
 * Quiet: slower than this part of what gravity gives in a frame. Measured: at an eighth a head that
 * was slowly tipping over fell asleep on its way; at 1/32 none of 20 does, and no drop takes more
 * than a few frames longer.
 */
#define REST_QUIET_DIVISOR 32

/* ---------------------------------------------------------------------- step */

/* Less than a thousandth of a frame is no time to go on for. Chosen; in step/clock.c. */
#define STEP_SLICE_MIN_Q30 (1 << 20)
/* A path ends where so little is left. Derived: roundings of times; in step/clock.c, step/cut.c. */
#define STEP_END_Q30 2
/* The shortest slice of a pair that hits again and again. Chosen; in step/clock.c. */
#define STEP_SHORTEST_Q30 (1 << 8)

/* Paths that are set again to end at their hit (step/cut.c): how often at most. Chosen. */
#define STEP_CUTS_MAX 8
/* The shortest such path. Derived: the turn of a shorter one is below a rotation's last place. */
#define STEP_CUT_MIN_Q30 (1 << 10)
/*
 * The least square of a turn. Chosen: below 2^-10 energy is right to 2^-20 anyway, and rotations of
 * so few digits would lose, slice after slice, the turn by which features face each other.
 */
#define STEP_CUT_TURN2_MIN_Q30 (1 << 8)

/* The search for hits (step/search.c): a hit in this part of a window takes no time. Chosen. */
#define STEP_NO_TIME_Q30 STEP_SLICE_MIN_Q30
/* A nearer pair goes no nearer, or rounding would close the gap in the end. Chosen. */
#define STEP_NEAR_DIVISOR 16
/* Parts of a window at most. Chosen. */
#define STEP_PARTS_MAX 64
/* Many faces: 1 / radians that both turn in a part at most. Chosen. */
#define STEP_TURN_PARTS 4
/* The same in a part whose candidates are gathered to be kept; it orders hits, so chosen. */
#define STEP_KEPT_TURN_PARTS 16
/* Number of halvings of time to find when features face each other. Chosen. */
#define STEP_HALVINGS 20

/*
 * The answer to a hit (step/answer.c): times between event and root at which the touch is
 * computed. Chosen.
 */
#define STEP_ROOT_TRIES 8
/*
 * Number of times that slices become shorter by a factor of 4 if the same pair hits at the same
 * time. Chosen.
 */
#define STEP_SHORTER_MAX 5
/* Repeats after which the island then moves as one body. Chosen. */
#define STEP_CALM_AFTER 1
/*
 * Hits of a pair in a frame after which an island that no solve parted moves as one body. Chosen.
 */
#define STEP_UNSETTLED_HITS 6
/* Repeats after which a kinematic body stops, instead of moving its island along. Derived. */
#define STEP_HARD_AFTER (STEP_CALM_AFTER + STEP_SHORTER_MAX + 4)
/* An island that goes along may approach another body by this much. Chosen; in step/led.c. */
#define STEP_NO_APPROACH_DIVISOR 64

/*
 * Chords of bent paths (step/contacts.c): none for shorter slices, but of lasting contact. Chosen.
 */
#define STEP_CHORD_MIN_Q30   STEP_SLICE_MIN_Q30
#define STEP_LASTING_MIN_Q30 (1 << 12)
/* Nor for what bends by less: the gap of the next frame makes up for it. Chosen. */
#define STEP_CHORD_BEND_DIVISOR 16
/* A pair is in lasting contact that hit more often in the frame, ... Chosen. */
#define STEP_LASTING_HITS 3
/*
 * ... or more often than this where a gap is below that part of a skin: hits stop at half of one.
 * An island with such a lasting contact gets no loose residual (solve/rest.c).
 */
#define STEP_CLOSED_HITS    1
#define STEP_CLOSED_DIVISOR 16
/* The opening of a lasting contact is also measured at 1/2 and 1 / this of the slice. Chosen. */
#define STEP_SOONEST 8

/*
 * Regions (step/regions.c): a region ends when this part of the radius is gone. Cost: in contact,
 * ...
 */
#define STEP_REGION_PARTS 10
/* ... in flight, where a hit may change the path long before, and while nothing is near. */
#define STEP_REGION_PARTS_FLIGHT 20
#define STEP_REGION_PARTS_FREE   4
/* Frames at most if gravity bends the path: the bend grows with the square of time. Cost. */
#define STEP_BENT_FRAMES 8
/* A shorter slice is not extended over frames. Cost. */
#define STEP_GONE_ON_MIN_Q30 (1 << 24)
/* Room is at most this part of the radius: what is swept grows with it. Cost. */
#define STEP_ROOM_PARTS 64
/* Skins: a hit leads a faster body aside by more than any room. Cost. */
#define STEP_ROOM_WAY_SKINS 10

/* Gathers (step/visit.c): more candidates end a region that lasts because it had none. Cost. */
#define STEP_ENOUGH 8
/* Two meshes have many faces with so many pairs of faces. Chosen: it orders hits, see above. */
#define STEP_FACE_PAIRS_MANY 500
/* Radians that both turn, below which candidates of many faces are kept. Cost. */
#define STEP_TURN_KEPT_Q30 (CAROM_ONE_Q30 / 16 * 5)
/*
 * A body goes far that goes this part of its radius in its region; pairs of faces that are dear.
 * Cost.
 */
#define STEP_FAR_PARTS         8
#define STEP_FACE_PAIRS_COSTLY 1000000

/*
 * Joints: solves at most, as paths bend and anchors may be off after one. Chosen; in
 * step/contacts.c.
 */
#define STEP_JOINT_ROUNDS 8
/*
 * Shorter slices are not measured: their rows are lost in positions' last places. In
 * joint_measure.c.
 */
#define STEP_MEASURED_MIN_Q30 (CAROM_ONE_Q30 / 32)
/*
 * The shortest part of a frame in which an anchor that is off comes back. Chosen; in
 * joint_measure.c.
 */
#define STEP_RECOVERY_MIN_Q30 (CAROM_ONE_Q30 / 4)
/* The error allowed at the end of a slice. Chosen; in joint_measure.c. */
#define STEP_LEFT_DIVISOR 8
/*
 * A kinematic body stops if it would leave an error of this many skins. Chosen; in
 * joint_measure.c.
 */
#define STEP_TORN_SKINS 4
/*
 * A spring pulls for half the time, and its group takes shorter slices, until it changes a velocity
 * by no more than this part of what leads to no pull: an eighteenth is a third of a radian of the
 * free swing, whose period comes out 1 % long. Not below 1/16 of a frame. A spring that is at more
 * than a third then, 1 radian, gives its impulse at once. Chosen; in joint_spring.c.
 */
#define JOINT_SWING_Q30      (CAROM_ONE_Q30 / 18)
#define JOINT_SWING_MOST_Q30 (CAROM_ONE_Q30 / 3)
#define JOINT_PULL_LEAST_Q30 (CAROM_ONE_Q30 / 16)
/*
 * A pull that goes on beyond the end of its slice by more than this part of itself is cut to the
 * slice. Chosen; in joint_measure.c.
 */
#define STEP_PULL_OVER_DIVISOR 2
/*
 * Radians that what joints hold turns in a slice at most. Chosen: anchors part by what that bends,
 * and solves see it as straight. In joint_measure.c.
 */
#define STEP_JOINT_TURN_Q30 (CAROM_ONE_Q30 / 8)
/*
 * An island that spins faster, radians a frame, does not go through it as one rigid body. Chosen:
 * some 128 slices. In step/as_one.c.
 */
#define STEP_AS_ONE_SPIN_MAX_Q40 ((int64_t)64 << 40)
/*
 * Momenta are multiplied by 7/8 to 9/8 to change energy by what is owed. Chosen; in step/energy.c.
 */
#define STEP_CONSERVE_LEAST_Q30 (CAROM_ONE_Q30 - (CAROM_ONE_Q30 >> 3))
#define STEP_CONSERVE_MOST_Q30  (CAROM_ONE_Q30 + (CAROM_ONE_Q30 >> 3))

/* --------------------------------------------------------------------- world */

/*
 * Skins: bodies that come apart within so many, one way or another, hardly touch. In
 * world/apart.c.
 */
#define WORLD_SHALLOW_SKINS 2
/* Skins: the first step of a push out; steps double from there. Chosen; in world/apart.c. */
#define WORLD_FIRST_SKINS 4
/* Number of halvings of the way of a push out after that. Chosen; in world/apart.c. */
#define WORLD_HALVINGS 10
/*
 * Units that a body is pushed or lifted at most. Derived: a path is shorter than BODY_SPEED_LIMIT,
 * some skins included. In world/apart.c and world/moving.c.
 */
#define WORLD_WAY_MAX 60
/* Rounds at most of lifting bodies that were lifted into each other. Chosen; in world/moving.c. */
#define WORLD_LIFT_ROUNDS 64

#endif
