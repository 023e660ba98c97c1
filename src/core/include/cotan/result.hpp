// What can fail returns Result<T>, and what takes long takes a Progress.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <variant>

namespace cotan {

// ---- results -------------------------------------------------------------------------------

// What can fail returns Result<T>: a value, or one line that says what, where, expected, found.

// The numbers are the exit codes of the command line, which has none for `stopped`.
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
    bool memory = false; // a limit of memory that the caller gave stopped it: it may go on with more
    std::string field{}; // of what the caller gave, where the message begins with it: "options.maxDistance"
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
inline Error memoryError(std::string message) { return {ErrorKind::input, std::move(message), true}; }

// The error about that field, which its message then begins with: "options.maxDistance: expected ...".
inline Error about(std::string field, Error error)
{
    error.message = field + ": " + error.message;
    error.field = std::move(field);
    return error;
}

// The same error in other words, which begin with no field.
inline Error reworded(Error error, std::string message)
{
    error.message = std::move(message);
    error.field.clear();
    return error;
}

// ---- progress ------------------------------------------------------------------------------

// How far long work is, told to the caller, who may stop it.

// Gets the share that is done, from 0 to 1, and returns whether to go on. May be empty. Work that is
// told to stop ends soon with stoppedError, writes no file and changes nothing that it was given.
using Progress = std::function<bool(double share)>;

inline Error stoppedError() { return {ErrorKind::stopped, "stopped by the caller"}; }

// Steps of one work, counted from any number of threads and told as a share of `total`.
class CountedSteps {
public:
    CountedSteps(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}

    // A step is done. Returns whether to go on.
    bool step()
    {
        if (progress_ && !progress_(double(++done_) / double(total_)))
            stopped_ = true;
        return !stopped_;
    }
    bool stopped() const { return stopped_; }

private:
    const Progress& progress_;
    const std::size_t total_;
    std::atomic<std::size_t> done_ = 0;
    std::atomic<bool> stopped_ = false;
};

// The progress of part number `part` of `parts` equal ones, as one of the whole.
inline Progress partOf(const Progress& progress, std::size_t part, std::size_t parts)
{
    if (!progress)
        return {};
    return [&progress, part, parts](double share) { return progress((double(part) + share) / double(parts)); };
}

} // namespace cotan
