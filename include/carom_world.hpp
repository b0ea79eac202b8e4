/* SPDX-License-Identifier: MIT */
/* carom_world.hpp - the second half of carom.hpp, which includes it: joints, and the world. */
#ifndef CAROM_WORLD_HPP
#define CAROM_WORLD_HPP

#include "carom.hpp"

namespace carom
{

/* ------------------------------------------------------------------- joints */

/* Limits, motor and spring: angles and torques for a hinge, lengths and forces otherwise. */
template <class Q, class Rate, class Most, class Stiffness, class Damping> class Drive
{
  public:
    Drive &limits(Q lower, Q upper)
    {
        drive_.limited = true;
        drive_.lower_q32 = lower.raw();
        drive_.upper_q32 = upper.raw();
        return *this;
    }
    Drive &motor(Rate speed, Most most)
    {
        drive_.motor = true;
        drive_.motor_speed_q40 = speed.raw();
        drive_.motor_most_q40 = most.raw();
        return *this;
    }
    Drive &spring(Q rest, Stiffness stiffness, Damping damping)
    {
        drive_.spring = true;
        drive_.rest_q32 = rest.raw();
        drive_.stiffness_q40 = stiffness.raw();
        drive_.damping_q40 = damping.raw();
        return *this;
    }
    const carom_joint_drive &c() const
    {
        return drive_;
    }

  private:
    carom_joint_drive drive_ = {};
};
using HingeDrive = Drive<Angle, Spin, Torque, TurnStiffness, TurnDamping>;
using SlideDrive = Drive<Length, Velocity, Force, Stiffness, Damping>;

/* A joint between `a` and the world, or between `a` and the body given to to(). */
class JointDef
{
  public:
    static JointDef ball(Body a, const Vec<Length> &anchor)
    {
        return JointDef(CAROM_JOINT_BALL, a, anchor);
    }
    static JointDef fixed(Body a, const Vec<Length> &anchor)
    {
        return JointDef(CAROM_JOINT_FIXED, a, anchor);
    }
    static JointDef hinge(Body a, const Vec<Length> &anchor, const Vec<Part> &axis,
                          const HingeDrive &drive = {})
    {
        JointDef made(CAROM_JOINT_HINGE, a, anchor);

        made.def_.axis = axis.c();
        made.def_.drive = drive.c();
        return made;
    }
    static JointDef slider(Body a, const Vec<Length> &anchor, const Vec<Part> &axis,
                           const SlideDrive &drive = {})
    {
        JointDef made(CAROM_JOINT_SLIDER, a, anchor);

        made.def_.axis = axis.c();
        made.def_.drive = drive.c();
        return made;
    }
    static JointDef distance(Body a, const Vec<Length> &anchor, const Vec<Length> &anchor_b,
                             const SlideDrive &drive)
    {
        JointDef made(CAROM_JOINT_DISTANCE, a, anchor);

        made.def_.anchor_b = anchor_b.c();
        made.def_.drive = drive.c();
        return made;
    }
    JointDef &to(Body b)
    {
        def_.b = b.number();
        return *this;
    }
    JointDef &touch()
    {
        def_.touch = true;
        return *this;
    }
    JointDef &breaks_above(Impulse most)
    {
        def_.most_impulse_q40 = most.raw();
        return *this;
    }
    const carom_joint_def &c() const
    {
        return def_;
    }

  private:
    JointDef(carom_joint_kind kind, Body a, const Vec<Length> &anchor)
    {
        def_.kind = static_cast<uint8_t>(kind);
        def_.a = a.number();
        def_.b = CAROM_WORLD;
        def_.anchor = anchor.c();
    }

    carom_joint_def def_ = {};
};

/* A joint of a world. */
class Joint
{
  public:
    constexpr Joint(carom_world *world = nullptr, int number = -1) : world_(world), number_(number)
    {
    }
    constexpr int number() const
    {
        return number_;
    }
    Result<carom_joint_state> state() const
    {
        carom_joint_state state = {};
        const int code = carom_joint_get(world_, number_, &state);

        return {code, state};
    }
    Result<> drive(const HingeDrive &drive) const
    {
        return carom_joint_set(world_, number_, &drive.c());
    }
    Result<> drive(const SlideDrive &drive) const
    {
        return carom_joint_set(world_, number_, &drive.c());
    }
    Result<> remove() const
    {
        return carom_joint_remove(world_, number_);
    }

