// The protocol between the two processes of a sandboxed reader: one request, then frames until the result.
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
inline constexpr int kNoMemoryCode = 71;                 // the reader's exit code if it runs out of memory
inline constexpr std::uint32_t kReaderVersion = 5;       // of the protocol; both sides should be the same program

// Maximum resources of the reader.
struct ReaderBudget {
    double megabytes = 0;
    double seconds = 0; // processor time
};

// The rates are about ten times what valid files need, so that users need not set them. Callers who allow larger images
// thereby give readers as much more memory.
inline ReaderBudget budgetFor(const LoadLimits& limits, std::size_t fileBytes, std::size_t decodedBytes)
{
    constexpr double kMegabyte = 1 << 20;
    const Sandbox& sandbox = limits.sandbox;
    const double file = double(fileBytes) / kMegabyte, decoded = double(decodedBytes) / kMegabyte;
    const double image = std::max(double(limits.imageBytes) / kMegabyte, 640.0);
    const double start = image + 16 * std::thread::hardware_concurrency(); // libraries start a thread per processor
    const double maximum = std::max(8192.0, 2 * image);
    return {sandbox.megabytes > 0 ? double(sandbox.megabytes) : std::min(start + 64 * file + 6 * decoded, maximum),
            sandbox.seconds > 0 ? sandbox.seconds : std::min(4 + 4 * file + 0.2 * decoded, 3600.0)};
}

enum class ReaderKind { model, image, rows, draco };

struct ReaderRequest {
    std::uint32_t version = kReaderVersion;
    ReaderKind kind = ReaderKind::model;
    std::string name;               // the file; for an image, its name in messages
    std::vector<std::byte> bytes{}; // an image's file
    std::uint64_t fileBytes = 0;
    LoadLimits limits;       // without functions and names of programs
    std::int64_t parent = 0; // the parent process
};

template<class W, class T> void exchangeRequest(W& w, T& request)
{
    auto& limits = request.limits;
    w.number(request.version);
    w.choice(request.kind, ReaderKind::draco);
    exchangeAll(w, request.name, request.bytes, request.fileBytes, limits.fileBytes, limits.vertices, limits.triangles,
                limits.nodes, limits.imageSide, limits.imageBytes, limits.allImageBytes, limits.imageBytesBeyond,
                limits.keepsJpeg, limits.sandbox.megabytes, limits.sandbox.seconds, request.parent);
}

// First value of a frame, and what follows.
enum class ReaderFrame {
    expect, // a std::uint64_t: bytes that will be decoded
    input,  // a text: a file that will be read
    value,  // the requested value
    error,  // an Error
};

template<class W, class T> void exchangeError(W& w, T& error)
{
    w.number(error.kind);
    exchangeAll(w, error.message, error.memory);
}

} // namespace cotan
