/* SPDX-License-Identifier: MIT */
/*
 * carom.hpp - Carom for C++17: units in types, memory in objects, results that must be checked. It is a header over carom.h, whose rules
 * hold. It allocates and throws nothing; its calls are inline calls of the C interface.
 *
 *   Mesh<V, F>   a mesh and its memory; World<Caps<...>>: a world and its memory. Neither can be copied or moved. Calls on
 *                one that could not be made, or was not started, give CAROM_ERR_NULL
 *   BodyDef, JointDef, Drive, WorldDef     definitions, set by name
 *   Body, Joint  handles: a world and a number
 *   Result<T>    a value or an enum carom_error; Result<>: success or an error
 *
 * For functions without a method here, c() gives the C object.
 */
#ifndef CAROM_HPP
#define CAROM_HPP

#include "carom_body.h"
#include "carom_joint.h"
#include "carom_query.h"
#include "carom_units.hpp"

namespace carom
{

struct None {
};
struct Unset {
};

/* A value, or a negative enum carom_error. */
template <class T = None> class [[nodiscard]] Result
{
  public:
    constexpr Result(int code, T value = T{}) : code_(code), value_(value)
    {
    }
    constexpr explicit operator bool() const
    {
        return code_ >= 0;
    }
    /* CAROM_OK, a sum of enum carom_status, or an enum carom_error. */
    constexpr int code() const
    {
        return code_;
    }
    const char *text() const
    {
        return carom_result_text(code_);
    }
    /* After an error: a T of no world, whose methods give errors. */
    constexpr const T &operator*() const
    {
        return value_;
    }
    constexpr const T *operator->() const
    {
        return &value_;
    }

  private:
    friend class Body;
    explicit Result(Unset unset) : value_(unset)
    {
    }

    int code_;
    T value_;
};

/* ------------------------------------------------------------------- meshes */

enum class Kind : uint8_t { solid = CAROM_SOLID, surface = CAROM_SURFACE };

/* A mesh of V vertices and F faces, with the memory of its index. The arrays must outlive it. */
template <uint32_t V, uint32_t F> class Mesh
{
  public:
    /* Vertices are quanta of 2^-quantum_bits m. built() tells if it succeeded. */
    Mesh(const int16_t (&vertices)[V][3], const uint16_t (&faces)[F][3], Kind kind = Kind::solid,
         uint8_t quantum_bits = 8)
    {
        const carom_mesh_raw raw = {vertices, faces,        V,
                                    F,        quantum_bits, static_cast<uint8_t>(kind)};

        result_ = carom_mesh_build(&mesh_, &raw, memory_, sizeof memory_);
    }
    Mesh(const Mesh &) = delete;
    Mesh &operator=(const Mesh &) = delete;

    Result<> built() const
    {
        return result_;
    }
    const carom_mesh *c() const
    {
        return result_ < 0 ? nullptr : &mesh_;
    }

  private:
    int result_;
    carom_mesh mesh_;
    alignas(8) uint8_t memory_[CAROM_MESH_BYTES(V, F)];
};

/* ------------------------------------------------------------------- bodies */

constexpr carom_quat_q30 no_rotation = {{0, 0, 0, 0}};

class BodyDef
{
  public:
    template <uint32_t V, uint32_t F> explicit BodyDef(const Mesh<V, F> &mesh)
    {
        def_.mesh = mesh.c();
    }
    BodyDef &stationary()
    {
        def_.stationary = true;
        return *this;
    }
    BodyDef &kinematic()
    {
        def_.kinematic = true;
        return *this;
    }
    BodyDef &sensor()
    {
        def_.sensor = true;
        return *this;
    }
    BodyDef &position(const Vec<Length> &place)
    {
        def_.position = place.c();
        return *this;
    }
    BodyDef &rotation(const carom_quat_q30 &rotation)
    {
        def_.rotation = rotation;
        return *this;
    }
    BodyDef &velocity(const Vec<Velocity> &velocity)
    {
        def_.velocity = velocity.c();
        return *this;
    }
    BodyDef &spin(const Vec<Spin> &spin)
    {
        def_.spin = spin.c();
        return *this;
    }
    BodyDef &mass(Mass mass)
    {
        def_.mass_q20 = mass.raw();
        return *this;
    }
    BodyDef &restitution(Restitution e)
    {
        def_.restitution_q30 = e.raw();
        return *this;
    }
    BodyDef &friction(Friction mu)
    {
        def_.friction_q16 = mu.raw();
        return *this;
    }
    BodyDef &filter(const carom_filter &filter)
    {
        def_.filter = filter;
        return *this;
    }
    BodyDef &one_way(carom_one_way side)
    {
        def_.one_way = static_cast<uint8_t>(side);
        return *this;
    }
    BodyDef &overlap(carom_overlap what)
    {
        def_.overlap = static_cast<uint8_t>(what);
        return *this;
    }
    BodyDef &user(void *user)
    {
        def_.user = user;
        return *this;
    }
    const carom_body_def &c() const
    {
        return def_;
    }

