// The fields of a plain struct, in order, without naming them: what is made from all fields of a type cannot forget one
// that is added later.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace intarsia {
namespace fields_detail {

struct Anything {
  template <class T>
  operator T() const;
};

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), Anything{})...}; };
}

template <class T, std::size_t N = 40>
constexpr std::size_t count_fields() {
  if constexpr (N == 0)
    return 0;
  else if constexpr (takes<T>(std::make_index_sequence<N>{}))
    return N;
  else
    return count_fields<T, N - 1>();
}

}  // namespace fields_detail

// A type with private fields or constructors offers them by a member template visit_fields(f), const and not, which
// calls f with each.
template <class T>
concept HasFieldVisit = requires(std::remove_const_t<T>& value) {
  value.visit_fields([](auto&) {});
};

#define INTARSIA_FIELDS(count, ...) \
  else if constexpr (fields == count) {  \
    auto& [__VA_ARGS__] = value;    \
    each(__VA_ARGS__);              \
  }

// call(field) for every field of `value`, in order of declaration. Requires: T has visit_fields or is an aggregate of
// at most 39 fields without base classes and C arrays (counts are checked by the compiler).
template <class T, class F>
constexpr void for_each_field(T& value, F&& call) {
  using Plain = std::remove_const_t<T>;
  if constexpr (HasFieldVisit<Plain>) {
    value.visit_fields(call);
  } else {
    static_assert(std::is_aggregate_v<Plain>, "give this type a member visit_fields");
    constexpr std::size_t fields = fields_detail::count_fields<Plain>();
    static_assert(fields > 0 && fields < 40, "too many fields, or fields that cannot be counted");
    const auto each = [&call](auto&... field) { (call(field), ...); };
    // clang-format off
    if constexpr (fields == 0) {}
    INTARSIA_FIELDS(1, a)
    INTARSIA_FIELDS(2, a, b)
    INTARSIA_FIELDS(3, a, b, c)
    INTARSIA_FIELDS(4, a, b, c, d)
    INTARSIA_FIELDS(5, a, b, c, d, e)
    INTARSIA_FIELDS(6, a, b, c, d, e, f)
    INTARSIA_FIELDS(7, a, b, c, d, e, f, g)
    INTARSIA_FIELDS(8, a, b, c, d, e, f, g, h)
    INTARSIA_FIELDS(9, a, b, c, d, e, f, g, h, i)
    INTARSIA_FIELDS(10, a, b, c, d, e, f, g, h, i, j)
    INTARSIA_FIELDS(11, a, b, c, d, e, f, g, h, i, j, k)
    INTARSIA_FIELDS(12, a, b, c, d, e, f, g, h, i, j, k, l)
    INTARSIA_FIELDS(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
    INTARSIA_FIELDS(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
    INTARSIA_FIELDS(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
    INTARSIA_FIELDS(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
    INTARSIA_FIELDS(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
    INTARSIA_FIELDS(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
    INTARSIA_FIELDS(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
    INTARSIA_FIELDS(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
    INTARSIA_FIELDS(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
    INTARSIA_FIELDS(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v)
    INTARSIA_FIELDS(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w)
    INTARSIA_FIELDS(24, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x)
    INTARSIA_FIELDS(25, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y)
    INTARSIA_FIELDS(26, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z)
    INTARSIA_FIELDS(27, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2)
    INTARSIA_FIELDS(28, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2)
    INTARSIA_FIELDS(29, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2)
    INTARSIA_FIELDS(30, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2)
    INTARSIA_FIELDS(31, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2, e2)
    INTARSIA_FIELDS(32, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2, e2, f2)
    INTARSIA_FIELDS(33, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2, e2, f2, g2)
    INTARSIA_FIELDS(34, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2, e2, f2, g2, h2)
    INTARSIA_FIELDS(35, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2, e2, f2, g2, h2, i2)
    INTARSIA_FIELDS(36, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2, e2, f2, g2, h2, i2, j2)
    INTARSIA_FIELDS(37, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2, e2, f2, g2, h2, i2, j2, k2)
    INTARSIA_FIELDS(38, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2, e2, f2, g2, h2, i2, j2, k2, l2)
    INTARSIA_FIELDS(39, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a2, b2, c2, d2, e2, f2, g2, h2, i2, j2, k2, l2, m2)
    // clang-format on
  }
}

#undef INTARSIA_FIELDS

}  // namespace intarsia
