// Error and warning reporting of the glTF reader.
#pragma once

#include <cstddef>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/one_line.hpp"
#include "cotan/result.hpp"

namespace cotan {

// Thrown by the parts of the glTF reader; only caughtGltf catches it and turns it into an Error. The message names
// field, expected and found; caughtGltf prepends the file.
struct GltfProblem {
    Error error;
    bool namesFile = false; // the message begins with the file already
};

template<class... Args> [[noreturn]] void failGltf(fmt::format_string<Args...> text, Args&&... args)
{
    throw GltfProblem{inputError(fmt::format(text, std::forward<Args>(args)...))};
}

// Returns the value of `result`. Throws GltfProblem with its error as ErrorKind::input.
template<class T> T valueOrFail(Result<T> result)
{
    if (!result)
        throw GltfProblem{inputError(result.error().message)};
    return *std::move(result);
}

// Reports a file of glTF 1.0, whose structure differs. field: the field that shows it.
[[noreturn]] void failGltfVersion1(const std::string& field);

// Collects warnings about unusual but usable content. Equal warnings are merged into one line that names the first
// location and counts the others: a model of 44 parts should not print 44 lines.
class GltfWarnings {
public:
    // count and unit: number of occurrences at this location, such as 12 "vertices"; they are summed over all
    // locations. A count of 0 with a unit adds nothing.
    void add(const std::string& where, const std::string& what, std::size_t count = 0, const std::string& unit = {});

    std::vector<std::string> lines() const;

private:
    struct Entry {
        std::string where, what, unit;
        std::size_t places = 0, count = 0;
    };
    std::vector<Entry> entries_;
    std::size_t leftOut_ = 0;
};

// Returns load(), or its exception as an error: one line that starts with the file name.
template<class Load> auto caughtGltf(const std::filesystem::path& file, Load load) -> Result<decltype(load())>
{
    const auto failed = [&](const Error& error, bool namesFile = false) {
        const std::string name = namesFile || file.empty() ? "" : file.string() + ": ";
        return reworded(error, oneLine(name + error.message));
    };
    try {
        return load();
    } catch (const GltfProblem& problem) {
        return failed(problem.error, problem.namesFile);
    } catch (const std::bad_alloc&) {
        return failed(inputError("not enough memory for the data of the file"));
    } catch (const std::exception& problem) {
        return failed(inputError(problem.what()));
    }
}

} // namespace cotan
