// What can fail returns Result<T>: a value, or one line that says what, where, expected, found.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace cotan {

// The numbers are the exit codes of the command line, which is never stopped by itself.
enum class ErrorKind {
    usage = 1,       // the call itself is wrong
    input = 2,       // a file or value given to us is bad
    unavailable = 3, // not here: no device, part not built
    output = 4,      // cannot write
    limit = 5,       // checked, and over the limit that was asked for
    stopped = 6,     // the caller's Progress said so
};

struct Error {
    ErrorKind kind = ErrorKind::input;
    std::string message; // one line, no newline
};

// A value or an Error. Check with `if (!result)` before `*result`.
template<class T> class Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    explicit operator bool() const { return state_.index() == 0; }
    T& operator*() & { return std::get<0>(state_); }
    const T& operator*() const& { return std::get<0>(state_); }
    T&& operator*() && { return std::get<0>(std::move(state_)); }
    T* operator->() { return &std::get<0>(state_); }
    const T* operator->() const { return &std::get<0>(state_); }
    const Error& error() const { return std::get<1>(state_); }

private:
    std::variant<T, Error> state_;
};

// A Result without a value: `return Done{};` on success.
struct Done {};
using Status = Result<Done>;

inline Error inputError(std::string message) { return {ErrorKind::input, std::move(message)}; }
inline Error usageError(std::string message) { return {ErrorKind::usage, std::move(message)}; }
inline Error unavailableError(std::string message) { return {ErrorKind::unavailable, std::move(message)}; }
inline Error outputError(std::string message) { return {ErrorKind::output, std::move(message)}; }

} // namespace cotan
