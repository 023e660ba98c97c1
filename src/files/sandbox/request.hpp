// What goes between the two processes of a sandboxed reader: one request, then frames until the result.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "cotan/files.hpp"
#include "cotan/result.hpp"
#include "files/sandbox/wire.hpp"

namespace cotan {

inline constexpr char kReaderWord[] = "read-for-parent"; // the reader's only argument
inline constexpr int kNoMemoryCode = 71;                 // its exit code where memory ended
inline constexpr std::uint32_t kReaderVersion = 4;       // of what is said; both are the same program, or should be

// The most that the reader may take.
struct ReaderBudget {
    double megabytes = 0;
    double seconds = 0; // of processor
};

// Rates are some ten times what sound files need, so that nobody has to know about them. Whoever lets a picture take
// more lets readers take as much.
inline ReaderBudget budgetFor(const LoadLimits& limits, std::size_t fileBytes, std::size_t decodedBytes)
{
    constexpr double kMegabyte = 1 << 20;
    const Sandbox& sandbox = limits.sandbox;
    const double file = double(fileBytes) / kMegabyte, decoded = double(decodedBytes) / kMegabyte;
    const double picture = std::max(double(limits.imageBytes) / kMegabyte, 640.0);
    const double start = picture + 16 * std::thread::hardware_concurrency(); // libraries keep a thread for each
    const double most = std::max(8192.0, 2 * picture);
    return {sandbox.megabytes > 0 ? double(sandbox.megabytes) : std::min(start + 64 * file + 6 * decoded, most),
            sandbox.seconds > 0 ? sandbox.seconds : std::min(4 + 4 * file + 0.2 * decoded, 3600.0)};
}

enum class ReaderKind { model, picture, rows, draco };

struct ReaderRequest {
    std::uint32_t version = kReaderVersion;
    ReaderKind kind = ReaderKind::model;
    std::string name;               // the file; of a picture, its name for messages
    std::vector<std::byte> bytes{}; // of a picture
    std::uint64_t fileBytes = 0;
    LoadLimits limits;       // but for those that are functions, or name programs
    std::int64_t parent = 0; // the process that asks
};

template<class W, class T> void exchangeRequest(W& w, T& request)
{
    auto& limits = request.limits;
    w.number(request.version);
    w.choice(request.kind, ReaderKind::draco);
    exchangeAll(w, request.name, request.bytes, request.fileBytes, limits.fileBytes, limits.vertices, limits.triangles,
                limits.nodes, limits.imageSide, limits.imageBytes, limits.allImageBytes, limits.imageBytesBeyond,
                limits.sandbox.megabytes, limits.sandbox.seconds, request.parent);
}

// How a frame begins.
enum class ReaderFrame {
    expect, // a std::uint64_t: bytes that will be decoded
    input,  // a text: a file that will be read
    value,  // what was asked for
    error,  // an Error
};

template<class W, class T> void exchangeError(W& w, T& error)
{
    w.number(error.kind);
    exchangeAll(w, error.message, error.memory);
}

} // namespace cotan
