// How the parts of the glTF reader report trouble to loadGltf and openGltfDocument.
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

#include "cotan/result.hpp"

namespace cotan {

// Thrown by the parts of the glTF reader, caught by caughtGltf alone, which turns it into an Error.
// The message says field, expected, found; caughtGltf puts the file in front.
struct GltfProblem {
    Error error;
};

template<class... Args> [[noreturn]] void failGltf(fmt::format_string<Args...> text, Args&&... args)
{
    throw GltfProblem{inputError(fmt::format(text, std::forward<Args>(args)...))};
}

// The value of a result. Throws GltfProblem with its error, which is then one of the file.
template<class T> T valueOrFail(Result<T> result)
{
    if (!result)
        throw GltfProblem{inputError(result.error().message)};
    return *std::move(result);
}

// For files of glTF 1.0, whose structure is another one. field: where that shows.
[[noreturn]] void failGltfVersion1(const std::string& field);

// Collects what was odd but usable. The same complaint about many places becomes one line that
// names the first place and counts the rest: a model of 44 parts should not print 44 lines.
class GltfWarnings {
public:
    // count and unit: how often it happened at that place, for example 12 "vertices"; they are summed over the places.
    // Nothing is said of 0 of them.
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

// Text from a file made fit for a one-line message: control characters replaced, length capped.
std::string oneLine(std::string_view text);

// What load() returns, and what it throws as an error: one line with the file's name in front, once.
template<class Load> auto caughtGltf(const std::filesystem::path& file, Load load) -> Result<decltype(load())>
{
    const auto failed = [&](const Error& error) {
        const std::string name = file.string(), &what = error.message;
        return reworded(error, oneLine(what.starts_with(name) ? what : name + ": " + what));
    };
    try {
        return load();
    } catch (const GltfProblem& problem) {
        return failed(problem.error);
    } catch (const std::bad_alloc&) {
        return failed(inputError("not enough memory for what the file asks for"));
    } catch (const std::exception& problem) {
        return failed(inputError(problem.what()));
    }
}

} // namespace cotan
