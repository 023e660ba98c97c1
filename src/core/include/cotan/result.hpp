// The results of functions that can fail, and the progress of long work.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <variant>

namespace cotan {

// ---- results -------------------------------------------------------------------------------

// Functions that can fail return Result<T>: a value, or an error of one line: what failed, where, expected, found.

// The numbers are the exit codes of the command line, which does not use `stopped`.
enum class ErrorKind {
    usage = 1,       // the call itself is wrong
    input = 2,       // a given file or value is bad
    unavailable = 3, // missing: no device, or a part that is not built
    output = 4,      // output cannot be written
    limit = 5,       // a check found values over a requested limit
    stopped = 6,     // the caller's Progress stopped the work
};

struct Error {
    ErrorKind kind = ErrorKind::input;
    std::string message;  // one line, no newline
    bool memory = false;  // the caller's memory limit was exceeded; a larger limit may succeed
    std::string field{};  // the caller's field that the message begins with, such as "options.maxDistance"
    std::string advice{}; // further lines for people, each ending with a newline
};

// A value or an Error. Check with `if (!result)` before `*result`. Compilers warn of a call whose result is ignored.
template<class T> class [[nodiscard]] Result {
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

// The result of functions that return no value: `return Done{};` on success. Ignoring it gives the same warning.
struct Done {};
using Status = Result<Done>;

inline Error inputError(std::string message) { return {ErrorKind::input, std::move(message)}; }
inline Error usageError(std::string message) { return {ErrorKind::usage, std::move(message)}; }
inline Error unavailableError(std::string message) { return {ErrorKind::unavailable, std::move(message)}; }
inline Error outputError(std::string message) { return {ErrorKind::output, std::move(message)}; }
inline Error memoryError(std::string message) { return {ErrorKind::input, std::move(message), true}; }

// Returns the error about a field, whose name is prepended to the message: "options.maxDistance: expected ...".
inline Error about(std::string field, Error error)
{
    error.message = field + ": " + error.message;
    error.field = std::move(field);
    return error;
}

// Returns the error with another message, which begins with no field.
inline Error reworded(Error error, std::string message)
{
    error.message = std::move(message);
    error.field.clear();
    return error;
}

// ---- progress ------------------------------------------------------------------------------

// Reports of the progress of long work to the caller, who may stop it.

// Called with the fraction done, 0 to 1; returns whether to continue. May be empty. Work that is stopped returns
// stoppedError soon, writes no file and leaves its arguments unchanged.
using Progress = std::function<bool(double share)>;

inline Error stoppedError() { return {ErrorKind::stopped, "stopped by the caller"}; }

// Counts the steps of one task, from any number of threads, and reports them as a fraction of `total`.
class CountedSteps {
public:
    CountedSteps(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}

    // Counts a step. Returns whether to continue.
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

// Returns the progress for part `part` of `parts` equal parts of a whole.
inline Progress partOf(const Progress& progress, std::size_t part, std::size_t parts)
{
    if (!progress)
        return {};
    return [&progress, part, parts](double share) { return progress((double(part) + share) / double(parts)); };
}

} // namespace cotan
