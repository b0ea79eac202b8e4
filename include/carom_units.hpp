/* SPDX-License-Identifier: MIT */
/*
 * carom_units.hpp - numbers with units for C++17, over the formats of carom_fix.h. carom.hpp includes it.
 *
 *   1.5_m, 9.81_m_s2, 90_deg_s, ...   literals in SI units, exact decimals: the number is in the type
 *   Fixed<..>   an integer of the engine: Length, Velocity, Spin, Mass, ... Time is counted in frames
 *   Vec<Q>      three of them
 *
 * All have their dimension in the type. So metres added to radians, or a velocity in place of a position, do not compile. A literal without
 * time becomes a Fixed by itself; a literal with seconds needs the frames in a second: `constexpr carom::Fps<60> fps;` and fps(9.81_m_s2).
 * Numbers are cut off to their format, with the same bits as by the macros of carom_fix.h. The compiler computes them, without floating point;
 * a number that does not fit its format does not compile.
 */
#ifndef CAROM_UNITS_HPP
#define CAROM_UNITS_HPP

#include "carom_fix.h"

namespace carom
{

/* Exponents of a dimension. Time: of frames in a Fixed, of seconds in a Literal. */
template <int Kilograms, int Metres, int Radians, int Time> struct Dimension {
    static constexpr int time = Time;
};
using One = Dimension<0, 0, 0, 0>;
using Kilogram = Dimension<1, 0, 0, 0>;
using Metre = Dimension<0, 1, 0, 0>;
using Radian = Dimension<0, 0, 1, 0>;
using MetrePerTime = Dimension<0, 1, 0, -1>;
using RadianPerTime = Dimension<0, 0, 1, -1>;
using MetrePerTime2 = Dimension<0, 1, 0, -2>;
using NewtonTime = Dimension<1, 1, 0, -1>;
using Newton = Dimension<1, 1, 0, -2>;
using NewtonMetreTime = Dimension<1, 2, 0, -1>;
using NewtonMetre = Dimension<1, 2, 0, -2>;
using NewtonPerMetre = Dimension<1, 0, 0, -2>;
using NewtonTimePerMetre = Dimension<1, 0, 0, -1>;
using NewtonMetrePerRadian = Dimension<1, 2, -1, -2>;
using NewtonMetreTimePerRadian = Dimension<1, 2, -1, -1>;

/* N / D of the SI unit of a dimension. */
template <class Of, int64_t N, int64_t D> struct Literal {
    constexpr Literal<Of, -N, D> operator-() const
    {
        return {};
    }
    constexpr Literal operator+() const
    {
        return {};
    }
};

/*
 * n / d with fractional bits, cut off towards zero; bit by bit, so that only the result must fit; d below 2^62. A result that does not fit becomes
 * INT64_MAX, which no function of the engine takes.
 */
constexpr int64_t cut_off(int64_t n, int64_t d, int bits)
{
    const bool negative = n < 0;
    const int64_t size = negative ? -n : n;
    int64_t quotient = size / d, rest = size % d;

    for (int i = 0; i < bits; i++) {
        if (quotient >= INT64_MAX / 2) {
            return INT64_MAX;
        }
        rest *= 2;
        quotient = 2 * quotient + (rest >= d ? 1 : 0);
        rest -= rest >= d ? d : 0;
    }
    return negative ? -quotient : quotient;
}

/* A number of the engine: `raw` times 2^-Bits. */
template <class D, int Bits, class Int = int64_t> class Fixed
{
  public:
    static constexpr int bits = Bits;

    constexpr Fixed() = default;
    /* SI without time has the engine's units. */
    template <int64_t N, int64_t Parts>
    constexpr Fixed(Literal<D, N, Parts>) : raw_(fitting<cut_off(N, Parts, Bits)>())
    {
        static_assert(D::time == 0, "say how many frames a second has: fps(9.81_m_s2)");
    }
    static constexpr Fixed from_raw(Int raw)
    {
        Fixed made;
        made.raw_ = raw;
        return made;
    }
    /* A number known at run time, in a unit: Length::times(height, 1_mm). */
    template <int64_t N, int64_t Parts>
    static constexpr Fixed times(int32_t count, Literal<D, N, Parts>)
    {
        static_assert(D::time == 0, "say how many frames a second has: fps.times(count, 1_mm_s)");
        static_assert(N <= INT32_MAX, "the unit has too many digits");
        return from_raw(static_cast<Int>(cut_off(count * N, Parts, Bits)));
    }
    constexpr Int raw() const
    {
        return raw_;
    }

    friend constexpr Fixed operator+(Fixed a, Fixed b)
    {
        return from_raw(static_cast<Int>(a.raw_ + b.raw_));
    }
    friend constexpr Fixed operator-(Fixed a, Fixed b)
    {
        return from_raw(static_cast<Int>(a.raw_ - b.raw_));
    }
    constexpr Fixed operator-() const
    {
        return from_raw(static_cast<Int>(-raw_));
    }
    friend constexpr Fixed operator*(Fixed a, Int times)
    {
        return from_raw(static_cast<Int>(a.raw_ * times));
    }
    friend constexpr Fixed operator/(Fixed a, Int parts)
    {
        return from_raw(static_cast<Int>(a.raw_ / parts));
    }
    /* Whole units, rounded down, for a unit without time: height / 1_mm. */
    template <int64_t N, int64_t Parts> constexpr int64_t operator/(Literal<D, N, Parts>) const
    {
        static_assert(D::time == 0, "a value a second is none a frame: use raw()");
        const int64_t whole = (static_cast<int64_t>(raw_) * Parts) >> Bits;
        return whole / N - (whole % N < 0 ? 1 : 0);
    }
    friend constexpr bool operator==(Fixed a, Fixed b)
    {
        return a.raw_ == b.raw_;
    }
    friend constexpr bool operator!=(Fixed a, Fixed b)
    {
        return a.raw_ != b.raw_;
    }
    friend constexpr bool operator<(Fixed a, Fixed b)
    {
        return a.raw_ < b.raw_;
    }
    friend constexpr bool operator>(Fixed a, Fixed b)
    {
        return a.raw_ > b.raw_;
    }

  private:
    template <int64_t Wide> static constexpr Int fitting()
    {
        static_assert(Wide != INT64_MAX && static_cast<int64_t>(static_cast<Int>(Wide)) == Wide,
                      "the number does not fit its format");
        return static_cast<Int>(Wide);
    }

    Int raw_ = 0;
};

using Length = Fixed<Metre, 32>;
using Angle = Fixed<Radian, 32>; /* of a joint */
using Velocity = Fixed<MetrePerTime, 40>;
using Spin = Fixed<RadianPerTime, 40>;
using Acceleration = Fixed<MetrePerTime2, 40>;
using Force = Fixed<Newton, 40>;
using Impulse = Fixed<NewtonTime, 40>;
using Torque = Fixed<NewtonMetre, 40>;
using Twist = Fixed<NewtonMetreTime, 40>;
using Stiffness = Fixed<NewtonPerMetre, 40>;
using Damping = Fixed<NewtonTimePerMetre, 40>;
using TurnStiffness = Fixed<NewtonMetrePerRadian, 40>;
using TurnDamping = Fixed<NewtonMetreTimePerRadian, 40>;
using Mass = Fixed<Kilogram, 20, uint32_t>;
using Restitution = Fixed<One, 30, int32_t>;
using Part = Fixed<One, 30, int32_t>; /* of a way, of a unit vector */
using Friction = Fixed<One, 16, uint32_t>;

/* Three of a kind, and the struct of the C interface for them. */
template <int Bits> struct VecOf;
template <> struct VecOf<30> {
    using type = carom_v3_q30;
};
template <> struct VecOf<32> {
    using type = carom_v3_q32;
};
template <> struct VecOf<40> {
    using type = carom_v3_q40;
};
template <class Q> struct Vec {
    using c_type = typename VecOf<Q::bits>::type;
    Q x, y, z;

    constexpr c_type c() const
    {
        return {{x.raw(), y.raw(), z.raw()}};
    }
    static constexpr Vec from(const c_type &v)
    {
        return {Q::from_raw(v.c[0]), Q::from_raw(v.c[1]), Q::from_raw(v.c[2])};
    }
};

/* Frames a second: converts values a second to values a frame. */
template <int64_t Frames> struct Fps {
    template <class D, int64_t N, int64_t Parts>
    constexpr Fixed<D, 40> operator()(Literal<D, N, Parts>) const
    {
        constexpr int64_t raw = cut_off(N, Parts * in_seconds<D>(), 40);
        static_assert(raw != INT64_MAX, "the number does not fit its format");
        return Fixed<D, 40>::from_raw(raw);
    }
    template <class X, class Y, class Z> constexpr auto operator()(X x, Y y, Z z) const
    {
        return Vec<decltype((*this)(x))>{(*this)(x), (*this)(y), (*this)(z)};
    }
    /* A number known at run time, in a unit. */
    template <class D, int64_t N, int64_t Parts>
    static constexpr Fixed<D, 40> times(int32_t count, Literal<D, N, Parts>)
    {
        static_assert(N <= INT32_MAX, "the unit has too many digits");
        return Fixed<D, 40>::from_raw(cut_off(count * N, Parts * in_seconds<D>(), 40));
    }

  private:
    template <class D> static constexpr int64_t in_seconds()
    {
        static_assert(D::time == -1 || D::time == -2, "there are no seconds in this unit");
        return D::time == -1 ? Frames : Frames * Frames;
    }
};

/* The digits of a literal as n / d; d is 0 for a power, a letter or too many digits. */
struct Decimal {
    int64_t n, d;
};
template <char... Digits> constexpr Decimal decimal()
{
    const char text[] = {Digits...};
    Decimal found = {0, 1};
    bool point = false;

    for (const char digit : text) {
        if (digit == '.' && !point) {
            point = true;
        } else if (digit >= '0' && digit <= '9' && found.n < 100000000000 && found.d < 10000000) {
            found = {10 * found.n + (digit - '0'), found.d * (point ? 10 : 1)};
        } else if (digit != '\'') {
            return {0, 0};
        }
    }
    return found;
}
template <class Of, int64_t Times, int64_t Parts, char... Digits> constexpr auto literal()
{
    constexpr Decimal number = decimal<Digits...>();
    static_assert(number.d > 0, "a literal has up to 12 digits, 7 of them after the point");
    return Literal<Of, number.n * Times, number.d * Parts>{};
}

namespace literals
{
/* A literal: a number times n / d of a unit. */
#define CAROM_LITERAL_(suffix, dimension, ...)                                                     \
    template <char... Digits> constexpr auto operator""_##suffix()                                 \
    {                                                                                              \
        return literal<dimension, __VA_ARGS__, Digits...>();                                       \
    }
/* pi / 180: a convergent of its continued fraction, off by 1e-15 of it */
#define CAROM_DEGREE_ 2845738, 163048777
CAROM_LITERAL_(of_1, One, 1, 1)
CAROM_LITERAL_(kg, Kilogram, 1, 1)
CAROM_LITERAL_(g, Kilogram, 1, 1000)
CAROM_LITERAL_(m, Metre, 1, 1)
CAROM_LITERAL_(mm, Metre, 1, 1000)
CAROM_LITERAL_(rad, Radian, 1, 1)
CAROM_LITERAL_(mrad, Radian, 1, 1000)
CAROM_LITERAL_(deg, Radian, CAROM_DEGREE_)
CAROM_LITERAL_(m_s, MetrePerTime, 1, 1)
CAROM_LITERAL_(mm_s, MetrePerTime, 1, 1000)
CAROM_LITERAL_(m_s2, MetrePerTime2, 1, 1)
CAROM_LITERAL_(mm_s2, MetrePerTime2, 1, 1000)
CAROM_LITERAL_(rad_s, RadianPerTime, 1, 1)
CAROM_LITERAL_(mrad_s, RadianPerTime, 1, 1000)
CAROM_LITERAL_(deg_s, RadianPerTime, CAROM_DEGREE_)
CAROM_LITERAL_(N, Newton, 1, 1)
CAROM_LITERAL_(N_s, NewtonTime, 1, 1)
CAROM_LITERAL_(N_m, NewtonMetre, 1, 1)
CAROM_LITERAL_(N_m_s, NewtonMetreTime, 1, 1)
CAROM_LITERAL_(N_per_m, NewtonPerMetre, 1, 1)
CAROM_LITERAL_(N_s_per_m, NewtonTimePerMetre, 1, 1)
CAROM_LITERAL_(N_m_per_rad, NewtonMetrePerRadian, 1, 1)
CAROM_LITERAL_(N_m_s_per_rad, NewtonMetreTimePerRadian, 1, 1)
#undef CAROM_DEGREE_
#undef CAROM_LITERAL_

/* Values that are per frame already: plain fixed-point numbers. */
#define CAROM_FRAME_LITERAL_(suffix, dimension)                                                    \
    template <char... Digits> constexpr auto operator""_##suffix()                                 \
    {                                                                                              \
        return Fps<1>{}(literal<dimension, 1, 1, Digits...>());                                    \
    }
CAROM_FRAME_LITERAL_(m_frame, MetrePerTime)
CAROM_FRAME_LITERAL_(rad_frame, RadianPerTime)
CAROM_FRAME_LITERAL_(m_frame2, MetrePerTime2)
#undef CAROM_FRAME_LITERAL_
} // namespace literals

} // namespace carom

#endif
