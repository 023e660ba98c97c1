// Shared code of the functions of cotan.h: checks of arguments, errors as codes, no exceptions across the C interface.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/named_values.hpp"
#include "cotan.h"
#include "cotan/result.hpp"

struct cotan_bytes {
    std::vector<std::byte> data;
};

namespace cotan::c {

// Throws an Error. parts: texts and integers of the message.
template<class... Parts> [[noreturn]] void fail(ErrorKind kind, const Parts&... parts)
{
    std::string message;
    const auto add = [&](const auto& part) {
        if constexpr (requires { std::to_string(part); })
            message += std::to_string(part);
        else
            message += part;
    };
    (add(parts), ...);
    throw Error{kind, std::move(message)};
}

inline void require(bool holds, const char* expectation)
{
    if (!holds)
        fail(ErrorKind::usage, expectation);
}

// Converts the caller's progress function for the library; empty for null. Calls are serialised.
inline Progress progressOf(cotan_progress progress, void* user)
{
    if (!progress)
        return {};
    struct Guard {
        std::mutex mutex;
        bool stopped = false;
    };
    return [progress, user, guard = std::make_shared<Guard>()](double done) {
        const std::lock_guard lock(guard->mutex);
        guard->stopped = guard->stopped || progress(user, done) != 0;
        return !guard->stopped;
    };
}

inline void requireSize(std::size_t size, std::size_t least, const char* name)
{
    if (size < least)
        fail(ErrorKind::usage, name, ".size: expected ", least, " or more, found ", size);
}

template<class T> void requireStruct(const T* argument, const char* name)
{
    if (!argument)
        fail(ErrorKind::usage, name, ": expected a struct, found null");
}

// Structs of newer callers may be longer than T, but not shorter.
template<class T> const T& checked(const T* argument, const char* name)
{
    requireStruct(argument, name);
    requireSize(argument->size, sizeof(T), name);
    return *argument;
}

// The minimum size of a struct that has grown: its size in the version that introduced it.
template<class T> inline constexpr std::size_t kFirstSize = sizeof(T);
template<> inline constexpr std::size_t kFirstSize<cotan_mesh> = offsetof(cotan_mesh, colors);
template<> inline constexpr std::size_t kFirstSize<cotan_bake_options> = offsetof(cotan_bake_options, cage);
template<> inline constexpr std::size_t kFirstSize<cotan_convert_options> = offsetof(cotan_convert_options, expansion);
template<> inline constexpr std::size_t kFirstSize<cotan_lint_options> = offsetof(cotan_lint_options, limit);
template<> inline constexpr std::size_t kFirstSize<cotan_model_files> = offsetof(cotan_model_files, name);

// Returns the caller's options; members unknown to an older caller are 0, and all are if `given` is null.
template<class T> T optionsOf(const T* given, const char* name)
{
    T options{};
    if (given) {
        requireSize(given->size, kFirstSize<T>, name);
        std::memcpy(&options, given, std::min(given->size, sizeof(T)));
    }
    return options;
}

inline std::string_view word(const char* text, const char* name)
{
    if (!text)
        fail(ErrorKind::usage, name, ": expected a name, found null");
    return text;
}

template<class T> T valueOf(Result<T> result, const char* name)
{
    if (!result)
        throw about(name, result.error());
    return *std::move(result);
}

// Like valueOf above, for errors whose message names its subject.
template<class T> T valueOf(Result<T> result)
{
    if (!result)
        throw result.error();
    return *std::move(result);
}

// Returns the value of a word. Errors: "options.kind: expected normal or height, found 'x'" for an unknown word.
template<class Value, std::size_t count>
Value valueOf(const Named<Value> (&all)[count], std::string_view wanted, const char* name)
{
    if (const auto value = cotan::valueOf(all, wanted))
        return *value;
    fail(ErrorKind::usage, name, ": expected ", eitherOf(wordsOf(all)), ", found '", wanted, "'");
}

// Copies the text, cut to `size` bytes including the terminating zero.
inline void copyText(std::string_view text, char* to, std::size_t size)
{
    if (!to || size == 0)
        return;
    const std::size_t length = std::min(text.size(), size - 1);
    std::memcpy(to, text.data(), length);
    to[length] = '\0';
}

inline cotan_status refused(ErrorKind kind, std::string_view why, char* message, std::size_t size)
{
    copyText(why, message, size);
    return cotan_status(kind);
}

inline cotan_status refused(const Error& error, char* message, std::size_t size)
{
    return refused(error.kind, error.message, message, size);
}

// A null in the array is an empty text.
inline std::vector<std::string> textsOf(std::size_t count, const char* const* texts, const char* name)
{
    if (!texts && count > 0)
        fail(ErrorKind::usage, name, ": expected an array, found null");
    std::vector<std::string> all;
    for (std::size_t i = 0; i < count; ++i)
        all.emplace_back(texts[i] ? texts[i] : "");
    return all;
}

// Returns a text as bytes, unless `to` is null.
inline void giveText(std::string_view text, cotan_bytes** to)
{
    if (!to)
        return;
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    *to = new cotan_bytes{{bytes.begin(), bytes.end()}};
}

// Joins lines to one text.
inline std::string joined(const std::vector<std::string>& lines)
{
    std::string text;
    for (const std::string& line : lines)
        text += (text.empty() ? "" : "\n") + line;
    return text;
}

// Calls run(work), and converts exceptions to error codes.
cotan_status callCaught(char* message, std::size_t size, void (*run)(void* work), void* work);

// Runs the work of one API function.
template<class Work> cotan_status call(char* message, std::size_t size, Work work)
{
    return callCaught(
        message, size, [](void* w) { (*static_cast<Work*>(w))(); }, &work);
}

} // namespace cotan::c
