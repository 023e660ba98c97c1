// Shared by the harnesses. Each harness is a file NAME_fuzz.cpp that defines LLVMFuzzerTestOneInput. libFuzzer calls it
// with mutated inputs, replay.cpp with those of corpus/NAME.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <unistd.h>

#include "cotan/result.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

// Aborts with a one-line message if a property does not hold; libFuzzer saves the input.
#define COTAN_HOLDS(condition, ...)                                                                                    \
    do {                                                                                                               \
        if (!(condition))                                                                                              \
            cotan::fuzz::fail(__FILE__, __LINE__, #condition, fmt::format("" __VA_ARGS__));                            \
    } while (false)

namespace cotan::fuzz {

[[noreturn]] inline void fail(const char* file, int line, const char* condition, const std::string& detail)
{
    fmt::print(stderr, "{}:{}: check failed: {}; {}\n", file, line, condition, detail);
    std::abort();
}

// Checks that an error is one line of a known kind.
inline void checkError(const Error& error)
{
    COTAN_HOLDS(!error.message.empty() && error.message.find('\n') == std::string::npos, "{}", error.message);
    COTAN_HOLDS(int(error.kind) >= 1 && int(error.kind) <= 5, "{}", int(error.kind));
}

// A folder for this process, which is removed when the process ends normally.
class Scratch {
public:
    Scratch() : path_(std::filesystem::temp_directory_path() / fmt::format("cotan-fuzz-{}", ::getpid()))
    {
        std::filesystem::create_directories(path_);
    }
    ~Scratch()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    // Writes a file with these bytes, replacing an earlier one of the same name.
    std::filesystem::path write(const std::string& name, std::span<const std::uint8_t> bytes) const
    {
        const std::filesystem::path file = path_ / name;
        std::filesystem::remove(file);
        std::FILE* f = std::fopen(file.c_str(), "wb");
        COTAN_HOLDS(f != nullptr, "{}", file.string());
        const std::size_t written = std::fwrite(bytes.data(), 1, bytes.size(), f);
        COTAN_HOLDS(std::fclose(f) == 0 && written == bytes.size(), "{}", file.string());
        return file;
    }

private:
    std::filesystem::path path_;
};

// Takes values from the start of an input; zeros after its end.
class Values {
public:
    explicit Values(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    template<class T> T next()
    {
        T value{};
        const std::size_t n = std::min(sizeof(T), bytes_.size());
        std::memcpy(&value, bytes_.data(), n);
        bytes_ = bytes_.subspan(n);
        return value;
    }
    // Returns one of 0..count-1.
    int choose(int count) { return next<std::uint8_t>() % count; }
    bool flip() { return (next<std::uint8_t>() & 1) != 0; }
    // Returns a value from low to high, in 65536 steps.
    double between(double low, double high) { return low + (high - low) * next<std::uint16_t>() / 65535; }

private:
    std::span<const std::uint8_t> bytes_;
};

template<class Vector> bool finite(const Vector& v)
{
    return std::isfinite(glm::dot(v, v)) || std::isfinite(glm::length(v * typename Vector::value_type(1e-20)));
}

inline bool startsWith(std::span<const std::uint8_t> bytes, std::string_view start)
{
    return bytes.size() >= start.size() && std::memcmp(bytes.data(), start.data(), start.size()) == 0;
}

} // namespace cotan::fuzz
