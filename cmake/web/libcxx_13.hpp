// Additions to libc++ 13, the library of emscripten 3.1.6: C++20 functions that the parts use and that it lacks. The
// preset `web` includes this file before every source. With newer libraries it is empty: libc++ 19 has all of these.
#pragma once
#include <version>
#if defined(_LIBCPP_VERSION) && !defined(__cpp_lib_atomic_ref) && __cplusplus > 201703L

#include <atomic>

namespace std {

// Uses plain reads and writes, because the modules of the preset have one thread.
template<class T> struct atomic_ref {
    explicit atomic_ref(T& object) : object_(object) {}
    T load(std::memory_order) const { return object_; }
    void store(T value, std::memory_order) const { object_ = value; }
    bool compare_exchange_weak(T& expected, T desired, std::memory_order) const
    {
        const bool same = object_ == expected;
        (same ? object_ : expected) = same ? desired : object_;
        return same;
    }

private:
    T& object_;
};

} // namespace std

#endif
#if defined(_LIBCPP_VERSION) && !defined(__cpp_lib_bit_cast) && __cplusplus > 201703L

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <system_error>
#include <type_traits>
#include <utility>

namespace std {

template<class To, class From> constexpr To bit_cast(const From& from) noexcept { return __builtin_bit_cast(To, from); }

#ifndef COTAN_REAL_NUMBERS // real_numbers.hpp is exact, and larger
// Accepts texts shorter than 64 characters. Unlike the standard's function, strtod also accepts hexadecimal numbers.
template<class Real>
requires std::is_floating_point_v<Real> std::from_chars_result from_chars(const char* first, const char* last,
                                                                          Real& value)
{
    char text[64] = {};
    if (first == last || std::size_t(last - first) >= sizeof text || *first == '+' || std::isspace(*first))
        return {first, std::errc::invalid_argument};
    std::memcpy(text, first, std::size_t(last - first));
    char* end = nullptr;
    const double number = std::strtod(text, &end);
    value = Real(number);
    return {first + (end - text), end == text ? std::errc::invalid_argument : std::errc()};
}
#endif

namespace ranges {

// Returns a function that applies `test` to one or two projected elements.
template<class Test, class Projection> constexpr auto onProjected(Test& test, Projection& projection)
{
    return [&](auto&&... items) -> bool { return std::invoke(test, std::invoke(projection, items)...); };
}

template<class Range, class Test, class Projection = std::identity>
constexpr auto find_if(Range&& range, Test test, Projection projection = {})
{
    return std::find_if(std::begin(range), std::end(range), onProjected(test, projection));
}
template<class Range, class Value, class Projection = std::identity>
constexpr auto find(Range&& range, const Value& value, Projection projection = {})
{
    return std::find_if(std::begin(range), std::end(range),
                        [&](auto&& item) { return std::invoke(projection, item) == value; });
}
template<class Range, class Test, class Projection = std::identity>
constexpr bool all_of(Range&& range, Test test, Projection projection = {})
{
    return std::all_of(std::begin(range), std::end(range), onProjected(test, projection));
}
template<class Range, class Test, class Projection = std::identity>
constexpr bool any_of(Range&& range, Test test, Projection projection = {})
{
    return std::any_of(std::begin(range), std::end(range), onProjected(test, projection));
}
template<class Range, class Test, class Projection = std::identity>
constexpr bool none_of(Range&& range, Test test, Projection projection = {})
{
    return std::none_of(std::begin(range), std::end(range), onProjected(test, projection));
}
template<class Range, class Test, class Projection = std::identity>
constexpr auto count_if(Range&& range, Test test, Projection projection = {})
{
    return std::count_if(std::begin(range), std::end(range), onProjected(test, projection));
}
template<class One, class Other, class Test> constexpr bool equal(One&& one, Other&& other, Test test)
{
    return std::equal(std::begin(one), std::end(one), std::begin(other), std::end(other), std::ref(test));
}
template<class Range, class Value, class Less = std::less<>, class Projection = std::identity>
constexpr auto lower_bound(Range&& range, const Value& value, Less less = {}, Projection projection = {})
{
    return std::lower_bound(std::begin(range), std::end(range), value, [&](auto&& item, const Value& v) -> bool {
        return std::invoke(less, std::invoke(projection, item), v);
    });
}
template<class Range, class Value, class Less = std::less<>, class Projection = std::identity>
constexpr auto upper_bound(Range&& range, const Value& value, Less less = {}, Projection projection = {})
{
    return std::upper_bound(std::begin(range), std::end(range), value, [&](const Value& v, auto&& item) -> bool {
        return std::invoke(less, v, std::invoke(projection, item));
    });
}
template<class Range, class Less = std::less<>, class Projection = std::identity>
constexpr auto max_element(Range&& range, Less less = {}, Projection projection = {})
{
    return std::max_element(std::begin(range), std::end(range), onProjected(less, projection));
}
template<class Range> constexpr auto minmax(const Range& range)
{
    const auto [minimum, maximum] = std::minmax_element(std::begin(range), std::end(range));
    return std::pair(*minimum, *maximum);
}
template<class Range, class Iterator> constexpr void nth_element(Range&& range, Iterator nth)
{
    std::nth_element(std::begin(range), nth, std::end(range));
}
template<class Range, class Value> constexpr void replace(Range&& range, const Value& old, const Value& replacement)
{
    std::replace(std::begin(range), std::end(range), old, replacement);
}
template<class Range, class Less = std::less<>, class Projection = std::identity>
constexpr void sort(Range&& range, Less less = {}, Projection projection = {})
{
    std::sort(std::begin(range), std::end(range), onProjected(less, projection));
}
template<class Range, class Out, class Function> constexpr auto transform(Range&& range, Out out, Function function)
{
    return std::transform(std::begin(range), std::end(range), out,
                          [&](auto&& item) -> decltype(auto) { return std::invoke(function, item); });
}

template<class Range, class Less = std::less<>, class Projection = std::identity>
constexpr auto min_element(Range&& range, Less less = {}, Projection projection = {})
{
    return std::min_element(std::begin(range), std::end(range), onProjected(less, projection));
}
template<class Range, class Less = std::less<>, class Projection = std::identity>
constexpr void stable_sort(Range&& range, Less less = {}, Projection projection = {})
{
    std::stable_sort(std::begin(range), std::end(range), onProjected(less, projection));
}
template<class Range, class Value, class Projection = std::identity>
constexpr auto count(Range&& range, const Value& value, Projection projection = {})
{
    return std::count_if(std::begin(range), std::end(range),
                         [&](auto&& item) { return std::invoke(projection, item) == value; });
}
template<class Range, class Out> constexpr void copy(Range&& range, Out out)
{
    std::copy(std::begin(range), std::end(range), out);
}
template<class Range> constexpr void reverse(Range&& range) { std::reverse(std::begin(range), std::end(range)); }
template<class Range, class Test, class Value>
constexpr void replace_if(Range&& range, Test test, const Value& replacement)
{
    std::replace_if(std::begin(range), std::end(range), test, replacement);
}
template<class Range, class Value> constexpr void fill(Range&& range, const Value& value)
{
    std::fill(std::begin(range), std::end(range), value);
}

} // namespace ranges
} // namespace std

#endif