  private:
    carom_world *world_;
    int number_;
};

/* ------------------------------------------------------------------- worlds */

/* Capacities, in the order of carom_memory.h. */
template <uint32_t Bodies, uint32_t Pairs, uint32_t Contacts, uint32_t Faces, uint32_t Entries,
          uint32_t Candidates, uint32_t Joints = 0, uint32_t Extras = 0, uint32_t Hits = 0>
struct Caps {
    static constexpr size_t bytes = CAROM_WORLD_BYTES(Bodies, Pairs, Contacts, Faces, Entries,
                                                      Candidates, Joints, Extras, Hits);
    static constexpr carom_caps caps =
        CAROM_CAPS(Bodies, Pairs, Contacts, Faces, Entries, Candidates, Joints, Extras, Hits);
};

/* How a world is made. Set plain numbers of carom_config on `config`. */
struct WorldDef {
    Vec<Acceleration> gravity;
    bool sleep = false;
    carom_config config = {};
};

/* Results that lie in the world until its next step. */
template <class T> class View
{
  public:
    View(const T *first, int count) : first_(first), count_(count)
    {
    }
    const T *begin() const
    {
        return first_;
    }
    const T *end() const
    {
        return count_ > 0 ? first_ + count_ : first_;
    }
    int size() const
    {
        return count_ > 0 ? count_ : 0;
    }

  private:
    const T *first_;
    int count_;
};

/* A world and its memory, which is part of the object, wherever the caller puts it. */
template <class Capacities> class World
{
  public:
    World() = default;
    World(const World &) = delete;
    World &operator=(const World &) = delete;

    /* Make it empty. A second start removes its bodies. */
    Result<> start(const WorldDef &def)
    {
        carom_config config = def.config;

        config.caps = Capacities::caps;
        config.gravity = def.gravity.c();
        config.sleep = def.sleep;
        return carom_world_init(block_, sizeof block_, &config, &world_);
    }
    Result<Body> add(const BodyDef &def)
    {
        const int number = carom_body_add(world_, &def.c());

        return {number, Body(world_, number)};
    }
    Result<Joint> add(const JointDef &def)
    {
        const int number = carom_joint_add(world_, &def.c());

        return {number, Joint(world_, number)};
    }
    /* code() is a sum of enum carom_status. */
    Result<> step()
    {
        return carom_world_step(world_);
    }
    Result<> gravity(const Vec<Acceleration> &gravity)
    {
        const carom_v3_q40 given = gravity.c();

        return carom_world_set_gravity(world_, &given);
    }
    /* The body of a number, as in events. */
    Body body(int number)
    {
        return Body(world_, number);
    }
    View<carom_event> events() const
    {
        const carom_event *first = nullptr;
        const int count = carom_events(world_, &first);

        return {first, count};
    }
    /* *result: the first face on the way, if code() is 1. */
    Result<carom_ray_hit> cast_ray(const Vec<Length> &from, const Vec<Length> &way,
                                   const carom_query_filter *filter = nullptr) const
    {
        const carom_ray ray = {from.c(), way.c()};
        carom_ray_hit hit = {};
        const int code = carom_cast_ray(world_, &ray, filter, &hit);

        return {code, hit};
    }
    uint64_t hash() const
    {
        return carom_world_hash(world_);
    }
    Result<> save(void *out, size_t bytes) const
    {
        return carom_snapshot_save(world_, out, bytes);
    }
    Result<> load(const void *in, size_t bytes)
    {
        return carom_snapshot_load(world_, in, bytes);
    }
    /* For the rest of the C interface; NULL before start(). */
    carom_world *c() const
    {
        return world_;
    }

  private:
    carom_world *world_ = nullptr;
    alignas(8) uint8_t block_[Capacities::bytes];
};

} // namespace carom

#endif