  private:
    carom_body_def def_ = {};
};

/* Where a body is and how it moves; `overlap` as in carom_body_state. */
class State
{
  public:
    constexpr State() : state_{}
    {
    }
    Vec<Length> position() const
    {
        return Vec<Length>::from(state_.position);
    }
    const carom_quat_q30 &rotation() const
    {
        return state_.rotation;
    }
    Vec<Velocity> velocity() const
    {
        return Vec<Velocity>::from(state_.velocity);
    }
    Vec<Spin> spin() const
    {
        return Vec<Spin>::from(state_.spin);
    }
    bool asleep() const
    {
        return state_.asleep;
    }
    bool out() const
    {
        return state_.out;
    }
    State &position(const Vec<Length> &place)
    {
        state_.position = place.c();
        return *this;
    }
    State &rotation(const carom_quat_q30 &rotation)
    {
        state_.rotation = rotation;
        return *this;
    }
    State &velocity(const Vec<Velocity> &velocity)
    {
        state_.velocity = velocity.c();
        return *this;
    }
    State &spin(const Vec<Spin> &spin)
    {
        state_.spin = spin.c();
        return *this;
    }
    State &overlap(carom_overlap what)
    {
        state_.overlap = static_cast<uint8_t>(what);
        return *this;
    }
    const carom_body_state &c() const
    {
        return state_;
    }

  private:
    template <class T> friend class Result;
    friend class Body;
    explicit State(Unset)
    {
    }

    carom_body_state state_;
};

/* A body of a world. */
class Body
{
  public:
    constexpr Body(carom_world *world = nullptr, int number = -1) : world_(world), number_(number)
    {
    }
    constexpr int number() const
    {
        return number_;
    }
    Result<State> state() const
    {
        Result<State> result{Unset()};

        result.code_ = carom_body_get(world_, number_, &result.value_.state_);
        if (!result) {
            result.value_ = State();
        }
        return result;
    }
    Result<> set(const State &state) const
    {
        return carom_body_set(world_, number_, &state.c());
    }
    Result<> move_to(const Vec<Length> &place, const carom_quat_q30 &rotation = no_rotation) const
    {
        const carom_pose pose = {place.c(), rotation};

        return carom_body_move_to(world_, number_, &pose);
    }
    Result<> push(const Vec<Impulse> &impulse) const
    {
        const carom_v3_q40 given = impulse.c();

        return carom_body_push_centre(world_, number_, &given);
    }
    Result<> push(const Vec<Impulse> &impulse, const Vec<Length> &point) const
    {
        const carom_v3_q40 given = impulse.c();
        const carom_v3_q32 place = point.c();

        return carom_body_push(world_, number_, &given, &place);
    }
    Result<> twist(const Vec<Twist> &angular) const
    {
        const carom_v3_q40 given = angular.c();

        return carom_body_twist(world_, number_, &given);
    }
    Result<> force(const Vec<Force> &force) const
    {
        const carom_v3_q40 given = force.c();

        return carom_body_set_force(world_, number_, &given);
    }
    Result<> torque(const Vec<Torque> &torque) const
    {
        const carom_v3_q40 given = torque.c();

        return carom_body_set_torque(world_, number_, &given);
    }
    Result<> mass(Mass mass) const
    {
        return carom_body_set_mass(world_, number_, mass.raw());
    }
    Result<> remove() const
    {
        return carom_body_remove(world_, number_);
    }

  private:
    carom_world *world_;
    int number_;
};

} // namespace carom

#include "carom_world.hpp"

#endif
